// SPDX-License-Identifier: Apache-2.0
// ppmc_sync_fv: proves that each pin passes exactly two flip-flops, which have the inactive level in reset.
`include "ppmc_fv.svh"
`default_nettype none

module ppmc_sync_fv (
    input wire logic       clk_i,
    input wire logic [1:0] d_i
);

  logic [1:0] q1_o, q2_o, one_q, two_q;

  `FV_RESET

  ppmc_sync #(
      .Width   (2),
      .ResetVal(2'b01)
  ) dut (
      .*
  );

  always_ff @(posedge clk_i) {two_q, one_q} <= rst_ni ? {one_q, d_i} : 4'b0101;

  `FV_ASSERT(first_stage, q1_o == one_q)
  `FV_ASSERT(second_stage, q2_o == two_q)
  `FV_COVER(seen_through, q2_o == 2'b10 && q1_o == 2'b01)

endmodule

`default_nettype wire
