// SPDX-License-Identifier: Apache-2.0
// ppmc_bridge_exec_fv: for any script, proves that it ends, that no byte after its end is read, and that
// only ops that write cause a write.
`include "ppmc_fv.svh"
`default_nettype none

module ppmc_bridge_exec_fv
  import ppmc_bridge_pkg::*;
(
    input wire logic       clk_i,
    input wire logic       ms_i,
    input wire logic       start_i,
    input wire logic       resend_i,
    input wire logic [7:0] length_i,
    input wire logic [7:0] rdata_i,
    input wire logic       interrupt_i,
    input wire logic       answered_i,
    input wire logic [7:0] pins_i,
    input wire logic [7:0] d_i,
    input wire logic [7:0] rec_data_i
);

  localparam int unsigned Idle = 0, Decode = 2, Arg = 3, Arg2 = 4, Loop = 6, Poll = 7, Judge = 8, Write = 9,
      WriteEnd = 10;  // values of state_q
  localparam int unsigned Longest = 40;  // bound of the cycles in a state; RESET and IDENT need the most

  logic [7:0] raddr_o, waddr_o, wdata_o, d_o;
  logic script_o, answer_o, we_o, rec_next_o, part_rst_no, cs_no, rd_no, wr_no;
  bridge_cmd_t bridge_cmd_o;
  logic [3:0] a_o;
  logic count_zero_o;
  script_result_t result_o;
  logic [31:0] counter_q;  // constant in this proof, but not in ppmc_bridge_answer_fv

  `FV_RESET

  ppmc_bridge_exec #(
      .Recorder(1'b1)
  ) dut (
      .count_i   (counter_q),
      .rec_info_i('0),
      .*
  );

  logic waiting, sends;
  assign waiting = dut.state_q == Poll || dut.state_q == Judge;
  assign sends   = dut.group inside {OpWrite, OpWriteN, OpPost, OpCall};

  logic begun_q;  // 1: a script has begun, so registers without a reset have a value
  logic [5:0] stay_q;  // cycles in the current state
  logic [7:0] loop_q;  // remaining bytes at the last StLoop of the op
  logic looped_q;
  logic [3:0] over_q;  // cycles for which a wait continues after its time limit

  always_ff @(posedge clk_i) begin
    counter_q <= counter_q;
    if (!rst_ni) {begun_q, stay_q, loop_q, looped_q, over_q} <= '0;
    else begin
      if (start_i) begun_q <= 1'b1;
      stay_q <= (dut.next != dut.state_q || waiting || dut.state_q == Idle || answer_o) ? '0 : stay_q + 1'b1;
      if (dut.state_q == Decode) looped_q <= 1'b0;
      else if (dut.state_q == Loop) {looped_q, loop_q} <= {1'b1, dut.n_q};
      over_q <= (waiting && dut.timeout) ? over_q + 1'b1 : '0;
    end
  end

  `FV_ASSUME(start_in_idle, !((start_i || resend_i) && (script_o || answer_o)) && !(start_i && resend_i))
  `FV_ASSUME(answer_of_something, !resend_i || begun_q)

  `FV_ASSERT(answer_stands, !$past(rst_ni && answer_o) || !answer_o || result_o == $past(result_o))
  `FV_ASSERT(no_script_with_an_answer, !(script_o && answer_o))
  `FV_ASSERT(bytes_of_the_script_alone, !(begun_q && dut.take) || dut.left_q != '0)
  `FV_ASSERT(
      bytes_lemma_there,
      !(begun_q && sends && dut.state_q inside {Loop, Poll, Judge, Write, WriteEnd}) || dut.n_q <= dut.left_q)
  `FV_ASSERT(bytes_lemma_one, !(begun_q && dut.state_q == Write) || dut.n_q != '0)
  `FV_ASSERT(bytes_in_order, !$past(rst_ni && dut.take) || raddr_o == $past(raddr_o) + 1'b1)
  `FV_ASSERT(no_state_for_long, stay_q < 6'(Longest))
  `FV_ASSERT(bytes_count_down, !(begun_q && dut.state_q == Loop && looped_q && $past(dut.state_q)
             != Loop) || dut.n_q == loop_q - 1'b1)
  `FV_ASSERT(no_wait_for_long, over_q <= 4'd13)
  `FV_ASSERT(bytes_written_when_asked, wr_no || sends)
  `FV_COVER(seen_a_call,
            answer_o && result_o.result == ResDone && result_o.length == 1 && dut.group == OpCall)
  `FV_COVER(seen_a_timeout, answer_o && result_o.result == ResTimeout)

endmodule

`default_nettype wire
