// SPDX-License-Identifier: Apache-2.0
// ppmc_tick_gen_fv: proves that tick n occurs exactly ceil(n * 7 / 3) cycles after the restart, for any n.
// Therefore there is no drift.
`include "ppmc_fv.svh"
`default_nettype none

module ppmc_tick_gen_fv (
    input wire logic clk_i,
    input wire logic restart_i
);

  logic tick_o;

  `FV_RESET

  ppmc_tick_gen #(
      .ClkHz   (7),
      .XtalHz  (3),
      .TickXtal(1)
  ) dut (
      .*
  );

  logic [2:0] clk_q;  // cycles since the restart, modulo 7; seven cycles have three ticks

  always_ff @(posedge clk_i) clk_q <= (!rst_ni || restart_i || clk_q == 3'd6) ? 3'd0 : clk_q + 1'b1;

  `FV_ASSERT(every_tick, tick_o == (5'd3 * (5'(clk_q) + 5'd1) / 5'd7 != 5'd3 * 5'(clk_q) / 5'd7))
  `FV_COVER(seen_third, tick_o && clk_q == 3'd6)

endmodule

`default_nettype wire
