// SPDX-License-Identifier: Apache-2.0
// pmc006_stall_fv: proves that a stall is detected exactly at the last of a number of low samples.
`include "ppmc_fv.svh"
`default_nettype none

module pmc006_stall_fv
  import pmc006_pkg::sample_t;
(
    input wire logic          clk_i,
    input wire sample_t       sample_i,
    input wire logic    [2:0] config_i,
    input wire logic    [6:0] length_i,
    input wire logic    [8:0] limit_i,
    input wire logic          busy_i,
    input wire logic          steady_i,
    input wire logic          start_i,
    input wire logic          clear_i
);

  logic stop_o, mark_o, stall_o;

  `FV_RESET

  pmc006_stall dut (.*);

  logic sampled_q, low_q, counts;  // counts: the sample of the last cycle is low and counts
  logic [7:0] row_q, needed;  // row_q: consecutive samples that count, at most 255

  assign counts = sampled_q && low_q && config_i[0] && !stall_o && busy_i && steady_i;
  assign needed = (length_i == '0) ? 8'd1 : {1'b0, length_i};

  always_ff @(posedge clk_i) begin
    sampled_q <= rst_ni && sample_i.valid;
    if (sample_i.valid) low_q <= sample_i.level < {1'b0, limit_i};
    if (!rst_ni || !busy_i) row_q <= '0;
    else if (sampled_q) row_q <= !counts ? '0 : (row_q == '1) ? row_q : row_q + 8'd1;
  end

  // A motion begins with busy_i = 1 after standstill; a reset is at standstill.
  logic stopped_q;
  always_ff @(posedge clk_i) stopped_q <= rst_ni && (stopped_q || !busy_i);
  `FV_ASSUME(reset_at_standstill, stopped_q || !busy_i)

  `FV_ASSERT(lemma_count, !stopped_q || dut.count_q == (row_q[7] ? 7'd127 : row_q[6:0]))
  `FV_ASSERT(stall_at_the_last_sample, mark_o == (counts && row_q >= needed - 8'd1))
  `FV_ASSERT(stall_stored, !$past(rst_ni && mark_o) || stall_o)
  `FV_ASSERT(stall_cleared, !$past(rst_ni && !mark_o && (clear_i || start_i)) || !stall_o)
  `FV_ASSERT(stall_kept, !$past(rst_ni && !mark_o && !clear_i && !start_i) || stall_o == $past(stall_o))
  `FV_ASSERT(stall_stops, stop_o == (config_i[1] && busy_i && (stall_o || mark_o)))
  `FV_COVER(seen_stall, stall_o && $past(mark_o && length_i == 7'd3))
  `FV_COVER(seen_next_stall, mark_o && length_i == 7'd3 && $past(stall_o && clear_i))

endmodule

`default_nettype wire
