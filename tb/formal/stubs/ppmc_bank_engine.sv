// SPDX-License-Identifier: Apache-2.0
// ppmc_bank_engine, stub for the proof of the block that instantiates it: its outputs are not driven, so
// the proof holds for any pin commands, interrupts and responses.
`default_nettype none

module ppmc_bank_engine
  import ppmc_bank_pkg::*;
  import ppmc_code_pkg::cmd_error_e;
  import ppmc_code_pkg::decoded_t;
  import ppmc_code_pkg::init_code_t;
#(
    parameter int unsigned Quantum   = 25,    // quantum (4 crystal cycles) in clock cycles
    parameter int unsigned TimeBits  = 18,    // width of interval values, which are numbers of cycles
    parameter bit          PhaseIdle = 1'b1,  // level of s before the first initialisation
    parameter int unsigned RoundBits = 5      // a round is 2^RoundBits cycles
) (
    input wire logic clk_i,
    input wire logic rst_ni,
    input wire logic [5:0][RoundBits-1:0] axis_i,  // axes in stages 0 to 5
    input wire logic [4:3] clear_i,  // [i] = 1: reset the axis in stage i
    // from the window
    input wire in_buf_t in_buf_i,  // stage 1: input buffer
    input wire read_progress_t read_progress_i,  // stage 1: response bytes that the host has read
    input wire logic [1:0] config_ni,  // stage 1: vsel and csel, inverted
    input wire logic go_i,  // stage 2: GO is active
    input wire logic [RoundBits-1:0] go_left_i,  // stage 2: further cycles for which go_i remains high
    // from pin blocks and switches
    input wire pin_status_t pin_status_i,  // stage 2: pin block and switches
    // results of a visit, stage 5
    output axis_status_t status_o,  // status register
    output logic [31:0] position_o,  // position
    output logic read_data_we_o,  // strobe: write read_data_o
    output read_data_t read_data_o,  // response to a read command
    output pin_cmd_t pin_cmd_o,  // command to the pin block
    output logic [RoundBits-1:0] at_cycle_o,  // cycle of the round in which the pin block executes pin_cmd_o
    output logic irq_pending_o  // 1: the axis has a pending interrupt
);

endmodule

`default_nettype wire
