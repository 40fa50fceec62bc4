// SPDX-License-Identifier: Apache-2.0
// ppmc_ext_extra_time_fv: proves, exact to the cycle, that the extra time is the sum of two times: the time
// before the first base edge of an interval, and the time after its last base edge. If the first
// time alone is at least as long as the extra time, no second time is added.
`include "ppmc_fv.svh"
`default_nettype none

module ppmc_ext_extra_time_fv (
    input wire logic clk_i,
    input wire logic restart_i,
    input wire logic edge_i,
    input wire logic long_period_i,
    input wire logic hit_i
);

  localparam int unsigned Lag = 5;

  logic count_o, fire_o;

  `FV_RESET

  ppmc_ext_extra_time #(
      .ExtraCycles(Lag)
  ) dut (
      .en_i(1'b1),
      .*
  );

  // run_q: an interval is running; counting_q: its first base edge has occurred; hit_q: its last base edge
  // has occurred
  logic run_q, counting_q, hit_q;
  logic [3:0] before_q, after_q;  // cycles before the first and after the last base edge, saturate at 15

  always_ff @(posedge clk_i)
    if (!rst_ni) {run_q, counting_q, hit_q, before_q, after_q} <= '0;
    else if (restart_i) {run_q, counting_q, hit_q, before_q, after_q} <= {1'b1, edge_i, 1'b0, 8'd0};
    else begin
      if (!counting_q && before_q != '1) before_q <= before_q + 1'b1;
      if (edge_i) counting_q <= 1'b1;
      if (hit_i) hit_q <= 1'b1;
      if ((hit_i || hit_q) && after_q != '1) after_q <= after_q + 1'b1;
      if (fire_o) run_q <= 1'b0;
    end

  // The rate counter counts the edges that count_o enables, and ends each interval once.
  `FV_ASSUME(hit_counts, !hit_i || (run_q && edge_i && counting_q && !hit_q))

  `FV_ASSERT(edges_count_behind_the_first, !run_q || count_o == counting_q)
  `FV_ASSERT(p104_int_03_long_has_no_lag, !(hit_i && long_period_i) || fire_o)
  `FV_ASSERT(
      p104_int_03_whole_extra,
      !(run_q && fire_o && !(hit_i && long_period_i)) || before_q >= 4'(Lag) || before_q + after_q == 4'(Lag))
  `FV_ASSERT(none_without_a_hit, !(run_q && fire_o) || hit_i || hit_q)
  `FV_ASSERT(in_time, !(run_q && hit_q) || after_q <= 4'(Lag))
  `FV_COVER(seen_both_sides, run_q && fire_o && before_q == 4'd2 && after_q == 4'd3)

endmodule

`default_nettype wire
