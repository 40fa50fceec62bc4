// SPDX-License-Identifier: Apache-2.0
// ppmc_bridge_tx_fv: proves that a frame consists of flag, escaped bytes, CRC and flag, that it ends, that
// it contains no other flag, and that each byte is sent once.
`include "ppmc_fv.svh"
`default_nettype none

module ppmc_bridge_tx_fv
  import ppmc_bridge_pkg::*;
(
    input wire logic       clk_i,
    input wire logic       start_i,
    input wire logic [7:0] next_i,
    input wire logic       more_i
);

  logic idle_o, take_o, valid_o, ready_i;
  logic [7:0] byte_i, byte_o;
  logic valid_i;  // strobe: a character is sent

  assign byte_i  = next_i;
  assign valid_i = valid_o && ready_i;

  `FV_RESET

  ppmc_bridge_tx dut (.*);

  // Model of a transmitter with ten cycles per character. The CRC needs eight cycles.
  logic [3:0] left_q;
  assign ready_i = left_q == '0;
  always_ff @(posedge clk_i)
    if (!rst_ni) left_q <= '0;
    else if (valid_i) left_q <= 4'd10;
    else if (left_q != '0) left_q <= left_q - 1'b1;


  `FV_ASSUME(start_when_idle, !start_i || idle_o)
  `FV_ASSUME(more_stands, ready_i || more_i == $past(more_i))

  // open_q: in a frame; escape_q: the last character was an escape; taken_q: byte_q is pending
  logic open_q, escape_q, taken_q;
  logic [7:0] byte_q;  // pending byte
  logic [1:0] crc_q;  // number of bytes sent after the last byte of the message

  always_ff @(posedge clk_i)
    if (!rst_ni) {open_q, escape_q, taken_q, byte_q, crc_q} <= '0;
    else begin
      if (take_o) {taken_q, byte_q} <= {1'b1, byte_i};
      if (valid_i) begin
        escape_q <= byte_o == ESCAPE;
        if (byte_o == FLAG) {open_q, crc_q} <= {!open_q, 2'd0};
        else if (byte_o != ESCAPE) begin
          taken_q <= 1'b0;
          if (!taken_q) crc_q <= crc_q + 1'b1;
        end
      end
    end

  `FV_ASSERT(ub_frm_01_begins_with_a_flag, !(valid_i && !open_q) || byte_o == FLAG)
  `FV_ASSERT(ub_frm_01_ends_behind_the_crc,
             !(valid_i && open_q && byte_o == FLAG) || (crc_q == 2'd2 && !taken_q))
  `FV_ASSERT(ub_frm_02_no_double_escape, !(valid_i && escape_q) || byte_o inside {8'h5E, 8'h5D})
  `FV_ASSERT(
      each_byte_once,
      !(valid_i && open_q && taken_q && byte_o != ESCAPE) || byte_o == (escape_q ? byte_q ^ 8'h20 : byte_q))
  `FV_ASSERT(ub_frm_02_escaped_if_needed,
             !(valid_i && taken_q && byte_q inside {FLAG, ESCAPE}) || byte_o == ESCAPE || escape_q)
  `FV_ASSERT(takes_one_at_a_time, !(take_o && taken_q))
  `FV_ASSERT(two_crc_bytes, crc_q <= 2'd2)
  `FV_ASSERT(idle_between_frames, !(idle_o && open_q))

  logic was_q;  // 1: an escaped flag has been sent
  always_ff @(posedge clk_i)
    was_q <= rst_ni && (was_q || (valid_i && escape_q && byte_o == 8'h5E && taken_q));

  `FV_COVER(seen_escaped_flag, valid_i && open_q && byte_o == FLAG && was_q)

endmodule

`default_nettype wire
