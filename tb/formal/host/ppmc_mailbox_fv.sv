// SPDX-License-Identifier: Apache-2.0
// ppmc_mailbox_fv: proves that each byte from the host is accepted once and unchanged, and that answers are
// read completely and in order, without reading a byte twice.
`include "ppmc_fv.svh"
`default_nettype none

module ppmc_mailbox_fv (
    input wire logic        clk_i,
    input wire logic        wr_i,
    input wire logic        wr_a0_i,
    input wire logic [ 7:0] wr_data_i,
    input wire logic        rd_done_i,
    input wire logic        take_i,
    input wire logic        load_i,
    input wire logic [23:0] answer_i,
    input wire logic        long_i
);

  logic [7:0] out_o, byte_o;
  logic obf_o, new_o, ibf_o, ready_o, command_o;

  `FV_RESET

  ppmc_mailbox dut (.*);

  `FV_ASSUME(take_when_ready, !take_i || ready_o)
  `FV_ASSUME(read_what_is_there, !rd_done_i || obf_o)

  // Input: the mailbox stores one byte.
  logic full_q;
  logic [8:0] held_q;

  always_ff @(posedge clk_i)
    if (!rst_ni) {full_q, held_q} <= '0;
    else if (wr_i) {full_q, held_q} <= {1'b1, wr_a0_i, wr_data_i};
    else if (take_i) full_q <= 1'b0;

  `FV_ASSERT(p104_hsk_01_full_until_taken, ibf_o == full_q)
  `FV_ASSERT(p104_hsk_02_as_written, !full_q || {command_o, byte_o} == held_q)
  `FV_ASSERT(p104_hsk_01_ready_in_time, !ready_o || ibf_o)
  `FV_ASSERT(p104_hsk_01_ready_soon, !(full_q && $past(rst_ni && full_q && !wr_i && !take_i)) || ready_o)

  // Output: bytes of the last answer, and the number of bytes that have been read.
  logic [23:0] answer_q;
  logic [1:0] bytes_q, read_q;  // bytes_q: bytes of the answer; read_q: bytes that have been read
  logic gap_q;  // 1: first cycle after a read

  always_ff @(posedge clk_i)
    if (!rst_ni) {answer_q, bytes_q, read_q, gap_q} <= '0;
    else begin
      gap_q <= rd_done_i && !load_i;
      if (load_i) {answer_q, bytes_q, read_q} <= {answer_i, long_i ? 2'd3 : 2'd1, 2'd0};
      else if (rd_done_i) read_q <= read_q + 1'b1;
    end

  `FV_ASSERT(p104_hsk_05_valid_until_all_are_read, obf_o == (read_q < bytes_q && !gap_q))
  `FV_ASSERT(p104_hsk_06_in_order, !obf_o || out_o == 8'(answer_q >> {read_q, 3'd0}))
  `FV_ASSERT(p104_hsk_08_never_more_than_there_are, read_q <= bytes_q)
  logic [1:0] behind;  // number of bytes after the current byte
  assign behind = bytes_q - read_q - 2'(obf_o);
  `FV_ASSERT(lemma_behind, dut.more_valid_q == {behind >= 2'd2, behind != 2'd0})
  `FV_ASSERT(new_is_told, !$past(rst_ni && !new_o) || out_o == $past(out_o))
  `FV_COVER(seen_third_byte, bytes_q == 2'd3 && read_q == 2'd3)
  `FV_COVER(seen_taken_while_written, take_i && wr_i && full_q)

endmodule

`default_nettype wire
