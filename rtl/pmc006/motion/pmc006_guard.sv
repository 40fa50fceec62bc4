// SPDX-License-Identifier: Apache-2.0
// pmc006_guard: emergency stops: edges of EXT1 and EXT2, their flags.
// Rules:  section 7.1, P006-STA-14/17, P006-BAD-21/26.
// Timing: event_o in the clk in which the synchronised level differs from that of the clk before; the flag stands
//         from its end on.
`default_nettype none

module pmc006_guard (
    input  wire logic       clk_i,
    input  wire logic       rst_ni,
    input  wire logic [1:0] ext_i,     // synchronised; bit 0 EXT1
    input  wire logic [1:0] rising_i,  // TRIGM
    input  wire logic [1:0] enable_i,  // EXTEN
    input  wire logic [1:0] clear_i,   // the flag goes
    output logic            event_o,   // a flag is being set
    output logic      [1:0] flags_o    // of EXT1, EXT2
);

  logic [1:0] before_q, hit;

  assign hit = enable_i & (ext_i ^ before_q) & ~(ext_i ^ rising_i);
  assign event_o = |hit;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      before_q <= '1;
      flags_o  <= '0;
    end else begin
      before_q <= ext_i;
      flags_o  <= hit | (flags_o & ~clear_i);
    end
  end

endmodule

`default_nettype wire
