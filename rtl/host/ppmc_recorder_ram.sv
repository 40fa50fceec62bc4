// SPDX-License-Identifier: Apache-2.0
// ppmc_recorder_ram: RAM of the records. It has only one port, so that the large RAMs (SPRAM) of an iCE40
//         UP5K can be used.
// Timing: if we_i = 0, rdata_o is valid one cycle after addr_i. After a cycle with we_i = 1, rdata_o is
//         undefined.
// Note:   the contents are neither reset nor initialised.
`default_nettype none

module ppmc_recorder_ram #(
    parameter int unsigned Width    = 64,
    parameter int unsigned AddrBits = 10
) (
    input  wire logic                clk_i,
    input  wire logic                we_i,     // 1: write at the next edge, 0: read
    input  wire logic [AddrBits-1:0] addr_i,   // address
    input  wire logic [   Width-1:0] wdata_i,  // write data
    output logic      [   Width-1:0] rdata_o   // word at the addr_i of the previous cycle
);

  localparam int unsigned SingleBits = 14;  // address bits of an SPRAM

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
