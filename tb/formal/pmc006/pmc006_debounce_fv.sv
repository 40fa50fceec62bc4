// SPDX-License-Identifier: Apache-2.0
// pmc006_debounce_fv: compares the debounce filter, set to three ticks for both levels, with a counter of
// ticks.
`include "ppmc_fv.svh"
`default_nettype none

module pmc006_debounce_fv (
    input wire logic clk_i,
    input wire logic us_i,
    input wire logic pin_i
);

  logic hit_o, rearm_o;

  `FV_RESET

  pmc006_debounce #(
      .LowTicks (3),
      .HighTicks(3)
  ) dut (
      .*
  );

  // ticks_q: ticks for which the input has had, without interruption, the level that changes armed_q (low
  // while armed, high while not armed)
  logic armed_q, first_q;
  logic [1:0] ticks_q;
  logic change;

  assign change = first_q && us_i && pin_i != armed_q && ticks_q == 2'd2;

  always_ff @(posedge clk_i)
    if (!rst_ni) {armed_q, ticks_q, first_q} <= '0;
    else begin
      first_q <= 1'b1;
      if (change) armed_q <= !armed_q;
      if (pin_i == armed_q || change || !first_q) ticks_q <= '0;
      else if (us_i) ticks_q <= ticks_q + 1'b1;
    end

  `FV_ASSERT(p006_prg_30_hit, hit_o == (change && armed_q))
  `FV_ASSERT(p006_prg_30_rearm, rearm_o == (change && !armed_q))
  `FV_COVER(seen_hit, hit_o)

endmodule

`default_nettype wire
