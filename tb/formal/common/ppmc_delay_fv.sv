// SPDX-License-Identifier: Apache-2.0
// ppmc_delay_fv: proves that past_o rises exactly with tick number Ticks, and remains high until the next
// restart.
`include "ppmc_fv.svh"
`default_nettype none

module ppmc_delay_fv (
    input wire logic clk_i,
    input wire logic restart_i,
    input wire logic tick_i
);

  logic one_o, five_o, all_o;

  `FV_RESET

  ppmc_delay #(
      .Ticks(1)
  ) u_one (
      .past_o(one_o),
      .*
  );

  ppmc_delay #(
      .Ticks(5)
  ) u_five (
      .past_o(five_o),
      .*
  );

  // 15 is the largest number of ticks that four bits can count.
  ppmc_delay #(
      .Ticks(15)
  ) u_all (
      .past_o(all_o),
      .*
  );

  logic begun_q;  // 1: a restart has occurred
  logic [4:0] ticks_q;  // ticks since the restart, saturates at 31

  always_ff @(posedge clk_i)
    if (!rst_ni) {begun_q, ticks_q} <= '0;
    else if (restart_i) {begun_q, ticks_q} <= {1'b1, 5'd0};
    else if (tick_i && ticks_q != '1) ticks_q <= ticks_q + 1'b1;

  `FV_ASSERT(p104_gen_02_one, !begun_q || one_o == (ticks_q >= 5'd1))
  `FV_ASSERT(p104_gen_02_five, !begun_q || five_o == (ticks_q >= 5'd5))
  `FV_ASSERT(p104_gen_02_all, !begun_q || all_o == (ticks_q >= 5'd15))
  `FV_COVER(seen_all, begun_q && all_o)

endmodule

`default_nettype wire
