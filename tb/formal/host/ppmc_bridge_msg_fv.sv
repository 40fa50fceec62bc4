// SPDX-License-Identifier: Apache-2.0
// ppmc_bridge_msg_fv: proves that one message is sent at a time, that answers have priority, that no event
// or NAK begins while a script runs, and that each message has the correct length.
`include "ppmc_fv.svh"
`default_nettype none

module ppmc_bridge_msg_fv
  import ppmc_bridge_pkg::*;
(
    input wire logic                 clk_i,
    input wire logic                 script_i,
    input wire logic                 want_i,
    input wire logic           [6:0] seq_i,
    input wire script_result_t       result_i,
    input wire logic           [7:0] rdata_i,
    input wire logic                 event_i,
    input wire logic           [7:0] pins_i,
    input wire logic           [3:0] nak_code_i,
    input wire logic                 end_i,
    input wire logic                 step_i
);

  logic [7:0] raddr_o, byte_o;
  logic answer_i, answered_o, event_taken_o, nak_taken_o, start_o, idle_i, more_o, take_i;
  nak_e nak_i;

  assign nak_i = nak_e'(nak_code_i);

  `FV_RESET

  ppmc_bridge_msg dut (.*);

  // Model of the framer: it is busy from start_o until some time after the last byte, and accepts bytes at
  // least 3 cycles apart.
  logic framing_q, over_q;
  logic [1:0] gap_q;

  assign idle_i = !framing_q;
  assign take_i = framing_q && !over_q && more_o && step_i && gap_q == '1;

  always_ff @(posedge clk_i)
    if (!rst_ni) {framing_q, over_q, gap_q} <= '0;
    else begin
      gap_q <= (start_o || take_i) ? '0 : (gap_q == '1) ? '1 : gap_q + 1'b1;
      if (start_o) {framing_q, over_q} <= 2'b10;
      else if (framing_q && gap_q == '1 && !more_o) over_q <= 1'b1;
      if (over_q && end_i) {framing_q, over_q} <= 2'b00;
    end

  // Model of the script unit: an answer is valid until it has been sent.
  logic answer_q;
  assign answer_i = answer_q;
  always_ff @(posedge clk_i) answer_q <= rst_ni && (answer_q ? !answered_o : want_i && !script_i);

  `FV_ASSUME(answer_stands, !answer_q || {seq_i, result_i} == $past({seq_i, result_i}))
  `FV_ASSUME(short_answer, result_i.length <= 9'd3)
  `FV_ASSUME(no_script_with_an_answer, !(script_i && answer_q))
  `FV_ASSUME(nak_stands, !$past(rst_ni && nak_i != NakNone && !nak_taken_o) || nak_i == $past(nak_i))

  logic own_q, answer_prev_q;  // own_q: the frame is an answer; answer_prev_q: answer_i one cycle ago
  logic is_done;
  assign is_done = result_i.result == ResDone;
  logic [3:0] bytes_q;

  always_ff @(posedge clk_i)
    if (!rst_ni || start_o) {bytes_q, own_q} <= {4'd0, start_o && answer_prev_q};
    else bytes_q <= bytes_q + 4'(take_i);

  always_ff @(posedge clk_i) answer_prev_q <= rst_ni && answer_i;

  `FV_ASSERT(starts_when_idle, !start_o || idle_i)
  `FV_ASSERT(ub_frm_07_nothing_begins_in_a_script, !(start_o && !answer_i) || $past(!script_i))
  `FV_ASSERT(ub_ans_01_answered_once_it_is_sent, !answered_o || (answer_i && own_q && !framing_q))
  `FV_ASSERT(ub_ans_01_length,
             !(over_q && answer_i && own_q && is_done) || 9'(bytes_q) == 9'd2 + result_i.length)
  `FV_ASSERT(ub_ans_01_length_of_a_failure,
             !(over_q && answer_i && own_q && !is_done) || 9'(bytes_q) == 9'd4 + result_i.length)
  `FV_ASSERT(ub_msg_01_two_bytes, !(over_q && framing_q && !own_q) || bytes_q == 4'd2)
  `FV_ASSERT(ub_frm_07_one_is_taken, !(event_taken_o && nak_taken_o))
  `FV_COVER(seen_answer, answered_o && bytes_q == 4'd7)
  `FV_COVER(seen_nak, nak_taken_o && event_i)

endmodule

`default_nettype wire
