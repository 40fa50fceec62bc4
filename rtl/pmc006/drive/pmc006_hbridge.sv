// SPDX-License-Identifier: Apache-2.0
// pmc006_hbridge: controls the H-bridge of one motor phase. Generates the bit stream that represents the
//         current reference. Contains a chopper with fixed off time and slow or fast decay.
// Rules:  P006-EXC-40, P006-CHP-01..06.
// Timing: en_o follows on_i by one cycle. If on_i is 0 or sign_i changes, both high sides are switched off
//         at the next rising edge, and the off time restarts. A comparator level that is sampled at edge t
//         takes effect at edge t + 2. While the reference is 0 and the comparator is low, the off time is
//         repeated.
`include "ppmc_assert.svh"
`default_nettype none

module pmc006_hbridge #(
    parameter int unsigned OffCycles   = 320,  // off time T_OFF in cycles
    parameter int unsigned BlankCycles = 16,   // blanking time T_BLANK in cycles
    parameter int unsigned FastCycles  = 160   // longest fast decay in cycles; at least BlankCycles
) (
    input  wire logic       clk_i,
    input  wire logic       rst_ni,
    input  wire logic       on_i,     // 0: the bridge is off
    input  wire logic [7:0] ref_i,    // current reference
    input  wire logic       sign_i,   // direction of the current
    input  wire logic       cmp_i,    // comparator, raw pin
    output logic            pwm_o,    // bit stream of the reference
    output logic            en_o,     // 1: the bridge is enabled
    output logic            high0_o,  // 1: high side of the first half bridge (m10 or m20) on
    output logic            high1_o   // 1: high side of the second half bridge (m11 or m21) on
);

  localparam int unsigned MaxCycles = (OffCycles > FastCycles) ? OffCycles : FastCycles;
  localparam int unsigned Width = ppmc_pkg::cnt_width(MaxCycles);

  typedef enum logic [1:0] {
    StOff,
    StOn,
    StFast
  } state_e;

  state_e state_q;
  logic [Width-1:0] cycles_left_q;
  logic [7:0] stream_q;
  logic cmp, unused_q1, sign_q, restart_off, blanking_over, phase_done;

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

  assign restart_off   = !on_i || !en_o || sign_i != sign_q;
  assign blanking_over = cycles_left_q <= Width'(FastCycles - BlankCycles);

  always_comb begin
    unique case (state_q)
      StOn:    phase_done = blanking_over && cmp;
      StFast:  phase_done = (blanking_over && !cmp) || cycles_left_q == '0;
      default: phase_done = cycles_left_q == '0;
    endcase
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      state_q       <= StOff;
      cycles_left_q <= Width'(OffCycles - 1);
      sign_q        <= 1'b0;
      en_o          <= 1'b0;
      high0_o       <= 1'b0;
      high1_o       <= 1'b0;
      stream_q      <= '0;
      pwm_o         <= 1'b0;
    end else begin
      sign_q <= sign_i;
      en_o <= on_i;
      {pwm_o, stream_q} <= {1'b0, stream_q} + {1'b0, ref_i};
      if (restart_off || (phase_done && (state_q != StOff || (!cmp && ref_i == '0)))) begin
        state_q <= StOff;
        cycles_left_q <= Width'(OffCycles - 1);
        high0_o <= 1'b0;
        high1_o <= 1'b0;
      end else if (phase_done) begin
        state_q <= cmp ? StFast : StOn;
        cycles_left_q <= Width'(FastCycles - 1);
        high0_o <= cmp == sign_i;
        high1_o <= cmp != sign_i;
      end else if (cycles_left_q != '0) begin
        cycles_left_q <= cycles_left_q - 1'b1;
      end
    end
  end

`ifndef SYNTHESIS
  `PPMC_ASSERT(hbridge_never_both, !(high0_o && high1_o))
  `PPMC_ASSERT(hbridge_off_between, !((high0_o && $past(high1_o)) || (high1_o && $past(high0_o))))
`endif

endmodule

`default_nettype wire
