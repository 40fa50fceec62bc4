// SPDX-License-Identifier: Apache-2.0
// ppmc_ramp_builder_fv: proves that a build ends within its bound, and that it writes each word of the
// table once and in order, with PA first. Rates have 2 bits, PA has 3 bits. The stub of
// ppmc_ramp_serial shortens each pass to 2 cycles; ppmc_ramp_serial_fv proves the real length.
`include "ppmc_fv.svh"
`default_nettype none

module ppmc_ramp_builder_fv (
    input wire logic       clk_i,
    input wire logic       start_i,
    input wire logic [1:0] slow_i,
    input wire logic [1:0] fast_i,
    input wire logic [2:0] steps_i
);

  // Passes: one at the beginning, two multiplications by each factor, four per rate.
  localparam int unsigned Passes = 1 + 2 * (2 + 1) + 2 * (2 + 2) + 4 * 3;
  localparam int unsigned Bound = Passes * 2 + 6;  // in cycles

  logic busy_o, we_o;
  logic [1:0] addr_o;
  logic [2:0] data_o;

  `FV_RESET

  ppmc_ramp_builder #(
      .RateBits(2),
      .StepBits(3)
  ) dut (
      .*
  );

  logic [6:0] age_q;  // cycles since the start of the build
  logic [1:0] next_q;  // address of the next word
  logic any_q;  // 1: a word has been written
  logic built_q;  // 1: a build has ended
  logic [1:0] slow_q;  // start-up rate of the current build

  always_ff @(posedge clk_i)
    if (!rst_ni) {age_q, next_q, any_q} <= '0;
    else if (!busy_o) {age_q, any_q} <= '0;
    else begin
      age_q <= age_q + 1'b1;
      if (age_q == '0) next_q <= fast_i;
      if (we_o) {next_q, any_q} <= {next_q + 1'b1, 1'b1};
    end

  always_ff @(posedge clk_i)
    if (!rst_ni || start_i) built_q <= 1'b0;
    else if (busy_o) {built_q, slow_q} <= {1'b1, slow_i};

  `FV_ASSUME(legal, fast_i <= slow_i && steps_i != '0)
  `FV_ASSUME(start_at_rest, !(start_i && busy_o))
  `FV_ASSUME(stands_while_busy, !(busy_o && $past(busy_o)) || {slow_i, fast_i, steps_i} == $past
             ({slow_i, fast_i, steps_i}))

  `FV_ASSERT(p104_hsk_04_ends, age_q <= 7'(Bound))
  `FV_ASSERT(p104_rmp_02_in_order,
             !we_o || (busy_o && addr_o == next_q && addr_o >= fast_i && addr_o <= slow_i))
  `FV_ASSERT(p104_rmp_02_whole_table, !($past(rst_ni && busy_o) && !busy_o) || $past(we_o && addr_o == slow_i
                                                                                        ))
  `FV_ASSERT(p104_rmp_02_pa_first, !we_o || any_q || data_o == steps_i)
  `FV_ASSERT(p104_ini_05_slow_stands_behind_it, !built_q || busy_o || addr_o == slow_q)
  `FV_COVER(seen_three_words, we_o && addr_o == 2'd3 && fast_i == '0 && any_q)

endmodule

`default_nettype wire
