// SPDX-License-Identifier: Apache-2.0
// pmc006_ext_stop: detects the enabled edges of the emergency switches EXT1 and EXT2, and stores the EXT
//         flags.
// Rules:  P006-EXT-01..11, P006-STA-14/17, P006-BAD-21/26.
// Timing: event_o is high in the cycle in which the synchronised level differs from the level in the
//         previous cycle. flags_o follows event_o by one cycle. If an edge and clear_i occur in the same
//         cycle, the flag is set.
`default_nettype none

module pmc006_ext_stop (
    input  wire logic       clk_i,
    input  wire logic       rst_ni,
    input  wire logic [1:0] ext_i,     // pins, synchronised; [0]: EXT1, [1]: EXT2
    input  wire logic [1:0] rising_i,  // TRIGM; 1: rising edge, 0: falling edge
    input  wire logic [1:0] enable_i,  // EXTEN; 1: enabled
    input  wire logic [1:0] clear_i,   // strobes: clear the flag
    output logic            event_o,   // strobe: a flag is set at the next rising edge
    output logic      [1:0] flags_o    // EXT flags, [0]: EXT1, [1]: EXT2
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
