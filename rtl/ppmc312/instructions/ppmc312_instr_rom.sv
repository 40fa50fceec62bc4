// SPDX-License-Identifier: Apache-2.0
// ppmc312_instr_rom: look-up table of the properties of instruction codes, and of the kinds of their results.
// Rules:  P312-STA-01, instr_info in ppmc312_pkg, result_kind in ppmc312_instr_pkg.
// Timing: latency 2 cycles, because the slow block RAM has an output register.
`default_nettype none

module ppmc312_instr_rom
  import ppmc312_pkg::*;
  import ppmc312_instr_pkg::*;
(
    input  wire logic            clk_i,   // clock
    input  wire logic      [7:0] code_i,  // instruction code
    output instr_info_t          info_o,  // properties of code_i, two cycles later
    output response_kind_e       kind_o   // response after the execution of code_i, two cycles later
);

  typedef struct packed {
    response_kind_e kind;
    instr_info_t    info;
  } word_t;

  // The table is a constant, because synthesis evaluates the branches of instr_info wrongly in an initial
  // block.
  function automatic word_t [255:0] every_code();
    word_t [255:0] words;
    for (int unsigned i = 0; i < 256; i++) words[8'(i)] = '{result_kind(8'(i)), instr_info(8'(i))};
    return words;
  endfunction

  localparam word_t [255:0] Words = every_code();

  (* rom_style = "block" *)
  word_t rom[256];
  word_t word_q;

  initial for (int unsigned i = 0; i < 256; i++) rom[i] = Words[8'(i)];

  always_ff @(posedge clk_i) begin
    word_q <= rom[code_i];
    {kind_o, info_o} <= word_q;
  end

endmodule

`default_nettype wire
