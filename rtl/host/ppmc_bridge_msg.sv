// SPDX-License-Identifier: Apache-2.0
// ppmc_bridge_msg: selects the next message (answer, event or NAK), and supplies its bytes.
// Rules:  UB-ANS-01, UB-MSG-01/02, UB-FRM-07 (order).
// Timing: same as ppmc_bridge_tx. answered_o is high for one cycle after the last stop bit of an answer.
`default_nettype none

module ppmc_bridge_msg
  import ppmc_bridge_pkg::*;
(
    input  wire logic                 clk_i,
    input  wire logic                 rst_ni,
    // answer; all inputs are stable while answer_i = 1
    input  wire logic                 script_i,       // 1: a script is running, no new message is begun
    input  wire logic                 answer_i,       // 1: an answer is available; 1 until answered_o
    input  wire logic           [6:0] seq_i,          // sequence number of the request
    input  wire script_result_t       result_i,       // result of the script
    output logic                [7:0] raddr_o,        // address in the answer
    input  wire logic           [7:0] rdata_i,        // byte at raddr_o, two cycles later
    output logic                      answered_o,     // strobe: the answer has been sent
    // event
    input  wire logic                 event_i,        // 1: an event message is pending
    input  wire logic           [7:0] pins_i,         // pins in the event message
    output logic                      event_taken_o,  // strobe: the event message is being sent
    // NAK
    input  wire nak_e                 nak_i,          // NAK to be sent; NakNone: no NAK
    output logic                      nak_taken_o,    // strobe: the NAK is being sent
    // framer
    output logic                      start_o,        // strobe: begin a frame
    input  wire logic                 idle_i,         // 1: the framer is idle
    output logic                [7:0] byte_o,         // next byte of the frame
    output logic                      more_o,         // 1: byte_o is valid, 0: the frame ends
    input  wire logic                 take_i          // strobe: byte_o is accepted
);

  typedef enum logic [1:0] {
    MsgAnswer,
    MsgEvent,
    MsgNak
  } msg_kind_e;

  msg_kind_e kind_q;
  logic sending_q;  // 1 from start_o to the last stop bit
  logic [2:0] head_q;  // index of the next byte of the head; 4: the head is complete
  logic [8:0] index_q;  // index of the data byte
  logic tail_q;  // 1: no data byte is left

  assign raddr_o       = index_q[7:0];
  assign answered_o    = sending_q && idle_i && !start_o && kind_q == MsgAnswer;
  assign event_taken_o = take_i && kind_q == MsgEvent && head_q[0];
  assign nak_taken_o   = take_i && kind_q == MsgNak && head_q[0];
  assign more_o        = !head_q[2] || !(tail_q || kind_q != MsgAnswer);

  always_comb begin
    unique case (head_q)
      3'd0: byte_o = kind_q == MsgAnswer ? {1'b0, seq_i} : {7'b1000000, kind_q == MsgNak};
      3'd1: begin
        unique case (kind_q)
          MsgAnswer: byte_o = 8'(result_i.result);
          MsgEvent:  byte_o = pins_i;
          default:   byte_o = 8'(nak_i);
        endcase
      end
      3'd2: byte_o = result_i.pos;
      3'd3: byte_o = result_i.last;
      default: byte_o = rdata_i;
    endcase
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      sending_q <= 1'b0;
      start_o   <= 1'b0;
      kind_q    <= MsgAnswer;
    end else begin
      start_o <= 1'b0;
      if (sending_q) begin
        if (idle_i && !start_o) sending_q <= 1'b0;
      end else if (answer_i || (!script_i && (event_i || nak_i != NakNone))) begin
        sending_q <= 1'b1;
        start_o   <= 1'b1;
        if (answer_i) kind_q <= MsgAnswer;
        else kind_q <= event_i ? MsgEvent : MsgNak;
      end
    end
  end

  always_ff @(posedge clk_i) begin
    tail_q <= index_q == result_i.length;
    if (start_o) begin
      head_q  <= '0;
      index_q <= '0;
    end else if (take_i) begin
      if (head_q[2]) index_q <= index_q + 1'b1;
      else if (head_q == 3'd1 && (kind_q != MsgAnswer || result_i.result == ResDone)) head_q <= 3'd4;
      else head_q <= head_q + 1'b1;
    end
  end

endmodule

`default_nettype wire
