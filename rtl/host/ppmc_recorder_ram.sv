// SPDX-License-Identifier: Apache-2.0
// ppmc_recorder_ram: the records: RAM with one port, so that the large RAMs of an iCE40 UP5K (SPRAM) can be it.
// Timing: rdata_o stands one clk after addr_i in a clk without we_i; undefined behind one with it.
// Note:   contents are neither reset nor known at first.
`default_nettype none

module ppmc_recorder_ram #(
    parameter int unsigned Width    = 64,
    parameter int unsigned AddrBits = 10
) (
    input  wire logic                clk_i,
    input  wire logic                we_i,     // write at the coming edge, else read
    input  wire logic [AddrBits-1:0] addr_i,   // where
    input  wire logic [   Width-1:0] wdata_i,  // what
    output logic      [   Width-1:0] rdata_o   // what stands there, one clk later
);

  localparam int unsigned SingleBits = 14;  // so many address bits has an SPRAM

  if (AddrBits >= SingleBits) begin : g_single
    (* ram_style = "huge" *)
    logic [Width-1:0] mem[2**AddrBits];

    always_ff @(posedge clk_i) begin
      if (we_i) mem[addr_i] <= wdata_i;
      else rdata_o <= mem[addr_i];
    end
  end else begin : g_block
    (* ram_style = "block" *)
    logic [Width-1:0] mem[2**AddrBits];

    always_ff @(posedge clk_i) begin
      if (we_i) mem[addr_i] <= wdata_i;
      else rdata_o <= mem[addr_i];
    end
  end

endmodule

`default_nettype wire
