// SPDX-License-Identifier: Apache-2.0
// ppmc_rate_counter_fv: proves that only base clock number rate + 1 ends an interval, and that base clock
// number floor((rate + 1) / 2) marks its middle.
`include "ppmc_fv.svh"
`default_nettype none

module ppmc_rate_counter_fv (
    input wire logic       clk_i,
    input wire logic       restart_i,
    input wire logic       tick_i,
    input wire logic [3:0] rate_i,
    input wire logic       wait_i,
    input wire logic       rising_i
);

  logic hit_o, half_o;

  `FV_RESET

  ppmc_rate_counter #(.RateBits(4)) dut (.*);

  logic began_q, over_q;  // began_q: an interval is running; over_q: the interval has ended
  logic [4:0] ticks_q;  // base clocks since the restart
  logic [1:0] gap_q;  // cycles since a restart or a tick, saturates at 3
  logic fresh_q;  // 1: the restart was in the previous cycle

  always_ff @(posedge clk_i)
    if (!rst_ni) {began_q, over_q, ticks_q, gap_q, fresh_q} <= {2'b01, 8'd0};
    else begin
      fresh_q <= restart_i;
      gap_q   <= (tick_i || restart_i) ? 2'd1 : (gap_q == 2'd3) ? 2'd3 : gap_q + 1'b1;
      if (restart_i) {began_q, over_q, ticks_q} <= {2'b10, 5'd0};
      else if (tick_i && !over_q) begin
        ticks_q <= ticks_q + 1'b1;
        over_q  <= hit_o;
      end
    end

  `FV_ASSUME(ticks_apart, !tick_i || gap_q == 2'd3)
  `FV_ASSUME(rate_known, !began_q || ((fresh_q || rate_i == $past(rate_i)) && !rising_i && !wait_i))

  `FV_ASSERT(p104_int_01_ends_at_rate_plus_one,
             !(began_q && tick_i && !over_q) || hit_o == (ticks_q == 5'(rate_i)))
  `FV_ASSERT(hit_is_a_base_clock, !hit_o || tick_i)
  `FV_ASSERT(p104_tim_05_half,
             !(began_q && tick_i && !over_q) || half_o == (ticks_q + 5'd1 >= (5'(rate_i) + 5'd1) >> 1))
  `FV_COVER(seen_long_interval, began_q && hit_o && ticks_q == 5'd5)

endmodule

`default_nettype wire
