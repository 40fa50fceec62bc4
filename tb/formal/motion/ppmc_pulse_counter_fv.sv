// SPDX-License-Identifier: Apache-2.0
// ppmc_pulse_counter_fv: proves that only a pulse changes the count, by +1 (CW) or -1 (CCW).
`include "ppmc_fv.svh"
`default_nettype none

module ppmc_pulse_counter_fv (
    input wire logic clk_i,
    input wire logic clear_i,
    input wire logic pout_ni,
    input wire logic dir_i
);

  logic [3:0] count_o;
  logic fell;

  `FV_RESET

  ppmc_pulse_counter #(.Width(4)) dut (.*);

  logic last_nq;
  assign fell = last_nq && !pout_ni;
  always_ff @(posedge clk_i) last_nq <= !rst_ni || pout_ni;

  logic [1:0] up_q;  // number of CW pulses
  always_ff @(posedge clk_i)
    if (!rst_ni || clear_i) up_q <= '0;
    else if (fell && !dir_i && up_q != '1) up_q <= up_q + 1'b1;

  `FV_ASSERT(one_a_pulse, count_o - $past(count_o) == $past
             (clear_i ? -count_o : !fell ? 4'd0 : dir_i ? 4'd15 : 4'd1) || !$past(rst_ni))
  `FV_ASSERT(begins_at_zero, $past(rst_ni) || count_o == '0)
  `FV_COVER(seen_both_ways, up_q == 2'd2 && count_o == '1)

endmodule

`default_nettype wire
