// SPDX-License-Identifier: Apache-2.0
// ppmc_command_check_fv: proves that a faulty byte causes no action, that a byte causes at most one action,
// and that no operation starts during a motion or before the initialisation.
`include "ppmc_fv.svh"
`default_nettype none

module ppmc_command_check_fv
  import ppmc_code_pkg::*;
(
    input wire logic             clk_i,
    input wire logic             take_i,
    input wire logic             command_i,
    input wire logic       [7:0] byte_i,
    input wire logic       [7:0] data_i,
    input wire decoded_t         decoded_i,
    input wire cmd_error_e       param_error_i,
    input wire logic             is_checked_i,
    input wire logic             ended_i,
    input wire logic             ramp_i,
    input wire logic             decelerating_i,
    input wire logic             initialised_i
);

  parser_state_t parser_o, parser_i;
  action_t act_o;
  logic stop_o, busy_i;

  `FV_RESET

  ppmc_command_check dut (.*);

  // Models of the surrounding blocks: the register of the parser state, and a motion that the byte starts.
  always_ff @(posedge clk_i) busy_i <= rst_ni && (act_o.start || (busy_i && !ended_i));
  always_ff @(posedge clk_i) parser_i <= rst_ni ? parser_o : '0;

  `FV_ASSUME(known_kind, decoded_i.kind <= CmdAuxOff && decoded_i.params <= 3'd4)
  `FV_ASSUME(params_fit_the_kind,
             decoded_i.params == '0 || decoded_i.kind inside {CmdInit, CmdOperation, CmdSwitching, CmdAuxOut})
  // Of the codes with parameters, only operations have bit 6 = 1. AUX OUT has bits 7 and 1 = 1.
  `FV_ASSUME(codes_with_parameters,
             !(command_i && decoded_i.params != '0 && decoded_i.kind == CmdOperation) || byte_i[6])
  `FV_ASSUME(other_codes,
             !(command_i && decoded_i.params != '0 && decoded_i.kind != CmdOperation) || !byte_i[6])
  `FV_ASSUME(one_kind_in_motion, !(command_i && decoded_i.kind == CmdAuxOut) || (byte_i[7] && byte_i[1]))

  logic welcome;  // 1: the code is allowed during a motion
  assign welcome = decoded_i.kind inside {CmdHalt, CmdDecel, CmdAuxOut, CmdExcOff, CmdAuxOn, CmdAuxOff};

  `FV_ASSERT(p104_err_03_a_fault_does_nothing, !(take_i && parser_o.error) || act_o == '0)
  `FV_ASSERT(one_action, (act_o & (act_o - 1'b1)) == '0)
  `FV_ASSERT(nothing_without_a_byte, take_i || (act_o == '0 && parser_o == parser_i))
  `FV_ASSERT(p104_err_01_not_before_the_initialisation, !(act_o.start && command_i) || initialised_i)
  `FV_ASSERT(p104_err_01_busy_takes_stops_alone,
             !(take_i && command_i && busy_i && !parser_o.error) || welcome)
  `FV_ASSERT(p104_stp_02_no_stop_at_rest, !((act_o.halt || act_o.decel) && !busy_i))
  `FV_ASSERT(p104_sta_05_parameters_count_down,
             !(take_i && !command_i && !parser_o.error) || parser_o.number == parser_i.number - 1'b1)
  `FV_ASSERT(p104_err_00_data_nobody_wants,
             !(take_i && !command_i && (parser_i.error || parser_i.number == '0)) || parser_o.error)
  `FV_COVER(seen_operation_of_three, act_o.start && !command_i)
  `FV_COVER(seen_error_in_motion, take_i && busy_i && parser_o.error && parser_o.number == ErrDataBusy)

endmodule

`default_nettype wire
