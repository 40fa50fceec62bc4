// SPDX-License-Identifier: Apache-2.0
// ppmc312_interval: times the beginning and the width of each pulse of a motion. The rate is the number of
//         base clocks of an interval.
// Rules:  P312-MOT-01..04, P312-CMD-00 (base clocks), P312-BAD-14.
// Timing: ready_o is combinational. For pulse 1, it is asserted CYC(WidthXtal) cycles after arm_i. Each
//         later pulse can fire exactly ceil(n * T) cycles after pulse 1, where n is the number of base clocks
//         between both pulses, and T is the period of the base clock in cycles. With the external clock, a
//         pulse can fire in the cycle of the edge that ends the interval. Two pulses are at least 4 cycles
//         apart. A late pulse does not shorten later intervals.
// Note:   a base clock may last one cycle. Therefore this module cannot use ppmc_base_clock and
//         ppmc_rate_counter, which need 3 cycles per base clock.
`include "ppmc_assert.svh"
`default_nettype none

module ppmc312_interval #(
    parameter int unsigned ClkHz     = 16_000_000,
    parameter int unsigned XtalHz    = 16_000_000,
    parameter int unsigned RateBits  = 16,
    parameter int unsigned WidthXtal = 80           // pulse width and direction set-up, crystal periods
) (
    input  wire logic                clk_i,    // clock
    input  wire logic                rst_ni,   // reset, asynchronous
    input  wire logic [         2:0] base_i,   // 0..5: crystal / 2, 16, 32, 64, 256, 1024; 6: rise, 7: fall
    input  wire logic                extck_i,  // asynchronous; base_i = 6: rising, 7: falling edge is used
    input  wire logic                arm_i,    // strobe: start of a motion
    input  wire logic                first_i,  // 1: the next pulse is pulse 1
    input  wire logic                fire_i,   // strobe: begin a pulse; only while ready_o = 1
    input  wire logic [RateBits-1:0] rate_i,   // with fire_i: base clocks until the next pulse, at least 2
    output logic                     ready_o,  // 1: a pulse may begin
    output logic                     high_o    // 1: a pulse is active
);

  localparam logic [2:0] ExtRise = 3'd6;
  localparam int unsigned PreBits = 9;

  logic quantum, tick, restart, level, last_q, edge_now, external, cut, up, unused_meta;
  logic past_q, elapsed, min_gap, elapsed_now;
  logic [2:0] age_q;  // cycles since the pulse, 0 .. 4
  logic [PreBits-1:0] pre_q, pre_load;
  logic rest_q;  // 1: pre_q is 0; a separate register, because of its fan-out
  // left_q: remaining base clocks; half_q: value of left_q in the middle of the interval
  logic [RateBits-1:0] left_q, half_q;

  assign external = base_i >= ExtRise;
  assign restart  = fire_i && first_i;

  ppmc_tick_gen #(
      .ClkHz   (ClkHz),
      .XtalHz  (XtalHz),
      .TickXtal(2),
      .MinCycles  (1)
  ) u_quantum (
      .clk_i,
      .rst_ni,
      .restart_i(restart),
      .tick_o   (quantum)
  );

  ppmc_sync #(
      .Width   (1),
      .ResetVal(1'b1)
  ) u_sync (
      .clk_i,
      .rst_ni,
      .d_i (extck_i),
      .q1_o(unused_meta),
      .q2_o(level)
  );

  always_comb begin
    unique case (base_i)
      3'd1:    pre_load = PreBits'(7);
      3'd2:    pre_load = PreBits'(15);
      3'd3:    pre_load = PreBits'(31);
      3'd4:    pre_load = PreBits'(127);
      3'd5:    pre_load = PreBits'(511);
      default: pre_load = '0;
    endcase
    edge_now = level != last_q && level == (base_i == ExtRise);
    tick = external ? edge_now : quantum && rest_q;
  end

  assign min_gap = age_q[2];
  assign elapsed_now = tick && left_q == RateBits'(1);
  assign elapsed = elapsed_now || past_q;
  assign ready_o = first_i ? up && (!external || tick) : elapsed && min_gap;
  assign cut = tick && left_q == half_q;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      last_q <= 1'b1;
      past_q <= 1'b0;
      age_q  <= '0;
      pre_q  <= '0;
      rest_q <= 1'b1;
      left_q <= '0;
      half_q <= '0;
    end else begin
      last_q <= level;
      if (restart || (quantum && rest_q)) begin
        pre_q  <= pre_load;
        rest_q <= pre_load == '0;
      end else if (quantum) begin
        pre_q  <= PreBits'(ppmc_pkg::dec(32'(pre_q)));
        rest_q <= pre_q == PreBits'(1);
      end
      if (arm_i) begin
        past_q <= 1'b0;
        left_q <= '0;
      end else if (fire_i) begin
        past_q <= 1'b0;
        age_q  <= 3'd1;
        // A tick in the cycle in which a pulse begins belongs to the previous interval and is not counted.
        left_q <= rate_i;
        half_q <= RateBits'(((RateBits + 1)'(rate_i) + (RateBits + 1)'(3)) >> 1);
      end else begin
        if (elapsed_now) past_q <= 1'b1;
        if (!min_gap) age_q <= age_q + 1'b1;
        // left_q may wrap below 0; past_q is 1 before this happens.
        if (tick) left_q <= left_q - 1'b1;
      end
    end
  end

  ppmc_pulse_shaper #(
      .ClkHz    (ClkHz),
      .XtalHz   (XtalHz),
      .RateBits (1),
      .WidthXtal(WidthXtal),
      .HalfRates(1)
  ) u_shaper (
      .clk_i,
      .rst_ni,
      .arm_i,
      .pulse_i(fire_i),
      .full_i (1'b0),
      .halve_i(1'b0),
      .rate_i (1'b0),
      .cut_i  (cut),
      .low_o  (high_o),
      .past_o (up)
  );

`ifndef SYNTHESIS
  `PPMC_ASSERT(p312_mot_02_prescaler, rest_q == (pre_q == '0))
  `PPMC_ASSERT(p312_mot_04, !(fire_i && !first_i) || age_q[2])
`endif

endmodule

`default_nettype wire
