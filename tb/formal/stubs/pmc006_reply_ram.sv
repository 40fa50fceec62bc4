// SPDX-License-Identifier: Apache-2.0
// pmc006_reply_ram, stub for proofs that hold for any stored value: value_o changes only with sample_i, and is 0
// without a register.
`default_nettype none

module pmc006_reply_ram
  import pmc006_pkg::*;
(
    input  wire logic             clk_i,
    input  wire logic             rst_ni,
    input  wire logic             write_i,
    input  wire register_e        reg_id_i,
    input  wire logic      [13:0] data_i,
    input  wire logic             sample_i,
    output logic           [13:0] value_o
);
  logic [13:0] any;  // not driven; the register ensures that all blocks read the same value
  always_ff @(posedge clk_i) if (sample_i) value_o <= (reg_id_i == RegNone) ? '0 : any;

endmodule

`default_nettype wire
