// SPDX-License-Identifier: Apache-2.0
// ppmc_finish_status_fv: proves that a motion with interrupt asserts the interrupt at its end, that the
// interrupt stays asserted until the finish status is read, and that no other event changes it.
`include "ppmc_fv.svh"
`default_nettype none

module ppmc_finish_status_fv
  import ppmc_code_pkg::*;
(
    input wire logic            clk_i,
    input wire logic            start_i,
    input wire op_code_t        op_code_i,
    input wire logic            done_i,
    input wire logic     [ 3:0] cause_i,
    input wire logic            read_i,
    input wire logic     [ 2:0] select_i,
    input wire logic     [23:0] remaining_i,
    input wire logic     [ 7:0] inputs_i,
    input wire logic     [ 7:0] outputs_i,
    input wire logic     [ 3:0] auxi_i
);

  logic [23:0] answer_o;
  logic int_no, asked;

  `FV_RESET

  ppmc_finish_status dut (.*);

  logic fresh_q, silent_q, pending_q;
  logic [2:0] op_q;
  assign asked = read_i && select_i == SEL_FINISH;

  always_ff @(posedge clk_i)
    if (!rst_ni) {fresh_q, silent_q, pending_q, op_q} <= '0;
    else begin
      if (start_i) {silent_q, op_q} <= {op_code_i.silent, op_code_i.op};
      if (asked) {fresh_q, pending_q} <= 2'b00;
      else if (done_i) {fresh_q, pending_q} <= {1'b1, pending_q || !silent_q};
    end

  `FV_ASSUME(start_at_rest, !(start_i && done_i))

  logic second_q;  // 1: a silent motion has ended
  always_ff @(posedge clk_i) second_q <= rst_ni && (second_q || (done_i && silent_q));

  `FV_ASSERT(p104_rd_08_interrupt, int_no == !pending_q)
  `FV_ASSERT(p104_rd_02_finish_status, select_i != SEL_FINISH || answer_o[7:0] == {fresh_q, cause_i, op_q})
  `FV_ASSERT(p104_rd_07_remaining, select_i != SEL_REMAINING || answer_o == remaining_i)
  `FV_ASSERT(p104_rd_05_inputs, select_i != SEL_INPUTS || answer_o[7:0] == inputs_i)
  `FV_COVER(seen_silent_then_loud, !int_no && second_q)

endmodule

`default_nettype wire
