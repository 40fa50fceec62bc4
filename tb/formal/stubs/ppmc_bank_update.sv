// SPDX-License-Identifier: Apache-2.0
// ppmc_bank_update, stub for the proofs of the blocks that instantiate it: its outputs are not driven, so
// the proofs hold for any result of a visit.
`default_nettype none

module ppmc_bank_update
  import ppmc_bank_pkg::*;
  import ppmc_code_pkg::*;
  import ppmc_motion_pkg::*;
  import ppmc_op_pkg::*;
#(
    parameter int unsigned HoldRounds = 106_250,  // rounds from the end of a motion to HOLD
    parameter int unsigned HoldBits = 17  // bits of hold_left_i
) (
    input wire decision_t decision_i,  // decisions of the visit
    input wire pin_status_t pin_status_i,  // pin block and switches
    input wire logic [7:0] code_i,  // code of the command
    input wire logic [31:0] params_i,  // parameters of code_i
    input wire logic [1:0] config_ni,  // vsel and csel, inverted
    input wire logic [1:0] read_seq_i,  // seq of the response that the host has read last
    // state before the visit
    input wire motion_state_t motion_i,  // state of the motion
    input wire interval_t interval_i,  // interval of the motion
    input wire init_state_t init_state_i,  // progress of the initialisation
    input wire chop_units_t chop_units_i,  // units of the chopper phases
    input wire logic chop_i,  // 1: chop at standstill, as set by the initialisation
    input wire logic [7:0] slow_i,  // start-up rate
    input wire output_state_t outputs_i,  // phases, chopper, end of the last motion
    input wire logic [HoldBits-1:0] hold_left_i,  // remaining rounds of the hold time, minus 1
    input wire logic [31:0] position_i,  // CW pulses minus CCW pulses
    // state after the visit
    output motion_state_t motion_o,  // state of the motion
    output interval_t interval_o,  // interval of the motion
    output init_state_t init_state_o,  // progress of the initialisation
    output output_state_t outputs_o,  // phases, chopper, end of the last motion
    output logic [HoldBits-1:0] hold_left_o,  // remaining rounds of the hold time, minus 1
    output logic [31:0] position_o,  // CW pulses minus CCW pulses
    // outputs
    output pin_cmd_t pin_cmd_o,  // command to the pin block
    output read_data_t read_data_o  // response to a read command; valid with decision_i.read
);

endmodule

`default_nettype wire
