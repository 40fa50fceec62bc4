// SPDX-License-Identifier: Apache-2.0
// ppmc_bridge_rx: extracts requests from the received bytes. Handles flags, escapes, CRC, length and
//         silence.
// Rules:  UB-FRM-01 .. 08, UB-SEQ-03.
// Timing: outputs respond two cycles after valid_i or error_i.
// Assumes: byte_i is stable for these two cycles.
// Note:   the script of a request is stored from address 0 of the buffer on; its CRC follows it.
`include "ppmc_assert.svh"
`default_nettype none

module ppmc_bridge_rx
  import ppmc_bridge_pkg::*;
(
    input  wire logic       clk_i,
    input  wire logic       rst_ni,
    input  wire logic       ms_i,        // strobe every millisecond
    // receiver
    input  wire logic [7:0] byte_i,      // received character
    input  wire logic       valid_i,     // strobe: byte_i was received with a stop bit
    input  wire logic       error_i,     // strobe: byte_i was received without a stop bit
    // request buffer
    output logic            we_o,        // write enable of the request buffer
    output logic      [7:0] waddr_o,     // write address
    output logic      [7:0] wdata_o,     // write data
    // received frame
    output logic            good_o,      // strobe: a valid frame
    output logic            request_o,   // with good_o; 1: a request to be executed or answered again
    output logic      [6:0] seq_o,       // sequence number of the frame
    output logic      [7:0] length_o,    // length of the script in bytes, with request_o
    // while a script runs or its answer is sent
    input  wire logic       busy_i,      // 1: no request can be accepted
    output logic            dropped_o,   // 1: a byte was received while busy_i = 1
    // NAK to be sent
    output nak_e            nak_o,       // NAK to be sent; NakNone: no NAK
    input  wire logic       nak_taken_i  // strobe: the NAK is being sent
);

  localparam logic [8:0] Empty = '1;
  localparam int unsigned QuietBits = $clog2(SILENCE_MS + 1);

  logic hunt_q, escaped_q, seq_high_q;
  logic [8:0] index_q;  // index of the previous byte of the frame, 0: SEQ; Empty: no byte
  logic [15:0] crc_q;
  logic [QuietBits-1:0] quiet_q;  // time in ms until the silence is too long
  logic is_flag_q, is_escape_q, valid_q, error_q, busy_q, short_q, crc_bad_q, quiet_over_q, open_q;
  logic flag, begin_q, content, silent;
  nak_e fault;

  assign wdata_o  = byte_i ^ (8'(escaped_q) << ESCAPE_BIT);
  assign waddr_o  = index_q[7:0];
  assign we_o     = content;
  assign length_o = index_q[7:0] - 8'd2;

  assign flag     = valid_q && !busy_q && is_flag_q;
  assign content  = valid_q && !busy_q && !hunt_q && !is_flag_q && (escaped_q || !is_escape_q);
  assign silent   = ms_i && quiet_over_q && open_q && !hunt_q && !busy_q;

  // These signals are decoded one cycle before they are used. Their operands are stable between two
  // characters.
  always_ff @(posedge clk_i) begin
    is_flag_q    <= byte_i == FLAG;
    is_escape_q  <= byte_i == ESCAPE;
    short_q      <= index_q[8:1] == '0;
    crc_bad_q    <= crc_q != '0;
    open_q       <= index_q != Empty || escaped_q;
    quiet_over_q <= quiet_q == '0 && !valid_q;  // a character restarts quiet_q
  end

  always_comb begin
    fault = NakNone;
    if (busy_q) begin
      if (!busy_i && dropped_o) fault = NakBusy;
    end else if (!hunt_q) begin
      if (error_q) fault = NakFraming;
      else if (valid_q && is_flag_q) begin
        if (escaped_q) fault = NakAbort;
        else if (open_q && short_q) fault = NakShort;
        else if (open_q && crc_bad_q) fault = NakCrc;
        else if (open_q && seq_high_q) fault = NakSeq;
      end else if (content && index_q == 9'd255) fault = NakLong;
      else if (silent) fault = NakSilence;
    end
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      valid_q   <= 1'b0;
      error_q   <= 1'b0;
      busy_q    <= 1'b0;
      begin_q   <= 1'b1;
      hunt_q    <= 1'b1;
      dropped_o <= 1'b0;
      good_o    <= 1'b0;
      request_o <= 1'b0;
      nak_o     <= NakNone;
    end else begin
      valid_q   <= valid_i;
      error_q   <= error_i;
      busy_q    <= busy_i;
      begin_q   <= flag;
      good_o    <= 1'b0;
      request_o <= 1'b0;
      dropped_o <= busy_i && (dropped_o || (busy_q && (error_q || (valid_q && !is_flag_q))));
      if (nak_taken_i) nak_o <= NakNone;
      if (fault != NakNone && nak_o == NakNone) nak_o <= fault;
      if (fault inside {NakFraming, NakLong, NakSilence, NakBusy}) hunt_q <= 1'b1;
      if (flag) begin
        hunt_q    <= 1'b0;
        good_o    <= !hunt_q && open_q && fault inside {NakNone, NakSeq};
        request_o <= !hunt_q && open_q && fault == NakNone;
      end
    end
  end

  always_ff @(posedge clk_i) begin
    if (valid_q && !busy_q) quiet_q <= QuietBits'(SILENCE_MS);
    else if (ms_i) quiet_q <= quiet_q - 1'b1;
    if (valid_q && !busy_q) escaped_q <= content || is_flag_q ? 1'b0 : is_escape_q;
    // index_q is cleared one cycle after the flag, so that length_o is valid with request_o.
    if (begin_q) begin
      index_q <= Empty;
      crc_q   <= '1;
    end else if (content) begin
      index_q <= index_q + 1'b1;
      crc_q   <= crc_next(crc_q, wdata_o);
    end
    if (content && index_q == Empty) {seq_high_q, seq_o} <= wdata_o;
  end

`ifndef SYNTHESIS
  `PPMC_ASSERT(ub_frm_06_request_is_good, good_o || !request_o)
`endif

endmodule

`default_nettype wire
