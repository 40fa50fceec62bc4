// SPDX-License-Identifier: Apache-2.0
// ppmc_excitation_fv: proves that the phases are always off or a row of the tables in the manual, and that
// each step moves by one row in its direction.
`include "ppmc_fv.svh"
`default_nettype none

module ppmc_excitation_fv
  import ppmc_motion_pkg::*;
(
    input wire logic       clk_i,
    input wire logic [1:0] motor_code_i,
    input wire logic       half_i,
    input wire logic       phase_init_i,
    input wire logic       off_i,
    input wire logic       step_i,
    input wire logic       ccw_i
);

  motor_e motor_i;
  logic [5:1] pattern_o, row;

  assign motor_i = motor_e'(motor_code_i);

  `FV_RESET

  ppmc_excitation dut (.*);

  // Row of the half-step table, which has two rows per full step. In row 0, S1 and S2 are on.
  logic on_q;
  logic [3:0] index_q, length, stride;

  assign length = 4'd2 * (4'(motor_code_i) + 4'd2);  // rows of the half-step table: 6, 8 or 10
  assign stride = half_i ? 4'd1 : 4'd2;

  always_ff @(posedge clk_i)
    if (!rst_ni) {on_q, index_q} <= '0;
    else if (phase_init_i || off_i) {on_q, index_q} <= {phase_init_i, 4'd0};
    else if (step_i && ccw_i) index_q <= (index_q < stride) ? index_q + length - stride : index_q - stride;
    else if (step_i) index_q <= (index_q + stride >= length) ? index_q + stride - length : index_q + stride;

  // Even rows have two adjacent phases. Odd rows have one phase (3- and 4-phase motors) or three phases
  // (5-phase motors).
  logic [3:0] one, two, three;  // numbers of three adjacent phases (0: S1); `one` follows from index_q

  assign one   = {1'b0, index_q[3:1]};
  assign two   = (one + 4'd1 == (length >> 1)) ? 4'd0 : one + 4'd1;
  assign three = (two + 4'd1 == (length >> 1)) ? 4'd0 : two + 4'd1;

  always_comb begin
    for (int unsigned p = 0; p < 5; p++) begin
      row[p+1] = 4'(p) == two;
      if (!index_q[0] || motor_i == Motor5) row[p+1] |= 4'(p) == one;
      if (index_q[0] && motor_i == Motor5) row[p+1] |= 4'(p) == three;
    end
  end

  `FV_ASSUME(a_motor, motor_i != MotorNone)
  // ppmc_setup loads motor_i and half_i only in the first initialisation, which sets the phases to index 0.
  // It keeps them until Excitation OFF.
  `FV_ASSUME(motor_stays, !on_q || $past(phase_init_i) || {motor_i, half_i} == $past({motor_i, half_i}))

  `FV_ASSERT(p104_phs_01_row_of_the_table, pattern_o == (on_q ? row : 5'd0))
  `FV_ASSERT(p104_phs_05_off_until_home, on_q || pattern_o == '0)
  `FV_COVER(seen_turn_of_five, on_q && motor_i == Motor5 && half_i && index_q == 4'd9)
  `FV_COVER(seen_back_of_three, on_q && motor_i == Motor3 && !half_i && index_q == 4'd4 && ccw_i)

endmodule

`default_nettype wire
