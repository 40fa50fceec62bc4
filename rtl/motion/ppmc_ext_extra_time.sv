// SPDX-License-Identifier: Apache-2.0
// ppmc_ext_extra_time: fixed extra time of an interval with an external base clock.
// Rules:  P104-INT-03, P104-INT-04.
// Timing: fire_o is combinational: it is high in the cycle of hit_i, or in the cycle in which the second
//         part of the extra time has passed.
// How:    the first part of the extra time runs from a pulse to the first base edge (edge of the base clock)
//         at or after the pulse. The second part begins after the base edge that ends the count of the
//         interval (hit_i). Therefore an interval lasts (rate + 1) periods of the base clock plus the extra
//         time, although the frequency is not measured.
`default_nettype none

module ppmc_ext_extra_time #(
    parameter int unsigned ExtraCycles = 120  // extra time of an interval in cycles; at least 2
) (
    input  wire logic clk_i,
    input  wire logic rst_ni,
    input  wire logic en_i,           // 0: no extra time, fire_o = hit_i
    input  wire logic restart_i,      // strobe: a pulse
    input  wire logic edge_i,         // strobe: an edge of the base clock
    input  wire logic long_period_i,  // with edge_i; 1: long period, so the interval has no extra time
    input  wire logic hit_i,          // strobe: this base edge ends the count of the interval
    output logic      count_o,        // 1: base edges are counted
    output logic      fire_o          // strobe: the interval ends
);

  localparam int unsigned Width = ppmc_lfsr_pkg::width(ExtraCycles - 1);
  localparam logic [Width-1:0] Before = Width'(ppmc_lfsr_pkg::after(ExtraCycles - 2, Width));

  logic [Width-1:0] elapsed_q;  // elapsed part of the extra time (LFSR state)
  logic last_q, over_q;  // last_q: one cycle of the extra time is left; over_q: no cycle is left
  logic before_q;  // 1: no base edge has occurred since the pulse
  logic after_q;  // 1: the count has ended, and the second part is running
  logic counts;

  assign count_o = !(en_i && before_q);
  assign counts  = (before_q || after_q) && !over_q;
  assign fire_o  = (after_q && last_q) || (hit_i && (!en_i || long_period_i || over_q));

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      last_q   <= 1'b0;
      over_q   <= 1'b1;
      before_q <= 1'b0;
      after_q  <= 1'b0;
    end else if (restart_i) begin
      last_q   <= 1'b0;
      over_q   <= 1'b0;
      before_q <= !edge_i;
      after_q  <= 1'b0;
    end else begin
      if (counts) {last_q, over_q} <= {elapsed_q == Before, last_q};
      if (edge_i) before_q <= 1'b0;
      if (hit_i && !fire_o) after_q <= 1'b1;
    end
  end

  // No reset: the first pulse sets elapsed_q.
  always_ff @(posedge clk_i) begin
    if (restart_i) elapsed_q <= Width'(1);
    else if (counts) elapsed_q <= Width'(ppmc_lfsr_pkg::step(31'(elapsed_q), Width));
  end

endmodule

`default_nettype wire
