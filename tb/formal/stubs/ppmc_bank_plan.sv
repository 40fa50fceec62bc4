// SPDX-License-Identifier: Apache-2.0
// ppmc_bank_plan, stub for the proofs of the blocks that instantiate it: any decision. Its outputs are not
// driven.
`default_nettype none

module ppmc_bank_plan
  import ppmc_bank_pkg::*;
  import ppmc_code_pkg::*;
  import ppmc_motion_pkg::*;
  import ppmc_op_pkg::*;
#(
    parameter int unsigned Quantum  = 25,  // quantum in cycles
    parameter int unsigned Round    = 32,  // round in cycles
    parameter int unsigned TimeBits = 20   // bits of an interval in cycles
) (
    // axis
    input wire motion_state_t motion_i,  // state of the motion
    input wire interval_t interval_i,  // timing of the running interval
    input wire init_state_t init_state_i,  // progress of the initialisation
    input wire output_state_t outputs_i,  // phases, chopper, end of the last motion
    input wire logic hold_end_i,  // the hold time ends with this visit
    input wire pin_status_t pin_status_i,  // pin block and switches
    input wire compare_t compare_i,  // comparisons of this visit
    input wire logic builder_free_i,  // a ramp table may be built
    // command unit
    input wire logic extra_time_i,  // vsel = L in CONFIG
    input wire in_buf_t in_buf_i,  // byte of the host
    input wire logic in_buf_new_i,  // in_buf_i is not yet accepted
    input wire decoded_t decoded_i,  // in_buf_i.data as a code
    input wire cmd_error_e param_error_i,  // error in an initialisation that in_buf_i completes
    input wire parser_state_t parser_i,  // state before this byte
    output parser_state_t parser_o,  // state after this byte
    output logic take_o,  // the byte is accepted
    output logic [7:0] code_o,  // code of the actions in decision_o
    output logic [31:0] params_o,  // parameters of code_o
    // decisions
    input wire logic [TimeBits-1:0] go_delay_i,  // W minus the cycles since GO
    input wire logic [TimeBits-1:0] after_low_i,  // cycles after the low time, minus Round
    output decision_t decision_o,  // decisions of the visit
    output logic restart_time_o,  // restart cycles_left from 0
    output logic [TimeBits-1:0] add_cycles_o  // cycles to add to cycles_left
);

endmodule

`default_nettype wire
