// SPDX-License-Identifier: Apache-2.0
// ppmc_bank_plan, stub for the proofs of the blocks that instantiate it: its outputs are not driven, so the
// proofs hold for any decision.
`default_nettype none

module ppmc_bank_plan
  import ppmc_bank_pkg::*;
  import ppmc_code_pkg::*;
  import ppmc_motion_pkg::*;
  import ppmc_op_pkg::*;
#(
    parameter int unsigned Quantum  = 25,  // quantum (4 crystal cycles) in clock cycles
    parameter int unsigned Round    = 32,  // time between two visits of an axis (a round) in cycles
    parameter int unsigned TimeBits = 20   // width of interval values, which are numbers of cycles
) (
    // axis
    input wire motion_state_t motion_i,  // state of the motion
    input wire interval_t interval_i,  // timing of the running interval
    input wire init_state_t init_state_i,  // progress of the initialisation
    input wire output_state_t outputs_i,  // phases, chopper, end of the last motion
    input wire logic hold_end_i,  // 1: the hold time ends in this visit
    input wire pin_status_t pin_status_i,  // pin block and switches
    input wire compare_t compare_i,  // comparisons of this visit
    input wire logic builder_free_i,  // 1: the builder of ramp tables is free
    // command unit
    input wire logic extra_time_i,  // 1: extra time (vsel low in CONFIG)
    input wire in_buf_t in_buf_i,  // byte from the host
    input wire logic in_buf_new_i,  // 1: in_buf_i has not been accepted yet
    input wire decoded_t decoded_i,  // in_buf_i.data decoded as a code
    input wire cmd_error_e param_error_i,  // error of an initialisation whose last byte is in_buf_i
    input wire parser_state_t parser_i,  // state of the parser before the byte
    output parser_state_t parser_o,  // state of the parser after the byte
    output logic take_o,  // 1: the byte is accepted
    output logic [7:0] code_o,  // code of the command in decision_o
    output logic [31:0] params_o,  // parameters of code_o
    // decisions
    input wire logic [TimeBits-1:0] after_low_i,  // cycles from end of low time to next pulse, minus Round
    output decision_t decision_o,  // decisions of the visit
    output logic restart_time_o,  // 1: clear cycles_left before add_cycles_o is added
    output logic [TimeBits-1:0] add_cycles_o  // cycles that are added to cycles_left
);

endmodule

`default_nettype wire
