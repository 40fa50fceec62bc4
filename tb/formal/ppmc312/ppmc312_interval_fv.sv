// SPDX-License-Identifier: Apache-2.0
// ppmc312_interval_fv: compares the times of all pulses with sums of the rates. Rates have 3 bits, a base
// clock has 7/3 cycles (base clock 0), and a pulse has 9 cycles.
`include "ppmc_fv.svh"
`default_nettype none

module ppmc312_interval_fv (
    input wire logic       clk_i,
    input wire logic       external_i,
    input wire logic       falling_i,
    input wire logic       extck_i,
    input wire logic       arm_i,
    input wire logic       first_i,
    input wire logic       fire_i,
    input wire logic [2:0] rate_i
);

  localparam int unsigned Width = 9;

  logic ready_o, high_o;

  `FV_RESET

  ppmc312_interval #(
      .ClkHz    (7),
      .XtalHz   (6),
      .RateBits (3),
      .WidthXtal(8)   // ceil(8 * 7 / 6) = 10 cycles
  ) dut (
      .base_i({external_i, external_i, external_i ? falling_i : 1'b0}),
      .*
  );

  // The motion arms, then fires pulses, the first one with first_i = 1.
  logic moving_q, first_q;
  `FV_ASSUME(one_base, {external_i, falling_i} == $past({external_i, falling_i}))
  `FV_ASSUME(fires_when_ready, !fire_i || (ready_o && moving_q && !arm_i))
  `FV_ASSUME(first_pulse, first_i == first_q)
  `FV_ASSUME(rates, rate_i >= 3'd2)
  `FV_ASSUME(arms_at_rest, !arm_i || !high_o)

  always_ff @(posedge clk_i)
    if (!rst_ni) {moving_q, first_q} <= '0;
    else if (arm_i) {moving_q, first_q} <= '1;
    else if (fire_i) first_q <= 1'b0;

  // ---- expected times ---------------------------------------------------------------------------------

  // Times in thirds of a cycle since the tick grid began (with pulse 1): phase_q is the time since the last
  // tick. left_q: ticks until the interval has passed, 0: it has passed.
  logic [3:0] phase_q;
  logic [1:0] edges_h;
  logic level, level_q, tick, restart;
  logic [3:0] arm_age_q;  // cycles since arm_i, at most 15
  logic [3:0] age_q;  // cycles since the last pulse, at most 15
  logic [2:0] left_q, rate_q, ticks_q;

  assign restart = fire_i && first_i;
  assign level   = edges_h[1];
  assign tick    = external_i ? level != level_q && level != falling_i : phase_q >= 4'd4;

  always_ff @(posedge clk_i) begin
    if (!rst_ni) {edges_h, level_q} <= '1;
    else {edges_h, level_q} <= {edges_h[0], extck_i, level};
    if (!rst_ni) {left_q, age_q, arm_age_q, phase_q, ticks_q} <= '0;
    else begin
      if (restart) phase_q <= '0;
      else phase_q <= (phase_q >= 4'd4) ? phase_q - 4'd4 : phase_q + 4'd3;
      if (arm_i) arm_age_q <= '0;
      else if (arm_age_q != '1) arm_age_q <= arm_age_q + 4'd1;
      if (fire_i) age_q <= '0;
      else if (age_q != '1) age_q <= age_q + 4'd1;
      if (fire_i) {left_q, rate_q, ticks_q} <= {rate_i, rate_i, 3'd0};
      else if (tick) begin
        if (left_q != '0) left_q <= left_q - 3'd1;
        if (ticks_q != '1) ticks_q <= ticks_q + 3'd1;
      end
    end
  end

  logic passed;
  assign passed = left_q == '0 || (left_q == 3'd1 && tick);

  `FV_ASSERT(p312_mot_01_first,
             !(moving_q && first_q && !arm_i) || ready_o == (arm_age_q >= 4'd9 && (!external_i || tick)))
  `FV_ASSERT(p312_mot_01_next, !(moving_q && !first_q && !arm_i) || ready_o == (passed && age_q >= 4'd3))

  // Width: ten cycles, or half of the interval, rounded down to ticks, if this is shorter
  logic high_q;
  always_ff @(posedge clk_i)
    high_q <= rst_ni &&
        (fire_i || (high_q && age_q < 4'd9 && !(tick && ticks_q + 3'd1 >= {1'b0, rate_q[2:1]})));

  `FV_ASSERT(p312_mot_03_width, high_o == high_q)
  `FV_ASSERT(p312_mot_03_never_merged, !(fire_i && high_o))
  `FV_COVER(seen_late_pulse, fire_i && age_q >= 4'd13 && !external_i && rate_q == 3'd5)
  `FV_COVER(seen_external, fire_i && external_i && !first_i)

endmodule

`default_nettype wire
