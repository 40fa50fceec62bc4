// SPDX-License-Identifier: Apache-2.0
// ppmc_ramp_table_fv: proves that from the fall of busy_o until the next build, the table contains the words
// of the builder, and slow_o, fast_o and steps_o are the parameters of this table.
`include "ppmc_fv.svh"
`default_nettype none

module ppmc_ramp_table_fv (
    input wire logic       clk_i,
    input wire logic       start_i,
    input wire logic [1:0] slow_i,
    input wire logic [1:0] fast_i,
    input wire logic [1:0] steps_i,
    input wire logic [1:0] addr_i
);

  logic busy_o;
  logic [1:0] slow_o, fast_o, steps_o, data_o;

  `FV_RESET

  ppmc_ramp_table #(
      .RateBits(2),
      .StepBits(2)
  ) dut (
      .*
  );

  `FV_ASSUME(stands_while_busy, !(busy_o && $past(busy_o)) || {slow_i, fast_i, steps_i} == $past
             ({slow_i, fast_i, steps_i}))
  `FV_ASSUME(once, !(start_i && busy_o))

  // The stub of the builder writes one word: PA at the start-up rate.
  logic [1:0] at_q, fast_q, word_q, addr1_q, addr2_q, rest_q;  // rest_q: cycles since the build, <= 3

  always_ff @(posedge clk_i) begin
    {addr2_q, addr1_q} <= {addr1_q, addr_i};
    if (!rst_ni) {at_q, fast_q, word_q, rest_q} <= '0;
    else if (busy_o || start_i) begin
      rest_q <= '0;
      if (busy_o) {at_q, fast_q, word_q} <= {slow_i, fast_i, steps_i};
    end else begin
      rest_q <= (rest_q == '1) ? '1 : rest_q + 1'b1;
    end
  end

  logic some_q;  // 1: a build has begun
  always_ff @(posedge clk_i) some_q <= rst_ni && (some_q || busy_o);

  `FV_ASSERT(p104_ini_07_what_was_built, !(some_q && rest_q == '1 && addr2_q == at_q) || data_o == word_q)
  `FV_ASSERT(p104_ini_05_rates_kept, !some_q || busy_o || {slow_o, fast_o, steps_o} == {at_q, fast_q, word_q})
  `FV_COVER(seen_word, some_q && rest_q == '1 && addr2_q == at_q && data_o == 2'd3)

endmodule

`default_nettype wire
