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
    parameter int unsigned Quantum  = 25,  // cycles
    parameter int unsigned Round    = 32,  // cycles
    parameter int unsigned TimeBits = 20
) (
    // the axis
    input wire motion_state_t motion_i,  // state of the motion
    input wire interval_t interval_i,  // interval of the motion
    input wire init_state_t init_state_i,  // state of the initialisation
    input wire output_state_t outputs_i,  // state of the outputs
    input wire logic hold_end_i,  // the hold time ends with this visit
    input wire pin_status_t pin_status_i,  // cell and switches
    input wire compare_t compare_i,  // comparisons
    input wire logic builder_free_i,  // a ramp table may be built
    // its command unit
    input wire logic extra_time_i,  // vsel = L in CONFIG
    input wire in_buf_t in_buf_i,  // byte from the host
    input wire logic in_buf_new_i,  // the byte has not been accepted yet
    input wire decoded_t decoded_i,  // decoded byte
    input wire error_e value_i,  // error of an initialisation that the byte completes
    input wire asking_t asking_i,  // parser state before the byte
    output asking_t asking_o,  // parser state after the byte
    output logic take_o,  // the byte is accepted
    output logic [7:0] code_o,  // code of the action
    output logic [31:0] params_o,  // parameters of the action
    // decisions
    input wire logic [TimeBits-1:0] go_delay_i,  // W minus the cycles since GO
    input wire logic [TimeBits-1:0] after_low_i,  // see ppmc_bank_interval_rom
    output decision_t decision_o,  // decision
    output logic restart_time_o,  // restart rem from 0
    output logic [TimeBits-1:0] add_cycles_o  // cycles to add to rem
);

endmodule

`default_nettype wire
