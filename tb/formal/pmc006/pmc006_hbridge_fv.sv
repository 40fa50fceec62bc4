// SPDX-License-Identifier: Apache-2.0
// pmc006_hbridge_fv: proves that the two high sides are never on in the same cycle or in adjacent cycles.
// Also proves the off time and the blanking time.
`include "ppmc_fv.svh"
`default_nettype none

module pmc006_hbridge_fv (
    input wire logic       clk_i,
    input wire logic       on_i,
    input wire logic [7:0] ref_i,
    input wire logic       sign_i,
    input wire logic       cmp_i
);

  localparam int unsigned OffCycles = 7, BlankCycles = 3, FastCycles = 5;

  logic pwm_o, en_o, high0_o, high1_o, high;

  `FV_RESET

  pmc006_hbridge #(
      .OffCycles  (OffCycles),
      .BlankCycles(BlankCycles),
      .FastCycles (FastCycles)
  ) dut (
      .*
  );

  assign high = high0_o || high1_o;

  logic [3:0] off_q, on_q;  // cycles with both high sides off, and with one on; both saturate at 15

  always_ff @(posedge clk_i)
    if (!rst_ni) {off_q, on_q} <= '0;
    else begin
      off_q <= high ? '0 : (off_q == '1) ? '1 : off_q + 1'b1;
      on_q  <= !high ? '0 : (on_q == '1) ? '1 : on_q + 1'b1;
    end

  logic was_on_q;  // 1: an ON phase has occurred
  always_ff @(posedge clk_i) was_on_q <= rst_ni && (was_on_q || dut.state_q == 1);

  `FV_ASSERT(p006_chp_01_never_both, !(high0_o && high1_o))
  `FV_ASSERT(p006_chp_01_not_adjacent, !((high0_o && $past(high1_o)) || (high1_o && $past(high0_o))))
  `FV_ASSERT(p006_chp_03_off_time, !(high && $past(rst_ni && !high)) || off_q >= 4'(OffCycles))
  `FV_ASSERT(p006_chp_04_blanking, !($past(rst_ni && high) && !high) || on_q >= 4'(BlankCycles) || $past
             (!on_i || !en_o || sign_i != dut.sign_q))
  `FV_ASSERT(off_in_next_cycle, !$past(rst_ni && !on_i) || (!high && !en_o))
  `FV_ASSERT(p006_chp_06_sign_switches_off, !($past(rst_ni && sign_i != dut.sign_q)) || !high)
  `FV_COVER(seen_fast_decay, high && dut.state_q == 2 && on_q == 4'(BlankCycles))
  `FV_COVER(seen_slow_decay, !high && off_q == 4'(OffCycles) && was_on_q)

endmodule

`default_nettype wire
