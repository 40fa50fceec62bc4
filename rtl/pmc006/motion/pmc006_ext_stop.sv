// SPDX-License-Identifier: Apache-2.0
// pmc006_ext_stop: emergency stops: detects edges of EXT1 and EXT2 and stores their flags.
// Rules:  section 7.1, P006-STA-14/17, P006-BAD-21/26.
// Timing: event_o is high in the cycle in which the synchronised level differs from that of the cycle before.
//         The flag is valid from the end of this cycle.
`default_nettype none

module pmc006_ext_stop (
    input  wire logic       clk_i,
    input  wire logic       rst_ni,
    input  wire logic [1:0] ext_i,     // synchronised; bit 0 EXT1
    input  wire logic [1:0] rising_i,  // TRIGM; 1 = rising edge
    input  wire logic [1:0] enable_i,  // EXTEN; 1 = enabled
    input  wire logic [1:0] clear_i,   // clear the flag
    output logic            event_o,   // a flag is being set
    output logic      [1:0] flags_o    // flags of EXT1, EXT2
);

  logic [1:0] ext_prev_q, hit;

  assign hit = enable_i & (ext_i ^ ext_prev_q) & ~(ext_i ^ rising_i);
  assign event_o = |hit;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      ext_prev_q <= '1;
      flags_o <= '0;
    end else begin
      ext_prev_q <= ext_i;
      flags_o <= hit | (flags_o & ~clear_i);
    end
  end

endmodule

`default_nettype wire
