// SPDX-License-Identifier: Apache-2.0
// ppmc_bank_step, a stand-in for the proofs of those who hold one: anything may come of a visit. Its outputs are driven
// by nobody.
`default_nettype none

module ppmc_bank_step
  import ppmc_bank_pkg::*;
  import ppmc_code_pkg::*;
  import ppmc_motion_pkg::*;
  import ppmc_op_pkg::*;
#(
    parameter int unsigned HoldRounds = 106_250,  // rounds from the end of a motion to HOLD
    parameter int unsigned HoldBits   = 17
) (
    input  wire plan_t                   plan_i,      // what the visit has decided
    input  wire seen_t                   seen_i,      // what it has seen of cell and switches
    input  wire logic     [         7:0] code_i,      // of what a byte makes happen
    input  wire logic     [        31:0] params_i,    // its parameters
    input  wire logic     [         1:0] config_ni,   // vsel and csel, inverted
    input  wire logic     [         1:0] read_seq_i,  // answer that the host has read last
    // before
    input  wire walk_t                   walk_i,      // motion
    input  wire pace_t                   pace_i,      // pace of that
    input  wire setting_t                setting_i,   // initialisation
    input  wire units_t                  units_i,     // chopper
    input  wire logic                    chop_i,      // the initialisation asks for it
    input  wire logic     [         7:0] slow_i,      // start-up rate
    input  wire rest_t                   rest_i,      // what counts at rest
    input  wire logic     [HoldBits-1:0] left_i,      // rounds of the hold time, less 1
    input  wire logic     [        31:0] position_i,  // pulses CW less pulses CCW
    // after
    output walk_t                        walk_o,      // the same
    output pace_t                        pace_o,      // the same
    output setting_t                     setting_o,   // the same
    output rest_t                        rest_o,      // the same
    output logic          [HoldBits-1:0] left_o,      // the same
    output logic          [        31:0] position_o,  // the same
    // to the outside
    output order_t                       order_o,     // to the pin cell
    output answer_t                      answer_o,    // with plan_i.read
    output logic                         call_o,      // an interrupt is pending from now on
    output logic                         calm_o       // and no more
);

endmodule

`default_nettype wire
