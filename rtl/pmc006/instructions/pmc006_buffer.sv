// SPDX-License-Identifier: Apache-2.0
// pmc006_buffer: RAM with a copy of the first kilobyte of the EEPROM. It contains the parameters (bytes 0
//         .. 31) and the user program (200 words from byte 32 on).
// Rules:  P006-PRG-01/02; memory map: docs/pmc006/README.md, 14.
// Timing: word_o follows the address by two cycles. The address is word_addr_i if claim_i = 1, byte_addr_i
//         / 4 otherwise. byte_o and pair_o are selected from word_o by bits 1:0 of byte_addr_i, without a
//         delay.
`default_nettype none

module pmc006_buffer (
    input  wire logic        clk_i,
    // executor: words of the user program
    input  wire logic        claim_i,      // 1: the address is word_addr_i
    input  wire logic [ 7:0] word_addr_i,  // word of the program, 0 .. 199; at 200, word_o is not used
    input  wire logic        put_i,        // strobe: write data_i to word_addr_i
    input  wire logic [31:0] data_i,       // word; valid with put_i
    output logic      [31:0] word_o,       // word at the address
    // EEPROM: bytes
    input  wire logic [ 9:0] byte_addr_i,  // byte address in the image
    input  wire logic        we_i,         // strobe: write byte_i to byte_addr_i
    input  wire logic [ 7:0] byte_i,       // byte; valid with we_i
    output logic      [ 7:0] byte_o,       // byte at byte_addr_i
    output logic      [15:0] pair_o        // {byte at byte_addr_i + 1, byte_o}, if byte_addr_i is even
);

  logic [7:0] word_addr, raddr, waddr;
  logic [3:0][7:0] lanes, wdata;
  logic [3:0] we;

  assign word_addr = {word_addr_i[7:3] + 5'd1, word_addr_i[2:0]};
  assign raddr = claim_i ? word_addr : byte_addr_i[9:2];
  assign waddr = put_i ? word_addr : byte_addr_i[9:2];

  always_comb begin
    wdata = put_i ? data_i : {4{byte_i}};
    we    = put_i ? 4'b1111 : '0;
    if (we_i) we[byte_addr_i[1:0]] = 1'b1;
  end

  for (genvar lane = 0; lane < 4; lane++) begin : g_lane
    ppmc_ram #(
        .Width   (8),
        .AddrBits(8)
    ) u_ram (
        .clk_i,
        .we_i   (we[lane]),
        .waddr_i(waddr),
        .wdata_i(wdata[lane]),
        .raddr_i(raddr),
        .rdata_o(lanes[lane])
    );
  end

  assign word_o = lanes;
  assign byte_o = lanes[byte_addr_i[1:0]];
  assign pair_o = {lanes[{byte_addr_i[1], 1'b1}], byte_o};

endmodule

`default_nettype wire
