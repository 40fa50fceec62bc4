// SPDX-License-Identifier: Apache-2.0
// ppmc_bridge_rate_fv: proves that only an answer changes the rate, and that a break always restores the
// default rate.
`include "ppmc_fv.svh"
`default_nettype none

module ppmc_bridge_rate_fv (
    input wire logic       clk_i,
    input wire logic       ms_i,
    input wire logic       set_i,
    input wire logic [2:0] code_i,
    input wire logic       answered_i,
    input wire logic       good_i,
    input wire logic       break_i
);

  logic [19:0] step_o;

  `FV_RESET

  ppmc_bridge_rate dut (.*);

  logic [9:0] ms_q;  // milliseconds since the answer, saturates at 1023
  logic trial_q;  // 1: no valid frame since the answer that changed the rate

  always_ff @(posedge clk_i)
    if (!rst_ni || answered_i) ms_q <= '0;
    else if (ms_i && ms_q != '1) ms_q <= ms_q + 1'b1;

  always_ff @(posedge clk_i)
    if (!rst_ni || break_i) trial_q <= 1'b0;
    else if (answered_i) trial_q <= dut.change_q;
    else if (good_i) trial_q <= 1'b0;

  `FV_ASSERT(ub_lin_07_changes_at_an_answer, dut.code_q == $past(dut.code_q) || dut.code_q == '0 || $past
             (answered_i))
  `FV_ASSERT(ub_lin_06_break_leads_back, !$past(rst_ni && break_i) || dut.code_q == '0)
  `FV_ASSERT(ub_lin_07_not_given_up_early, !($past(rst_ni && !break_i && !answered_i)
             && dut.code_q == '0 && $past(dut.code_q) != '0) || $past(ms_q) == 10'd1000)
  `FV_ASSERT(ub_lin_07_given_up_in_time, !(trial_q && ms_q > 10'd1001) || dut.code_q == '0)
  `FV_ASSERT(ub_lin_07_kept_when_used, !$past(rst_ni && good_i && !break_i && !answered_i)
             || dut.code_q == $past(dut.code_q))
  `FV_ASSERT(lemma_left, !dut.trial_q || (ms_q <= 10'd1000 && dut.left_q == 10'd1000 - ms_q))
  `FV_ASSERT(lemma_trial, (dut.trial_q || dut.code_q == '0 || !trial_q) && (trial_q || !dut.trial_q))
  `FV_ASSERT(step_never_zero, !$past(rst_ni) || step_o != '0)
  `FV_COVER(seen_new_rate, dut.code_q == 3'd5)

endmodule

`default_nettype wire
