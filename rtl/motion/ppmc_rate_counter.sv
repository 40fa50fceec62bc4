// SPDX-License-Identifier: Apache-2.0
// ppmc_rate_counter: counts the base clocks of an interval; the (rate + 1)-th one ends it.
// Rules:  P104-INT-01, P104-TIM-05 (b), P104-BCK-05 (base clocks are passed over while the rate is still being
//         looked up).
// Timing: hit_o and half_o are combinational from tick_i; ticks must be at least 3 clk apart. half_o stands from
//         its base clock on, or, if the rate rises longer than that, from 2 clk after its end: it comes late
//         rather than never. A part whose hosts give divisors (J105 STMC) passes divisor - 1.
// Note:   the count runs upwards so that the rate may still rise while an interval runs (see ppmc_ramp_seq).
`include "ppmc_assert.svh"
`default_nettype none

module ppmc_rate_counter #(
    parameter int unsigned RateBits = 8
) (
    input  wire logic                clk_i,
    input  wire logic                rst_ni,
    input  wire logic                restart_i,  // a pulse: count from 0
    input  wire logic                tick_i,     // a base clock that counts
    input  wire logic [RateBits-1:0] rate_i,     // rate of the running interval
    input  wire logic                wait_i,     // the interval must not end yet
    input  wire logic                rising_i,   // rate_i is not final yet
    output logic                     hit_o,      // this base clock ends the interval
    output logic                     half_o      // number floor((rate + 1) / 2) is this base clock or was
);

  logic [RateBits-1:0] count_q;  // base clocks since the pulse
  logic [RateBits-1:0] number;  // of the coming base clock
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

  // No reset: the first pulse of a motion restarts it. It waits where it cannot be used (P104-BCK-05).
  always_ff @(posedge clk_i) begin
    if (restart_i) count_q <= '0;
    else if (tick_i && !equal) count_q <= number;
  end

`ifndef SYNTHESIS
  `PPMC_ASSERT(p104_int_01, !hit_o || count_q == rate_i || rate_i != $past(rate_i))
`endif

endmodule

`default_nettype wire
