// SPDX-License-Identifier: Apache-2.0
// ppmc_bank_scheduler_fv: proves that each axis is visited once per round, in all stages, that a RAM word is
// never read while it is written, that GO lasts exactly one round and no GO is missed, and that every axis is
// reset once.
`include "ppmc_fv.svh"
`default_nettype none

module ppmc_bank_scheduler_fv (
    input wire logic       clk_i,
    input wire logic       go_i,
    input wire logic       stop_i,
    input wire logic [2:0] watched_i  // any axis
);

  logic [5:0][2:0] axis_o;
  logic [7:0] turn_o;
  logic [6:0] clear_o;
  logic go_o, stop_o;
  logic [5:0] due_o;

  `FV_RESET

  ppmc_bank_scheduler #(
      .RoundBits(3),
      .Width    (40),
      .TimeBits (6)
  ) dut (
      .*
  );

  `FV_ASSUME(one_axis, watched_i == $past(watched_i))

  logic [4:0] clk_q;  // cycles since reset, at most 31
  logic [2:0] visits_q;  // of the watched axis since GO began, at most 7
  logic [3:0] stop_q;  // cycles since STOP, at most 15
  logic wanted_q;  // GO was written and its round has not begun yet

  always_ff @(posedge clk_i)
    if (!rst_ni) {clk_q, visits_q, stop_q, wanted_q} <= {8'd0, 4'd15, 1'b0};
    else begin
      clk_q <= (clk_q == '1) ? '1 : clk_q + 1'b1;
      visits_q <= (!go_o || due_o == 6'd32) ? '0 : visits_q + 3'(axis_o[2] == watched_i && clk_q >= 5'd6);
      stop_q <= stop_i ? '0 : (stop_q == '1) ? '1 : stop_q + 1'b1;
      wanted_q <= go_i || (wanted_q && !(go_o && due_o == 6'd39));
    end

  `FV_ASSERT(bank_gen_01_one_behind_the_other, !$past(rst_ni) || axis_o[0] == $past(axis_o[0]) + 1'b1)
  for (genvar i = 1; i <= 5; i++) begin : g_stage
    `FV_ASSERT(lemma_stages, clk_q < 5'd6 || axis_o[i] == axis_o[0] - 3'(i))
  end
  `FV_ASSERT(
      no_word_read_and_written,
      clk_q < 5'd6 || (axis_o[0] != axis_o[5] && axis_o[1] != axis_o[5] && axis_o[0] + 3'd2 != axis_o[5]))
  `FV_ASSERT(turn_is_the_last_stage, clk_q < 5'd6 || turn_o == 8'd1 << axis_o[5])
  `FV_ASSERT(bank_gen_05_reset_once, clk_q < 5'd8 || !clear_o[0])
  `FV_ASSERT(bank_grp_02_once_each_axis, visits_q <= 3'd1)
  `FV_ASSERT(bank_grp_02_go_within_a_round, !wanted_q || go_o)
  `FV_ASSERT(bank_grp_02_due, !go_o || (due_o <= 6'd39 && due_o >= 6'd32))
  `FV_ASSERT(bank_grp_04_stop_lasts, stop_o == (stop_q <= 4'd8))
  `FV_COVER(seen_two_go, go_o && due_o == 6'd39 && $past(go_o) && clk_q == 5'd20)
  `FV_COVER(seen_stop, stop_q == 4'd8)

endmodule

`default_nettype wire
