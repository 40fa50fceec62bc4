// SPDX-License-Identifier: Apache-2.0
// pmc006_sine_rom, stub for proofs that hold for any table: sine_o is any value, which stays while the index
// stays.
`default_nettype none

module pmc006_sine_rom (
    input  wire logic       clk_i,
    input  wire logic [7:0] index_i,
    output logic      [8:0] sine_o
);
  logic [8:0] any;  // not driven; the register ensures that all blocks read the same value
  logic [7:0] index_q;
  always_ff @(posedge clk_i) begin
    index_q <= index_i;
    if (index_i != index_q) sine_o <= any;
  end

endmodule

`default_nettype wire
