// SPDX-License-Identifier: Apache-2.0
// ppmc312_serial_reply: generates one reply to each frame. Replies immediately to polls, faults and local
//         reads (codes 40, 4E, 4F), and to other instructions after the core has executed them.
// Rules:  P312-SER-14, P312-SER-17..20, P312-SER-30, P312-SER-45/46, P312-STA-01 (4E, 4F).
// Timing: a frame ends in cycle n. In cycle n + 2, either it is offered to the core, or its reply is valid.
`include "ppmc_assert.svh"
`default_nettype none

module ppmc312_serial_reply
  import ppmc312_pkg::*;
  import ppmc312_link_pkg::*;
  import ppmc312_serial_pkg::*;
(
    input  wire logic               clk_i,           // clock
    input  wire logic               rst_ni,          // reset, asynchronous
    // frames: strobes
    input  wire logic               poll_i,          // a poll
    input  wire logic               run_i,           // an instruction with a correct checksum
    input  wire logic               fault_i,         // wrong checksum or invalid character
    input  wire logic               unknown_code_i,  // unknown code
    input  wire logic         [7:0] code_i,          // received code
    input  wire serial_code_t       info_i,          // meaning of code_i
    input  wire logic               framing_i,       // a character without a stop bit
    input  wire logic               overrun_i,       // a frame was received while busy_o = 1
    output logic                    busy_o,          // a reply is pending or being sent
    // core
    input  wire status_e            status_i,        // status of the device
    output logic                    report_take_o,   // strobe: the report in poll_result_i is consumed
    input  wire poll_result_t       poll_result_i,   // report for the next poll
    output logic                    blk_valid_o,     // a block is pending for the core
    input  wire host_result_t       host_result_i,   // result of the executed block
    // sender
    output logic                    send_o,          // 1: send reply_o; high until sent_i
    output reply_t                  reply_o,         // reply, stable while send_o = 1
    input  wire logic               sent_i           // strobe: the reply has been sent
);

  typedef enum logic [1:0] {
    StIdle,
    StRun,
    StSend
  } state_e;

  state_e state_q;
  reply_t poll_reply, reply;
  logic poll_q, run_q, fault_q, unknown_code_q, read_counts, fails, rejected, local_read, done_q, reply_we;
  logic [3:0] error, error_q;
  logic [2:0] errors_q;
  logic [2:0][7:0] counts;

  ppmc312_serial_poll u_poll (
      .poll_result_i(poll_result_i),
      .status_i,
      .reply_o(poll_reply)
  );

  ppmc312_serial_errors u_errors (
      .clk_i,
      .rst_ni,
      .error_i(errors_q),
      .read_i (read_counts),
      .count_o(counts)
  );

  // The registers delay the counters by one cycle. This has no effect, because an error and a read of the
  // counters never belong to the same character.
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) errors_q <= '0;
    else errors_q <= {fault_i, overrun_i, framing_i};
  end

  // ---- reply --------------------------------------------------------------------------------------

  assign rejected = code_i != S_END && !(status_i inside {StatusIni, StatusNor});
  assign local_read = run_q && info_i.local_read;
  assign report_take_o = poll_q;
  assign read_counts = local_read && !rejected && code_i == S_COUNTS;

  always_comb begin
    fails = 1'b0;
    error = host_result_i.code[3:0] + 4'd2;  // error code for response F0: 42, F1: 43, F2: 44, F6: 48, F7: 49
    if (host_result_i.code[7:4] == 4'hf) fails = 1'b1;
    else if (host_result_i.code == I_EVT_SET && host_result_i.first inside {3'd1, 3'd2, 3'd5}) begin
      fails = 1'b1;
      error = 4'd9;
    end
    if (unknown_code_q) error = 4'd7;
    if (local_read) error = 4'd3;
  end

  always_comb begin
    reply = '{kind: ReplySpecific, count: 3'd1, from_response: 1'b0, data: {16'd0, 4'h4, error}};
    if (poll_q) reply = poll_reply;
    else if (fault_q) reply.data[0] = 8'h41;
    else if (local_read && !rejected) begin
      reply.kind = ReplyData;
      unique case (code_i)
        S_END:   reply.data[0] = end_code(poll_result_i.cause);
        S_ERROR: reply.data[0] = {1'b0, error_q != '0, 2'b00, error_q};
        default: begin
          reply.count = 3'd3;
          reply.data  = counts;
        end
      endcase
    end else if (done_q && !fails) begin
      reply.kind = (info_i.reply_bytes == '0) ? ReplyReady : ReplyData;
      reply.count = info_i.reply_bytes;
      reply.from_response = 1'b1;
    end
  end

  assign reply_we = poll_q || fault_q || unknown_code_q || local_read || done_q;

  always_ff @(posedge clk_i) begin
    if (reply_we) reply_o <= reply;
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) error_q <= '0;
    else if (unknown_code_q || (local_read && rejected) || (done_q && fails)) error_q <= error;
    else if (local_read && code_i == S_ERROR) error_q <= '0;
  end

  // ---- one frame at a time ------------------------------------------------------------------------

  assign busy_o = state_q != StIdle || run_q || poll_q || fault_q || unknown_code_q;
  assign send_o = state_q == StSend;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      state_q                                          <= StIdle;
      {poll_q, run_q, fault_q, unknown_code_q, done_q} <= '0;
      blk_valid_o                                      <= 1'b0;
    end else begin
      {poll_q, run_q, fault_q, unknown_code_q} <= {poll_i, run_i, fault_i, unknown_code_i};
      done_q <= state_q == StRun && host_result_i.valid;
      // 1 in state StRun until the block is executed. This is a separate register, because of its fan-out.
      blk_valid_o <= !reply_we && (run_q || (state_q == StRun && !host_result_i.valid));
      if (reply_we) state_q <= StSend;
      else if (run_q) state_q <= StRun;
      else if (sent_i) state_q <= StIdle;
    end
  end

  logic unused_info;
  assign unused_info = &{1'b0, info_i};

`ifndef SYNTHESIS
  `PPMC_ASSERT(p312_ser_14_valid, blk_valid_o == (state_q == StRun && !done_q))
  `PPMC_ASSERT(p312_ser_14_offer, !blk_valid_o || $past(blk_valid_o || run_q))
  `PPMC_ASSERT(p312_ser_19_one, !reply_we || state_q != StSend)
  logic host_error;  // the code is that of an error of a host instruction
  assign host_error = host_result_i.code[3:0] inside {[4'd0 : 4'd2], [4'd5 : 4'd7]};
  `PPMC_ASSERT(p312_ser_20_codes, !done_q || host_result_i.code[7:4] != 4'hf || host_error)
`endif

endmodule

`default_nettype wire
