// SPDX-License-Identifier: Apache-2.0
// ppmc_bank_scheduler_fv: proves that each axis is visited once per round in every stage, that no RAM word
// is read while it is written, that GO lasts exactly one round and is never missed, and that every
// axis is reset once.
`include "ppmc_fv.svh"
`default_nettype none

module ppmc_bank_scheduler_fv (
    input wire logic       clk_i,
    input wire logic       go_i,
    input wire logic       stop_i,
    input wire logic [2:0] watched_i  // any axis
);

  logic [5:0][2:0] axis_o;
  logic [7:0] last_stage_o;
  logic [6:0] clear_o;
  logic go_o, stop_o;
  logic [2:0] go_left_o;

  `FV_RESET

  ppmc_bank_scheduler #(.RoundBits(3)) dut (.*);

  `FV_ASSUME(one_axis, watched_i == $past(watched_i))

  logic [4:0] cycles_q;  // cycles since reset, saturates at 31
  logic [2:0] visits_q;  // visits of the watched axis since GO began, saturates at 7
  logic [3:0] stop_q;  // cycles since STOP, saturates at 15
  logic go_pending_q;  // 1: GO was written, and its round has not begun yet

  always_ff @(posedge clk_i)
    if (!rst_ni) {cycles_q, visits_q, stop_q, go_pending_q} <= {8'd0, 4'd15, 1'b0};
    else begin
      cycles_q <= (cycles_q == '1) ? '1 : cycles_q + 1'b1;
      visits_q <= (!go_o || go_left_o == '0) ? '0 : visits_q + 3'(axis_o[2] == watched_i && cycles_q >= 5'd6);
      stop_q <= stop_i ? '0 : (stop_q == '1) ? '1 : stop_q + 1'b1;
      go_pending_q <= go_i || (go_pending_q && !(go_o && go_left_o == '1));
    end

  `FV_ASSERT(bank_gen_01_axes_in_order, !$past(rst_ni) || axis_o[0] == $past(axis_o[0]) + 1'b1)
  for (genvar i = 1; i <= 5; i++) begin : g_stage
    `FV_ASSERT(lemma_stages, cycles_q < 5'd6 || axis_o[i] == axis_o[0] - 3'(i))
  end
  `FV_ASSERT(
      no_read_during_write,
      cycles_q < 5'd6 || (axis_o[0] != axis_o[5] && axis_o[1] != axis_o[5] && axis_o[0] + 3'd2 != axis_o[5]))
  `FV_ASSERT(last_stage_matches, cycles_q < 5'd6 || last_stage_o == 8'd1 << axis_o[5])
  `FV_ASSERT(bank_gen_05_reset_once, cycles_q < 5'd8 || !clear_o[0])
  `FV_ASSERT(bank_grp_02_once_per_axis, visits_q <= 3'd1)
  `FV_ASSERT(bank_grp_02_go_within_a_round, !go_pending_q || go_o)
  `FV_ASSERT(bank_grp_02_go_left, !go_o || go_left_o == '1 || ($past(go_o) && go_left_o == $past(go_left_o)
             - 1'b1))
  `FV_ASSERT(bank_grp_04_stop_lasts, stop_o == (stop_q <= 4'd8))
  `FV_COVER(seen_two_go, go_o && go_left_o == '1 && $past(go_o) && cycles_q == 5'd20)
  `FV_COVER(seen_stop, stop_q == 4'd8)

endmodule

`default_nettype wire
