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
    input  wire plan_t                   plan_i,      // decision of the visit
    input  wire seen_t                   seen_i,      // cell and switches as sampled by the visit
    input  wire logic     [         7:0] code_i,      // code of the action
    input  wire logic     [        31:0] params_i,    // parameters of the action
    input  wire logic     [         1:0] config_ni,   // vsel and csel, inverted
    input  wire logic     [         1:0] read_seq_i,  // last answer that the host has read
    // state before the visit
    input  wire walk_t                   walk_i,      // motion
    input  wire pace_t                   pace_i,      // interval
    input  wire setting_t                setting_i,   // initialisation
    input  wire units_t                  units_i,     // chopper
    input  wire logic                    chop_i,      // the initialisation enables chopping
    input  wire logic     [         7:0] slow_i,      // start-up rate
    input  wire rest_t                   rest_i,      // outputs
    input  wire logic     [HoldBits-1:0] left_i,      // remaining rounds of the hold time, minus 1
    input  wire logic     [        31:0] position_i,  // CW pulses minus CCW pulses
    // state after the visit
    output walk_t                        walk_o,      // motion
    output pace_t                        pace_o,      // interval
    output setting_t                     setting_o,   // initialisation
    output rest_t                        rest_o,      // outputs
    output logic          [HoldBits-1:0] left_o,      // remaining rounds of the hold time, minus 1
    output logic          [        31:0] position_o,  // CW pulses minus CCW pulses
    // outputs of the visit
    output order_t                       order_o,     // to the pin cell
    output answer_t                      answer_o,    // with plan_i.read
    output logic                         call_o,      // set the interrupt
    output logic                         calm_o       // clear the interrupt
);

endmodule

`default_nettype wire
