// SPDX-License-Identifier: Apache-2.0
// ppmc_ram, stub for the proofs of the whole PPMC-312, which hold for any RAM contents: rdata_o is an
// unconstrained word in every cycle. For covers, the RAM of the write window (5 bits of address) is real,
// and the words of the others are 0, so that a cover needs no search. ppmc_ram_fv proves the real RAM.
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
`ifdef FV_COVERS
  if (AddrBits == 5) begin : g_real
    logic [Width-1:0] memory [2**AddrBits];
    logic [Width-1:0] read_q;
    always_ff @(posedge clk_i) begin
      if (we_i) memory[waddr_i] <= wdata_i;
      {rdata_o, read_q} <= {read_q, memory[raddr_i]};
    end
  end else begin : g_zero
    assign rdata_o = '0;
  end
`else
  logic [Width-1:0] any;  // not driven; the register ensures that all blocks read the same value
  always_ff @(posedge clk_i) rdata_o <= any;
`endif

endmodule

`default_nettype wire
