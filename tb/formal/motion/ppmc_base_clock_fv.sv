// SPDX-License-Identifier: Apache-2.0
// ppmc_base_clock_fv: proves that the ticks of the base clock are exactly one period apart, and that the
// extra time delays the first tick of an interval.
`include "ppmc_fv.svh"
`default_nettype none

module ppmc_base_clock_fv (
    input wire logic clk_i,
    input wire logic restart_i,
    input wire logic quantum_i,
    input wire logic slow_i,
    input wire logic extra_i
);

  localparam logic [3:0] Fast = 4'd3, Slow = 4'd5, Extra = 4'd4;  // in quanta

  logic tick_o;

  `FV_RESET

  ppmc_base_clock #(
      .FastQuanta (3),
      .SlowQuanta (5),
      .ExtraQuanta(4)
  ) dut (
      .*
  );

  logic began_q;  // 1: a pulse has occurred
  logic [3:0] left_q;  // quanta until the next tick
  logic second_q;  // 1: the first tick of the interval has occurred

  always_ff @(posedge clk_i)
    if (!rst_ni) {began_q, left_q} <= '0;
    else if (restart_i) {began_q, left_q} <= {1'b1, (slow_i ? Slow : Fast) + (extra_i ? Extra : 4'd0)};
    else if (quantum_i) left_q <= (left_q == 4'd1) ? (slow_i ? Slow : Fast) : left_q - 1'b1;

  always_ff @(posedge clk_i) second_q <= rst_ni && !restart_i && (second_q || (began_q && tick_o));

  `FV_ASSUME(steady_operation, !began_q || restart_i || {slow_i, extra_i} == $past({slow_i, extra_i}))

  `FV_ASSERT(p104_bck_01_each_period, !began_q || tick_o == (quantum_i && left_q == 4'd1))
  `FV_COVER(seen_extra_and_two, second_q && tick_o && slow_i && extra_i && !restart_i)

endmodule

`default_nettype wire
