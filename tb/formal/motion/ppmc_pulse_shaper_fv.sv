// SPDX-License-Identifier: Apache-2.0
// ppmc_pulse_shaper_fv: proves that the low time of a pulse is exactly WidthCycles cycles, or less if it is
// cut, and that the set-up time is also WidthCycles cycles.
`include "ppmc_fv.svh"
`default_nettype none

module ppmc_pulse_shaper_fv (
    input wire logic       clk_i,
    input wire logic       arm_i,
    input wire logic       pulse_i,
    input wire logic       full_i,
    input wire logic       halve_i,
    input wire logic [7:0] rate_i,
    input wire logic       cut_i
);

  localparam int unsigned Clk = 10;  // value of WidthCycles
  localparam int unsigned Half = 2;  // cycles of half an interval at rate 0

  logic low, up;

  `FV_RESET

  ppmc_pulse_shaper #(
      .WidthXtal(Clk),
      .HalfXtal (Half)
  ) dut (
      .clk_i,
      .rst_ni,
      .arm_i,
      .pulse_i,
      .full_i,
      .halve_i,
      .rate_i,
      .cut_i,
      .low_o (low),
      .past_o(up)
  );

  logic [3:0] since_q;  // cycles since the pulse or the arming, saturates at 15
  // pulse_q: the last event was a pulse; full_q: it was a full pulse; may_q: cut_i or halve_i may have ended
  // the low time
  logic pulse_q, full_q, may_q;

  always_ff @(posedge clk_i) begin
    if (!rst_ni) {since_q, pulse_q, full_q, may_q} <= {4'd15, 3'b000};
    else if (pulse_i) {since_q, pulse_q, full_q, may_q} <= {4'd0, 1'b1, full_i, 1'b0};
    else if (arm_i) {since_q, pulse_q} <= '0;
    else begin
      if (since_q != 4'd15) since_q <= since_q + 1'b1;
      may_q <= may_q || cut_i || halve_i;
    end
  end

  // The axis asserts arm_i at the start of a motion, when no pulse is active.
  `FV_ASSUME(arm_at_rest, !(arm_i && (pulse_i || low)))

  `FV_ASSERT(low_whole, !(pulse_q && since_q < 4'(Clk) && (full_q || !may_q)) || low)
  `FV_ASSERT(low_never_longer, !low || (pulse_q && since_q < 4'(Clk)))
  `FV_ASSERT(low_half, !(pulse_q && since_q == 4'(Half) && !full_q && $past(halve_i && rate_i == '0)) || !low)
  `FV_ASSERT(up_in_time, since_q == 4'd15 || up == (since_q >= 4'(Clk - 1)))

  `FV_COVER(seen_whole, pulse_q && full_q && may_q && since_q == 4'(Clk) && $past(low))
  `FV_COVER(seen_cut, pulse_q && !full_q && since_q == 4'(Half) && $past(low) && !low)

endmodule

`default_nettype wire
