// SPDX-License-Identifier: Apache-2.0
// ppmc_bridge_wait_fv: proves that timeout_o rises with millisecond tick number limit + 1 of the wait. This
// tick occurs more than limit, but at most limit + 1, milliseconds after the wait has begun. With a limit of
// 0, timeout_o is high immediately.
`include "ppmc_fv.svh"
`default_nettype none

module ppmc_bridge_wait_fv (
    input wire logic       clk_i,
    input wire logic       ms_i,
    input wire logic       set_i,
    input wire logic [1:0] limit_i,
    input wire logic       waiting_i
);

  logic timeout_o;

  `FV_RESET

  ppmc_bridge_wait dut (
      .start_i(1'b0),
      .limit_i(16'(limit_i)),
      .*
  );

  logic [1:0] limit_q;
  logic known_q, settled_q;
  logic [2:0] ms_q;  // millisecond ticks in the wait, saturates at 7

  `FV_ASSUME(ms_apart, !(ms_i && $past(ms_i)))
  `FV_ASSUME(set_before, !(waiting_i || $past(waiting_i)) || (!set_i && !$past(set_i)))
  `FV_ASSUME(a_limit, known_q || !waiting_i)
  `FV_ASSUME(short_wait, ms_q != '1 || !ms_i)

  always_ff @(posedge clk_i)
    if (!rst_ni) {known_q, settled_q, ms_q, limit_q} <= '0;
    else begin
      if (set_i) {known_q, limit_q} <= {1'b1, limit_i};
      settled_q <= known_q && waiting_i;
      ms_q <= !waiting_i ? '0 : ms_q + 3'(ms_i);
    end

  `FV_ASSERT(ub_wait_01_in_time, !settled_q || timeout_o == (ms_q > 3'(limit_q) || limit_q == '0))
  `FV_COVER(seen_limit, settled_q && timeout_o && limit_q == 2'd3)

endmodule

`default_nettype wire
