// SPDX-License-Identifier: Apache-2.0
// ppmc_ext_clock: edges of an external base clock and the length of its last period.
// Rules:  P104-BCK-04, P104-INT-03 (period compared with the threshold), P104-TIM-05 (c).
// Timing: for a rising pin edge first sampled at edge t, rise_o is high in the cycle before edge t + 2; for a
//         falling edge likewise fall_o. In the cycle of rise_o, long_o and brisk_o refer to the period that
//         this edge ends.
`default_nettype none

module ppmc_ext_clock #(
    parameter int unsigned LongClk  = 136,  // a longer period is long, cycles
    parameter int unsigned BriskClk = 128   // a shorter period is brisk, cycles; at most LongClk
) (
    input  wire logic clk_i,
    input  wire logic rst_ni,
    input  wire logic pin_i,   // external clock, asynchronous
    output logic      rise_o,  // rising edge of the pin
    output logic      fall_o,  // falling edge of the pin
    output logic      long_o,  // more than LongClk cycles since the previous rising edge
    output logic      brisk_o  // less than BriskClk cycles since the previous rising edge
);

  localparam int unsigned Width = ppmc_lfsr_pkg::width(LongClk);
  localparam logic [Width-1:0] Brisk = Width'(ppmc_lfsr_pkg::after(BriskClk - 2, Width));
  localparam logic [Width-1:0] Long = Width'(ppmc_lfsr_pkg::after(LongClk - 1, Width));

  logic level, last_q, slow_q;
  logic unused_meta;
  logic [Width-1:0] age_q;  // cycles since the last rising edge; not used with long_o

  ppmc_sync #(
      .Width   (1),
      .ResetVal(1'b1)  // an idle-high pin must not produce an edge
  ) u_sync (
      .clk_i,
      .rst_ni,
      .d_i (pin_i),
      .q1_o(unused_meta),
      .q2_o(level)
  );

  assign rise_o  = level && !last_q;
  assign fall_o  = !level && last_q;
  assign brisk_o = !slow_q;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      last_q <= 1'b1;
      slow_q <= 1'b1;  // no previous edge: the period is infinite
      long_o <= 1'b1;
    end else begin
      last_q <= level;
      if (rise_o) begin
        slow_q <= 1'b0;
        long_o <= 1'b0;
      end else if (!long_o) begin
        if (age_q == Brisk) slow_q <= 1'b1;
        if (age_q == Long) long_o <= 1'b1;
      end
    end
  end

  // No reset, because long_o is set until the first edge clears it.
  always_ff @(posedge clk_i) begin
    if (rise_o) age_q <= Width'(1);
    else age_q <= Width'(ppmc_lfsr_pkg::step(31'(age_q), Width));
  end

endmodule

`default_nettype wire
