// SPDX-License-Identifier: Apache-2.0
// ppmc_recorder_ram: RAM of the records. It has one port, so that the large RAMs of an iCE40 UP5K (SPRAM) can
//         be used.
// Timing: rdata_o is valid one cycle after addr_i in a cycle without we_i. After a cycle with we_i, rdata_o
//         is undefined.
// Note:   contents are neither reset nor initialised.
`default_nettype none

module ppmc_recorder_ram #(
    parameter int unsigned Width    = 64,
    parameter int unsigned AddrBits = 10
) (
    input  wire logic                clk_i,
    input  wire logic                we_i,     // write at the next edge, else read
    input  wire logic [AddrBits-1:0] addr_i,   // address
    input  wire logic [   Width-1:0] wdata_i,  // write data
    output logic      [   Width-1:0] rdata_o   // word at addr_i, one cycle later
);

  localparam int unsigned SingleBits = 14;  // number of address bits of an SPRAM

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
