// SPDX-License-Identifier: Apache-2.0
// ppmc_bank_update, stub for the proofs of the blocks that instantiate it: any result of a visit. Its outputs
// are not driven.
`default_nettype none

module ppmc_bank_update
  import ppmc_bank_pkg::*;
  import ppmc_code_pkg::*;
  import ppmc_motion_pkg::*;
  import ppmc_op_pkg::*;
#(
    parameter int unsigned HoldRounds = 106_250,  // rounds from the end of a motion to HOLD
    parameter int unsigned HoldBits   = 17
) (
    input  wire decision_t                    decision_i,    // decision of the visit
    input  wire pin_status_t                  pin_status_i,  // cell and switches as sampled by the visit
    input  wire logic          [         7:0] code_i,        // code of the action
    input  wire logic          [        31:0] params_i,      // parameters of the action
    input  wire logic          [         1:0] config_ni,     // vsel and csel, inverted
    input  wire logic          [         1:0] read_seq_i,    // last answer that the host has read
    // state before the visit
    input  wire motion_state_t                motion_i,      // motion
    input  wire interval_t                    interval_i,    // interval
    input  wire init_state_t                  init_state_i,  // initialisation
    input  wire chop_units_t                  chop_units_i,  // chopper
    input  wire logic                         chop_i,        // the initialisation enables chopping
    input  wire logic          [         7:0] slow_i,        // start-up rate
    input  wire output_state_t                outputs_i,     // outputs
    input  wire logic          [HoldBits-1:0] hold_left_i,   // remaining rounds of the hold time, minus 1
    input  wire logic          [        31:0] position_i,    // CW pulses minus CCW pulses
    // state after the visit
    output motion_state_t                     motion_o,      // motion
    output interval_t                         interval_o,    // interval
    output init_state_t                       init_state_o,  // initialisation
    output output_state_t                     outputs_o,     // outputs
    output logic               [HoldBits-1:0] hold_left_o,   // remaining rounds of the hold time, minus 1
    output logic               [        31:0] position_o,    // CW pulses minus CCW pulses
    // outputs of the visit
    output pin_cmd_t                          pin_cmd_o,     // to the pin cell
    output read_data_t                        read_data_o,   // with plan_i.read
    output logic                              irq_set_o,     // set the interrupt
    output logic                              irq_clear_o    // clear the interrupt
);

endmodule

`default_nettype wire
