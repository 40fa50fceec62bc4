// SPDX-License-Identifier: Apache-2.0
// ppmc_hold_timer_fv: proves that hold_o rises 1 + RestCycles cycles after the last quantum of the hold
// time, and falls when a motion begins.
`include "ppmc_fv.svh"
`default_nettype none

module ppmc_hold_timer_fv (
    input wire logic       clk_i,
    input wire logic       busy_i,
    input wire logic       quantum_i,
    input wire logic [1:0] units_i
);

  logic fixed_o, rested_o, set_o;

  `FV_RESET

  ppmc_hold_timer #(
      .Quanta(5)
  ) u_fixed (
      .units_i(1'b0),
      .hold_o (fixed_o),
      .*
  );

  ppmc_hold_timer #(
      .Quanta(5),
      .RestCycles(2)
  ) u_rested (
      .units_i(1'b0),
      .hold_o (rested_o),
      .*
  );

  ppmc_hold_timer #(
      .Quanta  (4),
      .UnitBits(2)
  ) u_set (
      .hold_o(set_o),
      .*
  );

  logic moved_q;  // 1: a motion has begun
  logic [1:0] units_q;
  logic [4:0] quanta_q;  // quanta since the end of the motion, saturates at 31
  logic [1:0] behind_q;  // cycles after quantum 5, saturates at 3
  logic [1:0] gap_q;  // cycles since the last quantum, saturates at 3
  logic set_q;  // 1: one cycle ago, quanta_q had reached the set hold time

  always_ff @(posedge clk_i)
    if (!rst_ni) {moved_q, units_q, quanta_q, behind_q, gap_q, set_q} <= '0;
    else begin
      gap_q <= quantum_i ? '0 : (gap_q == '1) ? '1 : gap_q + 1'b1;
      set_q <= quanta_q >= 5'd4 * (5'(units_q) + 5'd1);
      if (busy_i) {moved_q, units_q, quanta_q, behind_q, set_q} <= {1'b1, units_i, 8'd0};
      else begin
        if (quantum_i && quanta_q != '1) quanta_q <= quanta_q + 1'b1;
        if (quanta_q >= 5'd5 && behind_q != '1) behind_q <= behind_q + 1'b1;
      end
    end

  `FV_ASSUME(rest_shorter_than_a_quantum, !quantum_i || gap_q == '1)

  `FV_ASSERT(falls_with_a_motion, !$past(rst_ni && busy_i) || !(fixed_o || rested_o || set_o))
  `FV_ASSERT(p104_end_08_fixed, !moved_q || $past(busy_i) || fixed_o == (behind_q >= 2'd1))
  `FV_ASSERT(p104_end_08_rest, !moved_q || $past(busy_i) || rested_o == (behind_q == 2'd3))
  `FV_ASSERT(p2104_end_07_units, !moved_q || $past(busy_i) || set_o == set_q)
  `FV_ASSERT(holds_after_reset, moved_q || (fixed_o && rested_o && set_o))
  `FV_COVER(seen_three_units, moved_q && set_o && units_q == 2'd2 && !$past(set_o))

endmodule

`default_nettype wire
