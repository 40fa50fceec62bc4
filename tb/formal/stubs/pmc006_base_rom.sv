// SPDX-License-Identifier: Apache-2.0
// pmc006_base_rom, stub for proofs that hold for any table.
`default_nettype none

module pmc006_base_rom (
    input  wire logic        clk_i,
    input  wire logic [11:0] current_i,
    output logic      [ 7:0] base_o
);
  logic [7:0] any;  // not driven; the register ensures that all blocks read the same value
  always_ff @(posedge clk_i) base_o <= any;

endmodule

`default_nettype wire
