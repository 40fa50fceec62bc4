// SPDX-License-Identifier: Apache-2.0
// ppmc_bank_engine, a stand-in for the proof of who holds one: any orders, interrupts and answers. Its outputs are
// driven by nobody.
`default_nettype none

module ppmc_bank_engine
  import ppmc_bank_pkg::*;
  import ppmc_code_pkg::error_e;
  import ppmc_code_pkg::decoded_t;
  import ppmc_code_pkg::init_code_t;
#(
    parameter int unsigned Quantum   = 25,    // clk
    parameter int unsigned TimeBits  = 18,    // of an interval in clk
    parameter bit          PhaseIdle = 1'b1,
    parameter int unsigned RoundBits = 5
) (
    input wire logic clk_i,
    input wire logic rst_ni,
    input wire logic [5:0][RoundBits-1:0] axis_i,  // whose visit is in stage 0, 1 …
    input wire logic [4:3] clear_i,  // those in stages 3 and 4 reset their axes
    // from the window
    input wire mail_t mail_i,  // stage 1: input buffer
    input wire progress_t progress_i,  // stage 1: how far its answer has been read
    input wire logic [1:0] config_ni,  // stage 1: vsel and csel, inverted
    input wire logic go_i,  // stage 2: GO acts
    input wire logic [TimeBits-1:0] due_i,  // W less the clk since then
    // from cells and switches
    input wire seen_t seen_i,  // stage 2
    // what a visit leaves, stage 5
    output status_t status_o,  // for the status register
    output logic [31:0] position_o,  // position
    output logic answer_we_o,  // there is an answer
    output answer_t answer_o,  // this one
    output order_t order_o,  // to the pin cell
    output logic [RoundBits-1:0] at_o,  // clk of its edge
    output logic call_o,  // an interrupt is pending from now on
    output logic calm_o  // and no more
);

endmodule

`default_nettype wire
