// SPDX-License-Identifier: Apache-2.0
// ppmc_xtal_cycles_fv: with 10 crystal cycles in 7 clock cycles, proves that after any number of clock
// cycles since the restart, the sum of cycles_o is the number of crystal cycles that have passed.
`include "ppmc_fv.svh"
`default_nettype none

module ppmc_xtal_cycles_fv (
    input wire logic clk_i,
    input wire logic restart_i
);

  logic [1:0] cycles_o;

  `FV_RESET

  ppmc_xtal_cycles #(
      .ClkHz (7),
      .XtalHz(10)
  ) dut (
      .*
  );

  logic [2:0] clk_q;  // cycles since the restart, modulo 7
  logic [4:0] told_q;  // reported crystal cycles; reduced by 10 every 7 cycles

  always_ff @(posedge clk_i)
    if (!rst_ni || restart_i) {clk_q, told_q} <= '0;
    else if (clk_q == 3'd6) {clk_q, told_q} <= {3'd0, told_q + 5'(cycles_o) - 5'd10};
    else {clk_q, told_q} <= {clk_q + 1'b1, told_q + 5'(cycles_o)};

  `FV_ASSERT(told_exactly, 8'(told_q) == (8'd10 * 8'(clk_q)) / 8'd7)
  `FV_ASSERT(phase_in_range, dut.g_phase.phase_q == 5'((8'd10 * 8'(clk_q)) % 8'd7))
  `FV_COVER(seen_two, cycles_o == 2'd2 && clk_q == 3'd6)

endmodule

`default_nettype wire
