// SPDX-License-Identifier: Apache-2.0
// ppmc_pulse_shaper: times the low time of each pulse and the direction set-up before the first pulse. The
//         set-up is as long as a full pulse.
// Rules:  P104-TIM-02 (set-up), P104-TIM-05 (width), P104-END-01/02 (a low time that has begun is not
//         changed).
// Timing: low_o is high for exactly WidthCycles cycles from the edge of pulse_i on, unless halve_i or cut_i
//         ends it earlier. past_o rises WidthCycles cycles after arm_i.
`default_nettype none

module ppmc_pulse_shaper #(
    parameter int unsigned ClkHz     = 16_000_000,
    parameter int unsigned XtalHz    = 16_000_000,
    parameter int unsigned RateBits  = 8,
    parameter int unsigned WidthXtal = 80,          // low time in crystal cycles
    parameter int unsigned HalfXtal  = 16,          // half a fast base clock period in crystal cycles
    parameter int unsigned HalfRates = 3            // number of rates with a low time of half an interval
) (
    input  wire logic                clk_i,
    input  wire logic                rst_ni,
    input  wire logic                arm_i,    // strobe: start the set-up time, without a pulse
    input  wire logic                pulse_i,  // strobe: a pulse
    input  wire logic                full_i,   // with pulse_i; 1: full pulse, which is never cut
    input  wire logic                halve_i,  // 1: at rates below HalfRates, low time is half an interval
    input  wire logic [RateBits-1:0] rate_i,   // rate of the interval after the pulse
    input  wire logic                cut_i,    // 1: end the low time now, unless the pulse is a full pulse
    output logic                     low_o,    // 1: a pulse is active
    output logic                     past_o    // WidthCycles cycles have passed since arm_i or pulse_i
);

  localparam int unsigned WidthCycles = ppmc_pkg::cyc(WidthXtal, ClkHz, XtalHz);
  localparam int unsigned Width = ppmc_lfsr_pkg::width(WidthCycles - 1);

  localparam logic [Width-1:0] Last = Width'(ppmc_lfsr_pkg::after(WidthCycles - 2, Width));

  logic [Width-1:0] age_q;  // cycles since arm_i or pulse_i (LFSR state); unused after past_o
  logic full_q;
  logic [HalfRates:0] halves;  // [r]: half of the interval of rate r has passed; the top bit is 0

  assign halves[HalfRates] = 1'b0;

  for (genvar r = 0; r < HalfRates; r++) begin : g_half
    localparam int unsigned HalfCycles = ppmc_pkg::cyc(HalfXtal * (r + 1), ClkHz, XtalHz);
    localparam logic [Width-1:0] Half = Width'(ppmc_lfsr_pkg::after(HalfCycles - 1, Width));

    assign halves[r] = halve_i && rate_i == RateBits'(r) && age_q == Half;
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      full_q <= 1'b0;
      low_o  <= 1'b0;
      past_o <= 1'b0;
    end else begin
      past_o <= !(arm_i || pulse_i) && (past_o || age_q == Last);
      if (pulse_i) begin
        low_o  <= 1'b1;
        full_q <= full_i;
      end else if (past_o || (!full_q && (halves != '0 || cut_i))) begin
        low_o <= 1'b0;
      end
    end
  end

  // No reset: every use sets age_q.
  always_ff @(posedge clk_i) begin
    if (arm_i || pulse_i) age_q <= Width'(1);
    else age_q <= Width'(ppmc_lfsr_pkg::step(31'(age_q), Width));
  end

endmodule

`default_nettype wire
