// SPDX-License-Identifier: Apache-2.0
// ppmc_xtal_timer_fv: proves for every limit_i up to 14 that past_o is high if and only if limit_i crystal
// cycles have passed since the last restart.
`include "ppmc_fv.svh"
`default_nettype none

module ppmc_xtal_timer_fv (
    input wire logic       clk_i,
    input wire logic       restart_i,
    input wire logic [3:0] limit_i
);

  logic past_o;

  `FV_RESET

  ppmc_xtal_timer #(
      .ClkHz (7),
      .XtalHz(10),
      .Width (4)
  ) dut (
      .*
  );

  logic [3:0] clk_q;  // cycles since the restart, saturates at 15 (21 crystal cycles)

  always_ff @(posedge clk_i)
    if (!rst_ni || restart_i) clk_q <= '0;
    else if (clk_q != '1) clk_q <= clk_q + 1'b1;

  `FV_ASSUME(legal_limit, limit_i <= 4'd14)
  `FV_ASSERT(past_exactly, past_o == ((8'd10 * 8'(clk_q)) / 8'd7 >= 8'(limit_i)))
  `FV_COVER(seen_longest, past_o && limit_i == 4'd14 && clk_q == 4'd10)

endmodule

`default_nettype wire
