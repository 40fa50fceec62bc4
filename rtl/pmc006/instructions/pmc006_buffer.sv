// SPDX-License-Identifier: Apache-2.0
// pmc006_buffer: image of the first kilobyte of the EEPROM: parameters (bytes 0..31), program (200 words from 32 on).
// Rules:  P006-PRG-01/02, section 13.1.
// Timing: word_o follows the address by two cycles. The address is word_at_i while claim_i is high, else that
//         of byte_at_i. byte_o and pair_o are selected from word_o by the lowest bits of byte_at_i.
`default_nettype none

module pmc006_buffer (
    input  wire logic        clk_i,
    // executor: words of the program
    input  wire logic        claim_i,    // 1: the address is word_at_i
    input  wire logic [ 7:0] word_at_i,  // 0 .. 199; 200 has no effect
    input  wire logic        put_i,      // write data_i to word_at_i
    input  wire logic [31:0] data_i,     // data of put_i
    output logic      [31:0] word_o,     // word of the program
    // EEPROM: bytes
    input  wire logic [ 9:0] byte_at_i,  // byte address in the image
    input  wire logic        we_i,       // write byte_i to byte_at_i
    input  wire logic [ 7:0] byte_i,     // data of we_i
    output logic      [ 7:0] byte_o,     // byte at byte_at_i
    output logic      [15:0] pair_o      // pair at an even byte_at_i
);

  logic [7:0] word_at, read_at, write_at;
  logic [3:0][7:0] lanes, written;
  logic [3:0] we;

  assign word_at  = {word_at_i[7:3] + 5'd1, word_at_i[2:0]};
  assign read_at  = claim_i ? word_at : byte_at_i[9:2];
  assign write_at = put_i ? word_at : byte_at_i[9:2];

  always_comb begin
    written = put_i ? data_i : {4{byte_i}};
    we      = put_i ? 4'b1111 : '0;
    if (we_i) we[byte_at_i[1:0]] = 1'b1;
  end

  for (genvar lane = 0; lane < 4; lane++) begin : g_lane
    ppmc_ram #(
        .Width   (8),
        .AddrBits(8)
    ) u_ram (
        .clk_i,
        .we_i   (we[lane]),
        .waddr_i(write_at),
        .wdata_i(written[lane]),
        .raddr_i(read_at),
        .rdata_o(lanes[lane])
    );
  end

  assign word_o = lanes;
  assign byte_o = lanes[byte_at_i[1:0]];
  assign pair_o = {lanes[{byte_at_i[1], 1'b1}], byte_o};

endmodule

`default_nettype wire
