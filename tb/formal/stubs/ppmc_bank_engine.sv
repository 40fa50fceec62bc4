// SPDX-License-Identifier: Apache-2.0
// ppmc_bank_engine, stub for the proof of the block that instantiates it: any orders, interrupts and answers.
// Its outputs are not driven.
`default_nettype none

module ppmc_bank_engine
  import ppmc_bank_pkg::*;
  import ppmc_code_pkg::error_e;
  import ppmc_code_pkg::decoded_t;
  import ppmc_code_pkg::init_code_t;
#(
    parameter int unsigned Quantum   = 25,    // cycles
    parameter int unsigned TimeBits  = 18,    // bits of an interval in cycles
    parameter bit          PhaseIdle = 1'b1,
    parameter int unsigned RoundBits = 5
) (
    input wire logic clk_i,
    input wire logic rst_ni,
    input wire logic [5:0][RoundBits-1:0] axis_i,  // axes visited in stages 0 to 5
    input wire logic [4:3] clear_i,  // the visits in stages 3 and 4 reset their axes
    // from the window
    input wire in_buf_t in_buf_i,  // stage 1: input buffer
    input wire read_progress_t read_progress_i,  // stage 1: bytes of the answer already read
    input wire logic [1:0] config_ni,  // stage 1: vsel and csel, inverted
    input wire logic go_i,  // stage 2: GO is active
    input wire logic [TimeBits-1:0] go_delay_i,  // W minus the cycles since GO
    // from cells and switches
    input wire pin_status_t pin_status_i,  // stage 2: pin cell and switches
    // results of a visit, stage 5
    output axis_status_t status_o,  // status register
    output logic [31:0] position_o,  // position
    output logic read_data_we_o,  // an answer is written
    output read_data_t read_data_o,  // the answer
    output pin_cmd_t pin_cmd_o,  // order to the pin cell
    output logic [RoundBits-1:0] at_cycle_o,  // cycle of the edge in the round
    output logic irq_set_o,  // set the interrupt
    output logic irq_clear_o  // clear the interrupt
);

endmodule

`default_nettype wire
