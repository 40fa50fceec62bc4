// SPDX-License-Identifier: Apache-2.0
// ppmc_motor_port_fv: proves that pulse, phases and direction change at the same edge, and that the phases
// are not chopped while the motor moves.
`include "ppmc_fv.svh"
`default_nettype none

module ppmc_motor_port_fv
  import ppmc_motion_pkg::*;
(
    input wire logic clk_i,
    input wire logic busy_i,
    input wire logic low_i,
    input wire logic step_i,
    input wire logic ccw_i,
    input wire logic quantum_i,
    input wire logic half_i,
    input wire logic positive_i,
    input wire logic phase_init_i,
    input wire logic off_i,
    input wire logic chop_i,
    input wire logic chop_restart_i
);

  motor_e motor_i;
  logic [5:1] levels_o, s_o;
  logic hold_o, pout_no, dir_o;

  assign motor_i = Motor5;

  `FV_RESET

  ppmc_motor_port #(
      .HoldQuanta(3),
      .UnitQuanta(2),
      .BaseBits  (2),
      .PhaseIdle (1'b1)
  ) dut (
      .on_base_i   (2'd1),
      .off_base_i  (2'd2),
      .on_units_i  (8'd1),
      .off_units_i (8'd0),
      .hold_units_i(1'b0),
      .*
  );

  logic moved_q;  // 1: a motion has begun
  always_ff @(posedge clk_i) moved_q <= rst_ni && (moved_q || busy_i);

  logic homed_q;
  always_ff @(posedge clk_i) homed_q <= rst_ni && (phase_init_i || (homed_q && !off_i));

  `FV_ASSUME(motor_stays, !homed_q || $past(phase_init_i) || half_i == $past(half_i))
  `FV_ASSUME(polarity_of_reset, homed_q || phase_init_i || !positive_i)

  `FV_ASSERT(p104_tim_04_pulse_one_clk_behind, !$past(rst_ni) || pout_no == $past(!low_i))
  `FV_ASSERT(p104_tim_04_direction_one_clk_behind, !$past(rst_ni) || dir_o == $past(ccw_i))
  `FV_ASSERT(p104_sw_01_full_while_moving, !$past(rst_ni && busy_i) || s_o == $past(levels_o))
  `FV_ASSERT(p104_phs_01_whole_or_off, !$past(rst_ni) || s_o == $past(levels_o) || s_o == {5{$past
             (!positive_i)}})
  `FV_ASSERT(p104_phs_05_idle_level, homed_q || $past(homed_q, 1) || $past(homed_q, 2) || s_o == '1 || $past
             (positive_i))
  `FV_ASSERT(p104_end_08_no_hold_in_motion, !$past(rst_ni && busy_i) || !hold_o)
  `FV_COVER(seen_chopped_hold, moved_q && hold_o && s_o == '0 && levels_o == 5'b00110)

endmodule

`default_nettype wire
