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
    input  wire walk_t                   walk_i,     // state of the motion
    input  wire pace_t                   pace_i,     // interval of the motion
    input  wire setting_t                setting_i,  // state of the initialisation
    input  wire rest_t                   rest_i,     // state of the outputs
    input  wire logic                    over_i,     // the hold time ends with this visit
    input  wire seen_t                   seen_i,     // cell and switches
    input  wire facts_t                  facts_i,    // comparisons
    input  wire logic                    free_i,     // a ramp table may be built
    // its command unit
    input  wire logic                    extra_i,    // vsel = L in CONFIG
    input  wire mail_t                   mail_i,     // byte from the host
    input  wire logic                    new_i,      // the byte has not been accepted yet
    input  wire decoded_t                decoded_i,  // decoded byte
    input  wire error_e                  value_i,    // error of an initialisation that the byte completes
    input  wire asking_t                 asking_i,   // parser state before the byte
    output asking_t                      asking_o,   // parser state after the byte
    output logic                         take_o,     // the byte is accepted
    output logic          [         7:0] code_o,     // code of the action
    output logic          [        31:0] params_o,   // parameters of the action
    // decisions
    input  wire logic     [TimeBits-1:0] due_i,      // W minus the cycles since GO
    input  wire logic     [TimeBits-1:0] after_i,    // see ppmc_bank_interval_rom
    output plan_t                        plan_o,     // decision
    output logic                         anew_o,     // restart rem from 0
    output logic          [TimeBits-1:0] add_o       // cycles to add to rem
);

endmodule

`default_nettype wire
