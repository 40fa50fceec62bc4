// SPDX-License-Identifier: Apache-2.0
// pmc006_calc_rom, stub for proofs that hold for any program.
`default_nettype none

module pmc006_calc_rom
  import pmc006_calc_pkg::*;
(
    input  wire logic       clk_i,
    input  wire logic       fetch_i,
    input  wire logic [8:0] addr_i,
    output instr_t          code_o
);
  logic [16:0] any;  // not driven; the register ensures that all blocks read the same value
  always_ff @(posedge clk_i) if (fetch_i) code_o <= any;

endmodule

`default_nettype wire
