// SPDX-License-Identifier: Apache-2.0
// ppmc_ext_clock: detects the edges of an external base clock, and classifies the length of its last
//         period.
// Rules:  P104-BCK-04, P104-INT-03 (period compared with the threshold), P104-TIM-05 (rate 0).
// Timing: if an edge of the pin is first sampled at edge t, rise_o or fall_o is high in the cycle before
//         edge t + 2. If the pin is sampled high for only one cycle, fall_o is delayed by one cycle, so it is
//         at least 2 cycles after rise_o. In the cycle of rise_o, long_period_o and short_period_o refer to
//         the period that ends with this edge.
`default_nettype none

module ppmc_ext_clock #(
    parameter int unsigned LongPeriodCycles  = 136,  // a period above this number of cycles is long
    parameter int unsigned ShortPeriodCycles = 128   // a period below this number is short
) (
    input  wire logic clk_i,
    input  wire logic rst_ni,
    input  wire logic pin_i,          // external clock, asynchronous
    output logic      rise_o,         // strobe: rising edge of the pin
    output logic      fall_o,         // strobe: falling edge of the pin, at least 2 cycles after rise_o
    output logic      long_period_o,  // 1: more than LongPeriodCycles cycles between rising edges
    output logic      short_period_o  // 1: less than ShortPeriodCycles cycles between rising edges
);

  localparam int unsigned Width = ppmc_lfsr_pkg::width(LongPeriodCycles);
  localparam logic [Width-1:0] ShortLast = Width'(ppmc_lfsr_pkg::after(ShortPeriodCycles - 2, Width));
  localparam logic [Width-1:0] LongLast = Width'(ppmc_lfsr_pkg::after(LongPeriodCycles - 1, Width));

  logic level, last_q, not_short_q;
  logic high_q;  // 1: if level is low, fall_o reports the falling edge
  logic unused_meta;
  logic [Width-1:0] age_q;  // cycles since the last rising edge; unused if long_period_o = 1

  ppmc_sync #(
      .Width   (1),
      .ResetVal(1'b1)  // so a pin that idles high produces no edge after reset
  ) u_sync (
      .clk_i,
      .rst_ni,
      .d_i (pin_i),
      .q1_o(unused_meta),
      .q2_o(level)
  );

  assign rise_o = level && !last_q;
  assign fall_o = !level && high_q;
  assign short_period_o = !not_short_q;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      last_q <= 1'b1;
      high_q <= 1'b1;
      not_short_q <= 1'b1;  // until the first edge, the period counts as long
      long_period_o <= 1'b1;
    end else begin
      last_q <= level;
      high_q <= last_q && (level || !high_q);
      if (rise_o) begin
        not_short_q   <= 1'b0;
        long_period_o <= 1'b0;
      end else if (!long_period_o) begin
        if (age_q == ShortLast) not_short_q <= 1'b1;
        if (age_q == LongLast) long_period_o <= 1'b1;
      end
    end
  end

  // No reset: age_q is unused until the first edge, because long_period_o is 1. The first edge sets age_q.
  always_ff @(posedge clk_i) begin
    if (rise_o) age_q <= Width'(1);
    else age_q <= Width'(ppmc_lfsr_pkg::step(31'(age_q), Width));
  end

endmodule

`default_nettype wire
