// SPDX-License-Identifier: Apache-2.0
// ppmc_timer_fv: proves that past_o rises with the tick number that last_i selects (1 .. 7), and remains
// high until the next restart.
`include "ppmc_fv.svh"
`default_nettype none

module ppmc_timer_fv (
    input wire logic       clk_i,
    input wire logic       restart_i,
    input wire logic       tick_i,
    input wire logic [2:0] number_i
);

  localparam int unsigned Width = 3;

  logic past_o;
  logic [Width-1:0] last_i;

  `FV_RESET

  // States of the counter after 0 .. 6 ticks, in this order.
  logic [7:0][Width-1:0] states;
  for (genvar n = 0; n < 8; n++) begin : g_state
    assign states[n] = Width'(ppmc_lfsr_pkg::after(n, Width));
  end
  assign last_i = states[number_i-3'd1];

  ppmc_timer #(.Width(Width)) dut (.*);

  logic begun_q;  // 1: a restart has occurred
  logic [3:0] ticks_q;  // ticks since the restart, saturates at 15

  always_ff @(posedge clk_i)
    if (!rst_ni) {begun_q, ticks_q} <= '0;
    else if (restart_i) {begun_q, ticks_q} <= {1'b1, 4'd0};
    else if (tick_i && ticks_q != '1) ticks_q <= ticks_q + 1'b1;

  `FV_ASSUME(a_number, number_i != '0)
  `FV_ASSUME(number_steady, restart_i || !begun_q || $past(restart_i) || number_i == $past(number_i))

  `FV_ASSERT(p104_gen_02_past, !begun_q || restart_i || ticks_q == '0 || past_o == (ticks_q >= 4'(number_i)))
  `FV_ASSERT(p104_gen_02_not_at_once, !begun_q || ticks_q != '0 || !past_o)
  `FV_COVER(seen_the_longest, begun_q && number_i == 3'd7 && past_o && ticks_q == 4'd7)

endmodule

`default_nettype wire
