// SPDX-License-Identifier: Apache-2.0
// ppmc_rate_counter: counts the base clocks of an interval. Base clock number rate + 1 ends the interval.
// Rules:  P104-INT-01, P104-TIM-05 (half_o), P104-BCK-05 (during a rate look-up, base clocks are skipped).
// Timing: hit_o and half_o are combinational from tick_i. half_o is high from base clock number
//         floor((rate_i + 1) / 2) on. Exception: if rising_i is high at this base clock, half_o rises 2
//         cycles after the last cycle of rising_i.
// Assumes: ticks are at least 3 cycles apart. A device whose hosts send divisors (J105 STMC) sets rate_i to
//         the divisor minus 1.
// Note:   the count runs upwards, because the rate may still rise while an interval runs (see
//         ppmc_ramp_seq).
`include "ppmc_assert.svh"
`default_nettype none

module ppmc_rate_counter #(
    parameter int unsigned RateBits = 8
) (
    input  wire logic                clk_i,
    input  wire logic                rst_ni,
    input  wire logic                restart_i,  // strobe: a pulse; restart the count from 0
    input  wire logic                tick_i,     // strobe: a base clock to be counted
    input  wire logic [RateBits-1:0] rate_i,     // rate of the running interval
    input  wire logic                wait_i,     // 1: the interval must not end yet
    input  wire logic                rising_i,   // 1: rate_i may still rise
    output logic                     hit_o,      // strobe: this base clock ends the interval
    output logic                     half_o      // 1 from base clock floor((rate_i + 1) / 2) on
);

  logic [RateBits-1:0] count_q;  // base clocks since the pulse
  logic [RateBits-1:0] number;  // number of the next base clock
  logic equal, match_q, half_q, past_q;

  assign number = count_q + 1'b1;
  assign equal  = count_q == rate_i;
  assign hit_o  = tick_i && match_q;
  assign half_o = (tick_i && half_q) || past_q;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      match_q <= 1'b0;
      half_q  <= 1'b0;
      past_q  <= 1'b0;
    end else begin
      match_q <= !restart_i && !wait_i && equal;
      half_q  <= !restart_i && !rising_i && !ppmc_pkg::less(32'({number, 1'b0}), 32'(rate_i));
      past_q  <= !restart_i && !rising_i && !ppmc_pkg::less(32'({count_q, 1'b0}), 32'(rate_i));
    end
  end

  // No reset: the first pulse of a motion sets count_q. The count stops at rate_i, because later base
  // clocks have no effect (P104-BCK-05).
  always_ff @(posedge clk_i) begin
    if (restart_i) count_q <= '0;
    else if (tick_i && !equal) count_q <= number;
  end

`ifndef SYNTHESIS
  `PPMC_ASSERT(p104_int_01, !hit_o || count_q == rate_i || rate_i != $past(rate_i))
`endif

endmodule

`default_nettype wire
