// SPDX-License-Identifier: Apache-2.0
// pmc006_calc_words: memory of pmc006_calc. Contains constants, tables, and words that the program writes.
// Rules:  P006-MOT-10..23, which define the constants.
// Timing: word_o follows raddr_i by one cycle.
// Assumes: no address is read in the cycle in which it is written.
`default_nettype none

module pmc006_calc_words
  import pmc006_calc_pkg::*;
(
    input  wire logic        clk_i,
    input  wire logic        we_i,     // strobe: write data_i
    input  wire logic [ 3:0] waddr_i,  // address of a writable word (M… of operand_e)
    input  wire logic [31:0] data_i,   // word; valid with we_i
    input  wire logic [ 6:0] raddr_i,  // operand_e; for a table, bits 2:0 are the coefficient
    output logic      [31:0] word_o    // word at raddr_i; 0 if raddr_i is a register
);

  function automatic logic [31:0] init_word(logic [6:0] addr);
    unique case (addr)
      K1:      return 32'd1;
      K3:      return 32'd3;
      K4:      return 32'd4;
      K100:    return 32'd100;
      K20000:  return 32'd20000;
      K54400:  return 32'd54400;
      K3x2p16: return 32'd196608;
      K2p31:   return 32'h8000_0000;
      default: begin
        if (addr[6:3] == RRate[6:3]) return 32'd17 << addr[2:0];
        if (addr[6:3] == RWay[6:3]) return 32'd3400 << addr[2:0];
        return '0;
      end
    endcase
  endfunction

  function automatic logic [127:0][31:0] init_words();
    logic [127:0][31:0] table_words;
    for (int unsigned i = 0; i < 128; i++) table_words[7'(i)] = init_word(7'(i));
    return table_words;
  endfunction

  localparam logic [127:0][31:0] InitWords = init_words();

  (* ram_style = "block", no_rw_check *)
  logic [31:0] words[128];

  initial for (int unsigned i = 0; i < 128; i++) words[i] = InitWords[7'(i)];

  always_ff @(posedge clk_i) begin
    if (we_i) words[{3'b000, waddr_i}] <= data_i;
    word_o <= words[raddr_i];
  end

endmodule

`default_nettype wire
