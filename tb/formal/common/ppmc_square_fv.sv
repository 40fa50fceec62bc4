// SPDX-License-Identifier: Apache-2.0
// ppmc_square_fv: proves that toggle t occurs exactly ceil(t * 7 / 3) cycles after reset, for any t.
// Therefore there is no drift.
`include "ppmc_fv.svh"
`default_nettype none

module ppmc_square_fv (
    input wire logic clk_i
);

  logic wave_o;

  `FV_RESET

  ppmc_square #(
      .ClkHz   (7),
      .XtalHz  (6),
      .HalfXtal(2)
  ) dut (
      .*
  );

  // Three toggles occur in each group of seven cycles.
  logic [2:0] clk_q;
  logic odd_q;  // parity of the number of toggles in all complete groups
  logic [1:0] toggles;  // number of toggles in the current group

  always_ff @(posedge clk_i)
    if (!rst_ni) {clk_q, odd_q} <= '0;
    else if (clk_q == 3'd6) {clk_q, odd_q} <= {3'd0, !odd_q};
    else clk_q <= clk_q + 1'b1;

  assign toggles = 2'((5'd3 * 5'(clk_q)) / 5'd7);

  `FV_ASSERT(every_toggle, wave_o == (odd_q ^ toggles[0]))
  `FV_COVER(seen_second_turn, odd_q && clk_q == 3'd6)

endmodule

`default_nettype wire
