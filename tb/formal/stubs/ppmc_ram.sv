// SPDX-License-Identifier: Apache-2.0
// ppmc_ram, a stand-in for the proofs of those who hold in it what comes from outside: any word at any time. That the
// real one gives what was written says ppmc_ram_fv.
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
  logic [Width-1:0] any;  // driven by nobody: registered, so that all see the same
  always_ff @(posedge clk_i) rdata_o <= any;

endmodule

`default_nettype wire
