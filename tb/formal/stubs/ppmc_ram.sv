// SPDX-License-Identifier: Apache-2.0
// ppmc_ram, stub for proofs that hold for any RAM contents: rdata_o is an unconstrained word in every
// cycle. ppmc_ram_fv proves that the real RAM returns the written word.
`default_nettype none

module ppmc_ram #(
    parameter int unsigned Width    = 16,
    parameter int unsigned AddrBits = 8
) (
    input  wire logic                clk_i,
    input  wire logic                we_i,
    input  wire logic [AddrBits-1:0] waddr_i,
    input  wire logic [   Width-1:0] wdata_i,
    input  wire logic [AddrBits-1:0] raddr_i,
    output logic      [   Width-1:0] rdata_o
);
  logic [Width-1:0] any;  // not driven; the register ensures that all blocks read the same value
  always_ff @(posedge clk_i) rdata_o <= any;

endmodule

`default_nettype wire
