// SPDX-License-Identifier: Apache-2.0
// ppmc_ram: block RAM with one write and one read port.
// Timing: latency: two cycles from raddr_i to rdata_o. Block RAMs are slow, so their output has a register.
// Assumes: no block reads an address in the cycle in which it is written (the read may return either word).
// Note:   contents are not reset; they start as zeros, and every user writes a word before reading it.
`default_nettype none

module ppmc_ram #(
    parameter int unsigned Width    = 16,
    parameter int unsigned AddrBits = 8
) (
    input  wire logic                clk_i,
    input  wire logic                we_i,     // write at the next edge
    input  wire logic [AddrBits-1:0] waddr_i,  // address of the write
    input  wire logic [   Width-1:0] wdata_i,  // data to write
    input  wire logic [AddrBits-1:0] raddr_i,  // address of the read
    output logic      [   Width-1:0] rdata_o   // word at raddr_i, valid two cycles later
);

  (* ram_style = "block", no_rw_check *)
  logic [Width-1:0] mem[2**AddrBits];
  logic [Width-1:0] read_q;

  initial mem = '{default: '0};

  always_ff @(posedge clk_i) begin
    if (we_i) mem[waddr_i] <= wdata_i;
    read_q  <= mem[raddr_i];
    rdata_o <= read_q;
  end

endmodule

`default_nettype wire
