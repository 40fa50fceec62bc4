// SPDX-License-Identifier: Apache-2.0
// pmc006_base_rom: look-up table of the base code RB = (416 + 153 * k) / 16, with k = (current - 325 mA) /
//         150 mA. Both divisions round down.
// Rules:  P006-EXC-20.
// Timing: base_o follows current_i by one cycle.
`default_nettype none

module pmc006_base_rom (
    input  wire logic        clk_i,
    input  wire logic [11:0] current_i,  // current in mA, 400 .. 4000
    output logic      [ 7:0] base_o      // base code RB, 26 .. 255
);

  localparam int unsigned MinMa = 325;
  localparam int unsigned MaxMa = 4000;

  function automatic logic [4095:0][7:0] base_table();
    logic [4095:0][7:0] words;
    for (int unsigned i = 0; i < 4096; i++) begin
      words[12'(i)] = (i < MinMa || i > MaxMa) ? '0 : 8'((416 + 153 * ((i - MinMa) / 150)) / 16);
    end
    return words;
  endfunction

  localparam logic [4095:0][7:0] BaseTable = base_table();

  (* rom_style = "block" *)
  logic [7:0] rom[4096];

  // Two blocks, because some tools unroll at most 4000 iterations in a block.
  for (genvar half = 0; half < 2; half++) begin : g_half
    initial for (int unsigned i = 0; i < 2048; i++) rom[2048*half+i] = BaseTable[12'(2048*half+i)];
  end

  always_ff @(posedge clk_i) base_o <= rom[current_i];

endmodule

`default_nettype wire
