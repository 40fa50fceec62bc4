// SPDX-License-Identifier: Apache-2.0
// pmc006_position: position counter, and register with the position of the last stall.
// Rules:  P006-MOT-05, P006-CMD-19/24/30, P006-STA-15, P006-STL-02/04.
// Timing: pos_o and stall_o change at the edge that ends the cycle of step_i, set_i or mark_i.
// Assumes: set_i and step_i are not high in the same cycle.
`include "ppmc_assert.svh"
`default_nettype none

module pmc006_position (
    input  wire logic        clk_i,
    input  wire logic        rst_ni,
    input  wire logic        step_i,     // strobe: count a step
    input  wire logic        forward_i,  // 1: count up, 0: count down
    input  wire logic        set_i,      // strobe: write data_i to pos_o
    input  wire logic [31:0] data_i,     // new position; valid with set_i
    input  wire logic        mark_i,     // strobe: a stall; copy pos_o to stall_o
    output logic      [31:0] pos_o,      // position
    output logic      [31:0] stall_o     // position of the last stall
);

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      pos_o   <= '0;
      stall_o <= '0;
    end else begin
      if (set_i) pos_o <= data_i;
      else if (step_i) pos_o <= pos_o + {{31{!forward_i}}, 1'b1};
      if (mark_i) stall_o <= pos_o;
    end
  end

`ifndef SYNTHESIS
  `PPMC_ASSERT(p006_sta_15, !(set_i && step_i))
`endif

endmodule

`default_nettype wire
