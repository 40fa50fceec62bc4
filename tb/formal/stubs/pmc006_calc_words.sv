// SPDX-License-Identifier: Apache-2.0
// pmc006_calc_words, stub for proofs that hold for any operands.
`default_nettype none

module pmc006_calc_words (
    input  wire logic        clk_i,
    input  wire logic        we_i,
    input  wire logic [ 3:0] waddr_i,
    input  wire logic [31:0] data_i,
    input  wire logic [ 6:0] raddr_i,
    output logic      [31:0] word_o
);
  logic [31:0] any;  // not driven; the register ensures that all blocks read the same value
  always_ff @(posedge clk_i) word_o <= any;

endmodule

`default_nettype wire
