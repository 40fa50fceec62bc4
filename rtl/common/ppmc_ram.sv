// SPDX-License-Identifier: Apache-2.0
// ppmc_ram: block RAM with one write and one read port.
// Timing: the read latency is two cycles. Block RAM is slow, so its output has an additional register.
// Assumes: no address is read in the cycle in which it is written (the read would return either word).
// Note:   the contents are not reset. They are initially 0, and every user writes a word before reading it.
`default_nettype none

module ppmc_ram #(
    parameter int unsigned Width    = 16,
    parameter int unsigned AddrBits = 8
) (
    input  wire logic                clk_i,
    input  wire logic                we_i,     // strobe: write at the next edge
    input  wire logic [AddrBits-1:0] waddr_i,  // write address
    input  wire logic [   Width-1:0] wdata_i,  // write data
    input  wire logic [AddrBits-1:0] raddr_i,  // read address
    output logic      [   Width-1:0] rdata_o   // word at raddr_i, two cycles later
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
