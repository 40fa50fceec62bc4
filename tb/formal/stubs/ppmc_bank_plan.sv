// SPDX-License-Identifier: Apache-2.0
// ppmc_bank_plan, a stand-in for the proofs of those who hold one: any decision. Its outputs are driven by nobody.
`default_nettype none

module ppmc_bank_plan
  import ppmc_bank_pkg::*;
  import ppmc_code_pkg::*;
  import ppmc_motion_pkg::*;
  import ppmc_op_pkg::*;
#(
    parameter int unsigned Quantum  = 25,  // clk
    parameter int unsigned Round    = 32,  // clk
    parameter int unsigned TimeBits = 20
) (
    // the axis
    input  wire walk_t                   walk_i,     // its motion
    input  wire pace_t                   pace_i,     // pace of that
    input  wire setting_t                setting_i,  // its initialisation
    input  wire rest_t                   rest_i,     // what counts at rest
    input  wire logic                    over_i,     // its hold time ends with this visit
    input  wire seen_t                   seen_i,     // cell and switches
    input  wire facts_t                  facts_i,    // comparisons
    input  wire logic                    free_i,     // a ramp table may be built
    // its command unit
    input  wire logic                    extra_i,    // vsel = L in CONFIG
    input  wire mail_t                   mail_i,     // byte of its host
    input  wire logic                    new_i,      // it has not been taken
    input  wire decoded_t                decoded_i,  // meaning of its byte
    input  wire error_e                  value_i,    // what is wrong with an initialisation that it completes
    input  wire asking_t                 asking_i,   // what is remembered of the bytes before
    output asking_t                      asking_o,   // and after this one
    output logic                         take_o,     // it is taken
    output logic          [         7:0] code_o,     // code of what it makes happen
    output logic          [        31:0] params_o,   // and its parameters
    // decisions
    input  wire logic     [TimeBits-1:0] due_i,      // W less the clk since GO
    input  wire logic     [TimeBits-1:0] after_i,    // see ppmc_bank_times
    output plan_t                        plan_o,     // what is decided
    output logic                         anew_o,     // time_i does not count
    output logic          [TimeBits-1:0] add_o       // to time_i
);

endmodule

`default_nettype wire
