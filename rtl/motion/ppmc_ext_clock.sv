// SPDX-License-Identifier: Apache-2.0
// ppmc_ext_clock: edges of an external base clock and the length of its last period.
// Rules:  P104-BCK-04, P104-INT-03 (period against the threshold), P104-TIM-05 (c).
// Timing: a rising pin edge first sampled at t gives rise_o in the cycle before edge t + 2, the same for
//         falling edges. long_o and brisk_o speak, in the cycle of rise_o, of the period that this edge ends.
`default_nettype none

module ppmc_ext_clock #(
    parameter int unsigned LongClk  = 136,  // a period longer than this is long
    parameter int unsigned BriskClk = 128   // a period shorter than this is brisk; at most LongClk
) (
    input  wire logic clk_i,
    input  wire logic rst_ni,
    input  wire logic pin_i,   // external clock, asynchronous
    output logic      rise_o,  // rising edge of the pin
    output logic      fall_o,  // falling edge
    output logic      long_o,  // more than LongClk clk since the edge before
    output logic      brisk_o  // less than BriskClk clk since the edge before
);

  localparam int unsigned Width = ppmc_lfsr_pkg::width(LongClk);
  localparam logic [Width-1:0] Brisk = Width'(ppmc_lfsr_pkg::after(BriskClk - 2, Width));
  localparam logic [Width-1:0] Long = Width'(ppmc_lfsr_pkg::after(LongClk - 1, Width));

  logic level, last_q, slow_q;
  logic unused_meta;
  logic [Width-1:0] age_q;  // clk since the last rising edge, of no use when long

  ppmc_sync #(
      .Width   (1),
      .ResetVal(1'b1)  // a pin that rests high must not look like an edge
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
      slow_q <= 1'b1;  // no edge before: an endless period
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

  // No reset: long_o is set until the first edge clears it.
  always_ff @(posedge clk_i) begin
    if (rise_o) age_q <= Width'(1);
    else age_q <= Width'(ppmc_lfsr_pkg::step(31'(age_q), Width));
  end

endmodule

`default_nettype wire
