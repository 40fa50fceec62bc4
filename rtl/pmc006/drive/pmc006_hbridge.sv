// SPDX-License-Identifier: Apache-2.0
// pmc006_hbridge: one motor phase: reference bit stream and chopper with fixed off time, slow and fast decay.
// Rules:  P006-EXC-40, P006-CHP-01..06.
// Timing: en_o and the half bridges change at the rising edge after on_i. A change of the sign puts the
//         bridge into OFF at the next edge. A comparator level sampled at edge t takes effect at edge t + 2.
//         With a reference of 0, OFF is repeated.
`include "ppmc_assert.svh"
`default_nettype none

module pmc006_hbridge #(
    parameter int unsigned OffClk   = 320,  // TOFF, cycles
    parameter int unsigned BlankClk = 16,   // BL, cycles
    parameter int unsigned FastClk  = 160   // TF, cycles; at least BL
) (
    input  wire logic       clk_i,
    input  wire logic       rst_ni,
    input  wire logic       on_i,     // 0: the bridge is off
    input  wire logic [7:0] ref_i,    // current reference
    input  wire logic       sign_i,   // direction of the current
    input  wire logic       cmp_i,    // raw pin
    output logic            pwm_o,    // bit stream of the reference
    output logic            en_o,     // 1: the bridge is enabled
    output logic            high0_o,  // high side of m10, m20
    output logic            high1_o   // high side of m11, m21
);

  localparam int unsigned Longest = (OffClk > FastClk) ? OffClk : FastClk;
  localparam int unsigned Width = ppmc_pkg::cnt_width(Longest);

  typedef enum logic [1:0] {
    StOff,
    StOn,
    StFast
  } state_e;

  state_e state_q;
  logic [Width-1:0] left_q;
  logic [7:0] stream_q;
  logic cmp, unused_q1, sign_q, rest, blanked, over;

  ppmc_sync #(
      .Width   (1),
      .ResetVal(1'b0)
  ) u_cmp (
      .clk_i,
      .rst_ni,
      .d_i (cmp_i),
      .q1_o(unused_q1),
      .q2_o(cmp)
  );

  assign rest    = !on_i || !en_o || sign_i != sign_q;
  assign blanked = left_q <= Width'(FastClk - BlankClk);

  always_comb begin
    unique case (state_q)
      StOn:    over = blanked && cmp;
      StFast:  over = (blanked && !cmp) || left_q == '0;
      default: over = left_q == '0;
    endcase
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      state_q  <= StOff;
      left_q   <= Width'(OffClk - 1);
      sign_q   <= 1'b0;
      en_o     <= 1'b0;
      high0_o  <= 1'b0;
      high1_o  <= 1'b0;
      stream_q <= '0;
      pwm_o    <= 1'b0;
    end else begin
      sign_q <= sign_i;
      en_o <= on_i;
      {pwm_o, stream_q} <= {1'b0, stream_q} + {1'b0, ref_i};
      if (rest || (over && (state_q != StOff || (!cmp && ref_i == '0)))) begin
        state_q <= StOff;
        left_q  <= Width'(OffClk - 1);
        high0_o <= 1'b0;
        high1_o <= 1'b0;
      end else if (over) begin
        state_q <= cmp ? StFast : StOn;
        left_q  <= Width'(FastClk - 1);
        high0_o <= cmp == sign_i;
        high1_o <= cmp != sign_i;
      end else if (left_q != '0) begin
        left_q <= left_q - 1'b1;
      end
    end
  end

`ifndef SYNTHESIS
  `PPMC_ASSERT(bridge_never_both, !(high0_o && high1_o))
  `PPMC_ASSERT(bridge_off_between, !((high0_o && $past(high1_o)) || (high1_o && $past(high0_o))))
`endif

endmodule

`default_nettype wire
