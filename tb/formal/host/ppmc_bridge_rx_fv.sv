// SPDX-License-Identifier: Apache-2.0
// ppmc_bridge_rx_fv: proves that the deframer never hangs, reports exactly the complete frames with a correct
// CRC, and sends the NAK of each fault. Assumes that characters are at least 4 cycles apart.
`include "ppmc_fv.svh"
`default_nettype none

module ppmc_bridge_rx_fv
  import ppmc_bridge_pkg::*;
(
    input wire logic       clk_i,
    input wire logic       ms_i,
    input wire logic [7:0] character_i,
    input wire logic       valid_i,
    input wire logic       error_i,
    input wire logic       busy_i,
    input wire logic       nak_taken_i
);

  logic we_o, good_o, request_o, dropped_o;
  logic [7:0] byte_i, waddr_o, wdata_o, length_o;
  logic [6:0] seq_o;
  nak_e nak_o;

  `FV_RESET

  ppmc_bridge_rx dut (.*);

  logic [1:0] gap_q;  // cycles since the last character, saturates at 3
  logic [7:0] byte_q;

  assign byte_i = (valid_i || error_i) ? character_i : byte_q;

  always_ff @(posedge clk_i) begin
    byte_q <= byte_i;
    gap_q  <= (!rst_ni || valid_i || error_i) ? '0 : (gap_q == '1) ? '1 : gap_q + 1'b1;
  end

  `FV_ASSUME(characters_apart, !(valid_i || error_i) || gap_q == '1)
  `FV_ASSUME(one_outcome, !(valid_i && error_i))

  logic flag_q, flag2_q;  // flag_q: a flag was received one cycle ago; flag2_q: two cycles ago
  logic fresh_q;  // 1: no other character since the last flag
  logic idle_q, idle2_q;  // idle_q: no script was running one cycle ago; idle2_q: two cycles ago

  always_ff @(posedge clk_i)
    if (!rst_ni) {flag_q, flag2_q, fresh_q, idle_q, idle2_q} <= '0;
    else begin
      {idle2_q, idle_q} <= {idle_q, !busy_i};
      {flag2_q, flag_q} <= {flag_q, valid_i && character_i == FLAG && !busy_i};
      if (valid_i || error_i) fresh_q <= valid_i && character_i == FLAG;
    end

  `FV_ASSERT(ub_frm_01_good_ends_with_a_flag, !good_o || flag2_q)
  `FV_ASSERT(ub_frm_06_request_is_good, !request_o || good_o)
  `FV_ASSERT(ub_frm_03_crc, !good_o || $past(dut.crc_q) == '0)
  `FV_ASSERT(ub_frm_04_length, !request_o || ($past(dut.index_q) >= 9'd2 && $past(dut.index_q) <= 9'd255))
  `FV_ASSERT(ub_frm_02_never_writes_a_flag_raw, !we_o || $past(byte_i) != FLAG)
  `FV_ASSERT(ub_frm_04_within_the_buffer, !we_o || dut.index_q == 9'h1FF || dut.index_q <= 9'd255)
  // The deframer never hangs: after a flag, it receives the next frame, regardless of the characters before
  // the flag.
  `FV_ASSERT(ub_frm_05_a_flag_makes_it_listen, !(flag2_q && $past(idle2_q && !busy_i)
             ) || !dut.hunt_q || busy_i || !idle2_q)
  `FV_ASSERT(nak_stands_until_taken, !($past(rst_ni && nak_o != NakNone && !nak_taken_i)) || nak_o == $past
             (nak_o))
  `FV_ASSERT(nothing_is_written_while_busy, !(we_o && !idle_q))
  // ---- reference -----------------------------------------------------------------------------------

  // The reference evaluates a character one cycle after valid_i or error_i, as the block does.
  logic valid_q, error_q, busy_q;
  logic hunt_q, escaped_q, dropped_q;
  logic [ 8:0] count_q;  // bytes of the frame
  logic [15:0] crc_q;
  logic [ 6:0] ms_q;  // milliseconds since the last byte, at most SILENCE_MS
  logic [7:0] first_q, content;  // first byte of the frame; byte without its escape
  logic is_flag, is_content, is_open, complete, silent;  // is_open: a part of a frame has been received
  nak_e reason, nak_q;

  assign content = byte_i ^ (escaped_q ? 8'h20 : 8'h00);
  assign is_flag = valid_q && !busy_q && byte_i == FLAG;
  assign is_content = valid_q && !busy_q && !hunt_q && byte_i != FLAG && (escaped_q || byte_i != ESCAPE);
  assign is_open = count_q != '0 || escaped_q;
  assign complete = is_flag && !hunt_q && !escaped_q && count_q >= 9'd3 && crc_q == '0;
  assign silent = ms_i && ms_q == 7'(SILENCE_MS) && is_open;

  always_comb begin
    reason = NakNone;
    if (busy_q) begin
      if (!busy_i && dropped_q) reason = NakBusy;
    end else if (!hunt_q) begin
      if (error_q) reason = NakFraming;
      else if (is_flag && escaped_q) reason = NakAbort;
      else if (is_flag && count_q inside {9'd1, 9'd2}) reason = NakShort;
      else if (is_flag && count_q != '0 && crc_q != '0) reason = NakCrc;
      else if (complete && first_q[7]) reason = NakSeq;
      else if (is_content && count_q == 9'd256) reason = NakLong;
      else if (silent && !is_flag) reason = NakSilence;
    end
  end

  always_ff @(posedge clk_i) begin
    {valid_q, error_q, busy_q} <= {valid_i, error_i, busy_i} & {3{rst_ni}};
    if (!rst_ni) hunt_q <= 1'b1;
    else if (reason inside {NakFraming, NakLong, NakSilence, NakBusy}) hunt_q <= 1'b1;
    else if (is_flag) hunt_q <= 1'b0;
    dropped_q <= rst_ni && busy_i && (dropped_q || (busy_q && (error_q || (valid_q && byte_i != FLAG))));
    if (!rst_ni || nak_taken_i) nak_q <= NakNone;
    if (rst_ni && nak_q == NakNone) nak_q <= reason;
    if (valid_q && !busy_q) escaped_q <= !is_content && byte_i == ESCAPE;
    if (valid_q && !busy_q) ms_q <= '0;
    else if (ms_i && ms_q != 7'(SILENCE_MS)) ms_q <= ms_q + 1'b1;
    if (!rst_ni || is_flag) {count_q, crc_q} <= 25'h000_ffff;
    else if (is_content) begin
      count_q <= count_q + 1'b1;
      crc_q   <= crc_next(crc_q, content);
      if (count_q == '0) first_q <= content;
    end
  end

  `FV_ASSUME(busy_after_request, !busy_i || $past(busy_i) || $past(request_o))
  // The silence is decoded one cycle in advance, so two milliseconds must not follow each other directly.
  `FV_ASSUME(ms_apart, !(ms_i && $past(ms_i)))

  `FV_ASSERT(lemma_hunt, hunt_q == dut.hunt_q)
  `FV_ASSERT(lemma_delayed, {valid_q, error_q, busy_q} == {dut.valid_q, dut.error_q, dut.busy_q})
  `FV_ASSERT(lemma_byte, !valid_q || {dut.is_flag_q, dut.is_escape_q} == {byte_i == FLAG, byte_i == ESCAPE})
  `FV_ASSERT(lemma_escaped, hunt_q || escaped_q == dut.escaped_q)
  `FV_ASSERT(lemma_begin, !dut.begin_q || {count_q, crc_q} == 25'h000_ffff)
  `FV_ASSERT(lemma_count, dut.begin_q || {dut.index_q, dut.crc_q} == {count_q - 9'd1, crc_q})
  `FV_ASSERT(lemma_first, count_q == '0 || {dut.seq_high_q, seq_o} == first_q)
  `FV_ASSERT(lemma_gap, !(valid_q || error_q) || gap_q == '0)
  `FV_ASSERT(lemma_open, hunt_q || !(gap_q == '1 || valid_q) || dut.open_q == is_open)
  `FV_ASSERT(lemma_short, hunt_q || !(gap_q == '1 || valid_q) || dut.short_q == (count_q inside {9'd1, 9'd2}))
  `FV_ASSERT(lemma_crc, hunt_q || !(gap_q == '1 || valid_q) || dut.crc_bad_q == (crc_q != '0))
  `FV_ASSERT(lemma_quiet, hunt_q || !is_open || dut.quiet_q == 7'(SILENCE_MS) - ms_q)
  `FV_ASSERT(lemma_ms, ms_q <= 7'(SILENCE_MS) || hunt_q)
  `FV_ASSERT(lemma_over, hunt_q || !is_open || $past(ms_i) || dut.quiet_over_q == (dut.quiet_q == '0))
  `FV_ASSERT(lemma_busy, !(busy_i || busy_q) || hunt_q || !is_open)
  `FV_ASSERT(lemma_request, !request_o || (gap_q == 2'd1 && !hunt_q && !is_open))
  `FV_ASSERT(nak_reason, nak_o == nak_q)
  `FV_ASSERT(dropped, dropped_o == dropped_q)
  `FV_ASSERT(ub_frm_06_complete_frame, good_o == $past(rst_ni && complete))
  `FV_ASSERT(ub_seq_03_request, request_o == $past(rst_ni && complete && !first_q[7]))
  `FV_ASSERT(frame_number, !good_o || seq_o == $past(first_q[6:0]))
  `FV_ASSERT(frame_length, !request_o || length_o == 8'($past(count_q) - 9'd3))
  `FV_ASSERT(writes_content, we_o == is_content)
  `FV_ASSERT(written_byte, !we_o || (wdata_o == content && waddr_o == 8'(count_q - 9'd1)))
  `FV_COVER(seen_request, request_o && length_o == '0)
  `FV_COVER(seen_seq, nak_o == NakSeq)
  `FV_COVER(seen_busy, nak_o == NakBusy)
  `FV_COVER(seen_escape, we_o && wdata_o == FLAG)
  `FV_COVER(seen_short, nak_o == NakShort)
  `FV_COVER(seen_crc, nak_o == NakCrc)

endmodule

`default_nettype wire
