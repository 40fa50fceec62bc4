// SPDX-License-Identifier: Apache-2.0
// ppmc_bridge_rx_fv: proves that the deframer never hangs, accepts only complete frames with a correct CRC,
// and keeps a NAK until it is sent. Assumes that characters are at least 4 cycles apart.
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
  `FV_COVER(seen_escape, we_o && wdata_o == FLAG)
  `FV_COVER(seen_short, nak_o == NakShort)
  `FV_COVER(seen_crc, nak_o == NakCrc)

endmodule

`default_nettype wire
