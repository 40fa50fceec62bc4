// SPDX-License-Identifier: Apache-2.0
// ppmc_bridge_answer_fv: proves that blocks end, that COUNT is one consistent value even if the counter
// changes while it is read, and that no byte is written past the end of the buffer.
`include "ppmc_fv.svh"
`default_nettype none

module ppmc_bridge_answer_fv (
    input wire logic       clk_i,
    input wire logic       clear_i,
    input wire logic       put_i,
    input wire logic [7:0] data_i,
    input wire logic       ident_i,
    input wire logic       count_i,
    input wire logic       pulse_i,
    input wire logic       down_i
);

  logic busy_o, full_o, full4_o, full16_o, we_o;
  logic [8:0] length_o;
  logic [7:0] waddr_o, wdata_o;
  logic [31:0] counter_i;

  `FV_RESET

  ppmc_bridge_answer dut (
      .second_i(1'b0),
      .block_i (ppmc_bridge_pkg::BlockIdent),
      .info_i  ('0),
      .*
  );

  // The counter is near a carry through all its bytes. Pulses are 8 cycles apart. With shorter gaps, COUNT
  // would still be consistent, but the block might not end.
  logic [3:0] low_q;
  logic high_q;
  logic [2:0] gap_q;
  assign counter_i = {{28{high_q}}, low_q};

  always_ff @(posedge clk_i)
    if (!rst_ni) {high_q, low_q, gap_q} <= '0;
    else if (pulse_i) begin
      gap_q           <= '0;
      {high_q, low_q} <= down_i ? {high_q, low_q} - 1'b1 : {high_q, low_q} + 1'b1;
    end else gap_q <= (gap_q == '1) ? '1 : gap_q + 1'b1;

  `FV_ASSUME(pulses_apart, !pulse_i || gap_q == '1)

  logic [1:0] settled_q;  // cycles since the last byte, saturates at 2
  always_ff @(posedge clk_i)
    settled_q <= (!rst_ni || we_o || clear_i) ? '0 : (settled_q == 2'd2) ? 2'd2 : settled_q + 1'b1;

  logic begun_q;  // 1: an answer has begun

  `FV_ASSUME(in_order, !(put_i && (ident_i || count_i)) && !(ident_i && count_i))
  `FV_ASSUME(room, (settled_q == 2'd2 && !busy_o) || !(put_i || ident_i || count_i))
  `FV_ASSUME(looks_first, !(put_i && full_o) && !(count_i && full4_o) && !(ident_i && full16_o))
  `FV_ASSUME(clear_at_rest, !(clear_i && (busy_o || put_i || ident_i || count_i)))
  `FV_ASSUME(cleared_first, begun_q || !(put_i || ident_i || count_i))

  logic [4:0] age_q;  // cycles since the beginning of the current block
  logic [8:0] before_q;  // length at the beginning of the current block
  logic counting_q;
  logic [31:0] read_q;  // bytes of the current block that have been written

  always_ff @(posedge clk_i)
    if (!rst_ni) {begun_q, age_q, before_q, counting_q, read_q} <= '0;
    else begin
      if (clear_i) begun_q <= 1'b1;
      age_q <= busy_o ? age_q + 1'b1 : '0;
      if (ident_i || count_i) {before_q, counting_q} <= {length_o, count_i};
      if (we_o && busy_o) read_q[8*2'(waddr_o-before_q[7:0])+:8] <= wdata_o;
    end

  // Lemmas for the induction: the position in the block, the bytes of the counter that match the current
  // value, and the meaning of the flags.
  logic [4:0] left;
  logic same;
  assign left = 5'(dut.left_q);
  assign same = counter_i[0] == dut.parity_q;

  `FV_ASSERT(lemma_begun, !busy_o || begun_q)
  logic lemma_flags_holds;
  assign lemma_flags_holds =
      !(begun_q && settled_q != '0) || (full_o == length_o[8] && full4_o == (length_o > 9'd252) &&
      full16_o == (length_o > 9'd240));
  `FV_ASSERT(lemma_flags, lemma_flags_holds)
  `FV_ASSERT(lemma_kind, !busy_o || dut.counting_q == counting_q)
  `FV_ASSERT(lemma_room, !busy_o || before_q <= (counting_q ? 9'd252 : 9'd240))
  `FV_ASSERT(lemma_block,
             !(busy_o && !counting_q) || (length_o == before_q + 9'd15 - 9'(left) && age_q == 5'd15 - left))
  `FV_ASSERT(lemma_count, !(busy_o && counting_q) || (length_o == before_q + 9'd3 - 9'(left) && left <= 5'd3))
  logic lemma_passes_holds;
  assign lemma_passes_holds =
      !(busy_o && counting_q) || age_q == 5'd3 - left || (age_q == 5'd7 - left && 5'(gap_q) < age_q &&
      5'(gap_q) + 5'd3 >= age_q);
  `FV_ASSERT(lemma_passes, lemma_passes_holds)
  `FV_ASSERT(lemma_moved, !(busy_o && counting_q && left < 5'd3 && !same) || 5'(gap_q) + left <= 5'd2)
  for (genvar n = 0; n < 3; n++) begin : g_byte
    `FV_ASSERT(lemma_bytes,
               !(busy_o && counting_q && left < 5'(3 - n) && same) || read_q[8*n+:8] == counter_i[8*n+:8])
  end

  `FV_ASSERT(block_ends, age_q <= 5'd20)
  `FV_ASSERT(block_has_its_length, !(begun_q && $past(busy_o)
             && !busy_o) || length_o == before_q + (counting_q ? 9'd4 : 9'd16))
  `FV_ASSERT(ub_ans_02_never_past_the_end, !begun_q || length_o <= 9'd256)
  `FV_ASSERT(count_is_one_number, !(begun_q && $past(busy_o) && !busy_o && counting_q) || read_q == $past
             (counter_i) || read_q == $past(counter_i, 2) || read_q == $past(counter_i, 3) || read_q == $past
             (counter_i, 4))
  `FV_COVER(seen_count, begun_q && $past(busy_o) && !busy_o && counting_q && read_q == '1)

endmodule

`default_nettype wire
