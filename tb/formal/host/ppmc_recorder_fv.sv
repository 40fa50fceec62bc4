// SPDX-License-Identifier: Apache-2.0
// ppmc_recorder_fv: proves that a running recorder writes one record at the beginning, at the end, for each
// change of the levels, and whenever the time reaches its maximum without a change. It writes no other
// records. The recording ends when the memory is full, and no record is written past the end.
`include "ppmc_fv.svh"
`default_nettype none

module ppmc_recorder_fv (
    input wire logic       clk_i,
    input wire logic [1:0] watch_i,
    input wire logic       begin_i,
    input wire logic       end_i,
    input wire logic       rewind_i,
    input wire logic       next_i
);

  logic [ 7:0] data_o;
  logic [63:0] info_o;

  `FV_RESET

  ppmc_recorder #(
      .Width   (2),
      .AddrBits(4)
  ) dut (
      .*
  );

  logic running, full;
  logic [4:0] count;
  assign {count, full, running} = {info_o[36:32], info_o[25:24]};

  `FV_ASSUME(one_order, 2'(begin_i) + 2'(end_i) + 2'(rewind_i) <= 2'd1)

  logic [1:0] now_q, before_q;  // levels one and two cycles ago
  logic first_q;  // 1: first cycle of a recording
  logic [13:0] age_q;  // cycles since the last record
  logic wanted;

  assign wanted = running && (now_q != before_q || first_q || end_i || age_q == '1);

  always_ff @(posedge clk_i) begin
    {before_q, now_q} <= {now_q, watch_i};
    if (!rst_ni) {first_q, age_q} <= '0;
    else begin
      first_q <= begin_i;
      age_q   <= begin_i ? '0 : wanted && count != 5'd16 ? 14'd1 : age_q + 1'b1;
    end
  end

  logic seen_q;  // 1: the levels are known
  always_ff @(posedge clk_i) seen_q <= rst_ni && (seen_q || begin_i);

  // With these lemmas, an induction over two cycles succeeds.
  `FV_ASSERT(lemma_levels, !seen_q || (dut.levels_q == now_q && dut.changed_q[0] == (now_q != before_q)))
  `FV_ASSERT(lemma_time, !seen_q || (dut.time_q == age_q && dut.rest_q == (age_q == '1)))
  `FV_ASSERT(lemma_state, dut.first_q == first_q || !$past(rst_ni))
  `FV_ASSERT(lemma_begun, seen_q || !running)

  `FV_ASSERT(ub_rec_01_a_change_a_record, !($past(seen_q && wanted && !begin_i && count != 5'd16)
             ) || count == $past(count) + 1'b1)
  `FV_ASSERT(ub_rec_01_nothing_else, !($past(seen_q && !wanted && !begin_i)) || count == $past(count))
  `FV_ASSERT(ub_rec_04_full_ends, !(full && running) && count <= 5'd16)
  `FV_ASSERT(ub_rec_04_full_when_one_is_lost, !($past(seen_q && wanted && !begin_i && count == 5'd16)
             ) || full)
  `FV_ASSERT(ub_rec_03_zero_while_it_runs, !($past(running) && $past(rst_ni)) || data_o == '0)
  `FV_COVER(seen_full, full && count == 5'd16)

endmodule

`default_nettype wire
