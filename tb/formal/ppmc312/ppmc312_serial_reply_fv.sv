// SPDX-License-Identifier: Apache-2.0
// ppmc312_serial_reply_fv: proves that each frame has exactly one reply, and compares the reply with the
// tables of the rules.
`include "ppmc_fv.svh"
`default_nettype none

module ppmc312_serial_reply_fv
  import ppmc312_pkg::*;
  import ppmc312_link_pkg::*;
  import ppmc312_serial_pkg::*;
(
    input wire logic               clk_i,
    input wire logic               poll_i,
    input wire logic               run_i,
    input wire logic               fault_i,
    input wire logic               unknown_code_i,
    input wire logic         [7:0] code_i,
    input wire logic               framing_i,
    input wire logic               overrun_i,
    input wire status_e            status_i,
    input wire poll_result_t       poll_result_i,
    input wire host_result_t       host_result_i,
    input wire logic               sent_i
);

  logic busy_o, report_take_o, blk_valid_o, send_o;
  reply_t reply_o;
  serial_code_t info_i;

  `FV_RESET

  ppmc312_serial_code_rom u_rom (
      .clk_i,
      .code_i,
      .info_o(info_i)
  );

  ppmc312_serial_reply dut (.*);

  // Code and meaning are those of the frame, and are stable until the next frame.
  logic frame, frame_q;
  logic [7:0] code_q;
  logic [1:0] still_q;  // cycles for which code_i has been stable, at most 3
  assign frame = poll_i || run_i || fault_i || unknown_code_i;
  always_ff @(posedge clk_i) begin
    frame_q <= rst_ni && frame;
    if (!rst_ni || code_i != code_q) still_q <= '0;
    else if (still_q != '1) still_q <= still_q + 2'd1;
    code_q <= code_i;
  end

  `FV_ASSUME(one_frame, $onehot0({poll_i, run_i, fault_i, unknown_code_i}) && !(frame && busy_o))
  `FV_ASSUME(code_before_the_frame, !run_i || (still_q == '1 && info_i.is_known && code_i == code_q))
  `FV_ASSUME(code_stands, !(busy_o || frame_q) || code_i == code_q)
  `FV_ASSUME(one_error, $onehot0({fault_i, overrun_i, framing_i}) && !((overrun_i || framing_i) && frame))
  `FV_ASSUME(error_between_frames, !($past(rst_ni && frame) && (overrun_i || framing_i)))
  `FV_ASSUME(executes_a_valid_block, !host_result_i.valid || blk_valid_o)
  `FV_ASSUME(sends_a_reply, !sent_i || send_o)
  `FV_ASSUME(a_status, $onehot(status_i))
  `FV_ASSUME(a_class, poll_result_i.report_class <= 4'd8)
  `FV_ASSUME(one_cause, $onehot0(poll_result_i.cause))

  // ---- one reply for each frame -----------------------------------------------------------------------

  typedef enum logic [2:0] {
    None,
    Poll,
    Run,
    Fault,
    Unknown
  } frame_e;

  frame_e owed_q;  // frame whose reply has not been sent
  logic executed_q;  // the core has executed the block
  logic send_q;
  logic [1:0] wait_q;  // cycles from the frame, or from the result of the core, without a reply

  always_ff @(posedge clk_i) begin
    send_q <= rst_ni && send_o;
    if (!rst_ni) {owed_q, executed_q, wait_q} <= {None, 3'd0};
    else begin
      if (poll_i) owed_q <= Poll;
      if (run_i) owed_q <= Run;
      if (fault_i) owed_q <= Fault;
      if (unknown_code_i) owed_q <= Unknown;
      if (sent_i) owed_q <= None;
      executed_q <= !frame && (executed_q || host_result_i.valid);
      wait_q <= (owed_q == None || send_o || blk_valid_o || frame) ? '0 : wait_q + 2'd1;
    end
  end

  `FV_ASSERT(p312_ser_19_no_reply_without_a_frame, !send_o || owed_q != None)
  `FV_ASSERT(p312_ser_19_busy_until_the_reply, busy_o == (owed_q != None))
  `FV_ASSERT(p312_ser_19_in_time, wait_q < 2'd2)
  `FV_ASSERT(p312_ser_19_stays, !send_q || $past(sent_i) || (send_o && reply_o == $past(reply_o)))
  `FV_ASSERT(p312_ser_14_runs_once, !blk_valid_o || (owed_q == Run && !executed_q && !info_i.local_read))
  `FV_ASSERT(p312_ser_30_takes_once, report_take_o == $past(rst_ni && poll_i))

  // ---- contents -----------------------------------------------------------------------------------------

  logic result_q, local_q;  // the cycle after the result of the core; the cycle after the frame
  logic standstill, moving;
  logic [7:0] registered_q;  // error register: last error code, 00 if there is none
  logic [3:0] class_n;
  logic [7:0] item, end_byte;
  reply_t expected, expected_q;
  logic fails;
  logic [7:0] error;

  assign standstill = status_i inside {StatusIni, StatusNor};
  assign moving     = status_i inside {StatusAcc, StatusFix, StatusWrn};
  assign class_n    = poll_result_i.report_class;

  always_comb begin
    unique case (poll_result_i.cause)
      8'h80:   end_byte = 8'h31;
      8'h40:   end_byte = 8'h38;
      8'h20:   end_byte = 8'h32;
      8'h10:   end_byte = 8'h39;
      8'h08:   end_byte = 8'h36;
      8'h04:   end_byte = 8'h37;
      8'h02:   end_byte = 8'h34;
      8'h01:   end_byte = 8'h33;
      default: end_byte = 8'h00;
    endcase
    unique case (class_n)
      4'd1: item = 8'h46;
      4'd2:
      item = (poll_result_i.trigger_result == FailEvent) ? 8'h4a :
          (poll_result_i.trigger_result == FailOverride) ? 8'h4b :
          (poll_result_i.trigger_result == DoneOverride) ? 8'h28 : 8'h29;
      4'd3: item = 8'h22;
      4'd4: item = 8'h23;
      4'd6: item = 8'h2a;
      4'd7: item = poll_result_i.outside ? 8'h27 : 8'h26;
      4'd8: item = poll_result_i.outside ? 8'h25 : 8'h24;
      default: item = end_byte;
    endcase
    // Registration of an event instruction: first parameter 1, 2 and 5 is a failure.
    fails = host_result_i.code[7:4] == 4'hf;
    unique case (host_result_i.code)
      8'hf0:   error = 8'h42;
      8'hf1:   error = 8'h43;
      8'hf2:   error = 8'h44;
      8'hf5:   error = 8'h47;
      8'hf6:   error = 8'h48;
      default: error = 8'h49;
    endcase
    if (host_result_i.code == I_EVT_SET && host_result_i.first inside {3'd1, 3'd2, 3'd5}) fails = 1'b1;
    expected = '{kind: ReplySpecific, count: 3'd1, from_response: 1'b0, data: '0};
    unique case (owed_q)
      Poll:
      if (class_n == '0) begin
        expected.kind  = moving ? ReplyBusy : ReplyReady;
        expected.count = 3'd0;
      end else begin
        expected.kind = (class_n == 4'd5) ? ReplyData : ReplySpecific;
        expected.data[0] = item;
        if (class_n == 4'd6) begin
          expected.count = 3'd3;
          expected.data  = {poll_result_i.data, 7'd0, poll_result_i.discarded, item};
        end
      end
      Fault:   expected.data[0] = 8'h41;
      Unknown: expected.data[0] = 8'h47;
      default:
      if (!info_i.local_read) begin
        if (fails) expected.data[0] = error;
        else
          expected = '{
              kind: (info_i.reply_bytes == '0) ? ReplyReady : ReplyData,
              count: info_i.reply_bytes,
              from_response: 1'b1,
              data: '0
          };
      end else if (code_i != 8'h40 && !standstill) expected.data[0] = 8'h43;
      else begin
        expected.kind = ReplyData;
        unique case (code_i)
          8'h40: expected.data[0] = end_byte;
          8'h4e: expected.data[0] = registered_q;
          default: begin
            expected.count = 3'd3;
            expected.data  = dut.counts;
          end
        endcase
      end
    endcase
  end

  logic decides;  // the reply is decided in this cycle
  assign decides = (frame_q && (owed_q != Run || info_i.local_read)) || result_q;

  always_ff @(posedge clk_i) begin
    result_q <= rst_ni && host_result_i.valid;
    if (!rst_ni) registered_q <= '0;
    else if (decides) begin
      if (expected.kind == ReplySpecific && owed_q inside {Run, Unknown}) registered_q <= expected.data[0];
      else if (owed_q == Run && info_i.local_read && code_i == 8'h4e) registered_q <= '0;
    end
    if (decides) expected_q <= expected;
  end

  logic [2:0][7:0] used;  // data bytes that are sent
  always_comb
    for (int unsigned n = 0; n < 3; n++)
      used[n] = (3'(n) < expected_q.count && !expected_q.from_response) ? 8'hff : 8'h00;

  `FV_ASSUME(
      result_of_a_host_block,
      !result_q || !fails || host_result_i.code inside {8'hf0, 8'hf1, 8'hf2, 8'hf5, 8'hf6, 8'hf7, I_EVT_SET})
  // verilog_format: off
  `FV_ASSERT(
      p312_ser_20_kind,
      !send_o
          || {reply_o.kind, reply_o.count, reply_o.from_response}
              == {expected_q.kind, expected_q.count, expected_q.from_response})
  // verilog_format: on
  `FV_ASSERT(p312_ser_20_data, !send_o || (reply_o.data & used) == (expected_q.data & used))
  `FV_ASSERT(p312_ser_45_register,
             dut.error_q == 4'd0 ? registered_q == '0 : registered_q == {4'h4, dut.error_q})
  `FV_COVER(seen_error_read,
            send_o && expected_q.data[0] == 8'h44 && expected_q.kind == ReplyData && code_i == 8'h4e)
  `FV_COVER(seen_poll, sent_i && owed_q == Poll)
  `FV_COVER(seen_unknown, sent_i && owed_q == Unknown)

endmodule

`default_nettype wire
