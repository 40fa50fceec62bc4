// SPDX-License-Identifier: Apache-2.0
// ppmc_bank_engine_fv: the engine with ppmc_bank_scheduler and eight axes, for any bytes, switches and cells.
// Proves that a visit reads the state that the previous visit of the same axis has written, that it issues at
// most one order, that an axis which is stopped or has no motion gets no pulse, and that a byte is accepted
// once.
`include "ppmc_fv.svh"
`default_nettype none

module ppmc_bank_engine_fv
  import ppmc_bank_pkg::*;
(
    input wire logic            clk_i,
    input wire logic            go_i,
    input wire logic            stop_i,
    input wire mail_t           mail_i,
    input wire progress_t       progress_i,
    input wire logic      [1:0] config_ni,
    input wire seen_t           seen_i,
    input wire logic      [2:0] watched_i    // any axis
);

  localparam int unsigned TimeBits = 14;

  logic [5:0][2:0] axis;
  logic [7:0] turn;
  logic [6:0] clear;
  logic go, stopping, answer_we_o, call_o, calm_o;
  logic [TimeBits-1:0] due;
  status_t status_o;
  logic [31:0] position_o;
  answer_t answer_o;
  order_t order_o;
  logic [2:0] at_o;

  `FV_RESET

  ppmc_bank_scheduler #(
      .RoundBits(3),
      .Width    (20),
      .TimeBits (TimeBits)
  ) u_round (
      .axis_o (axis),
      .turn_o (turn),
      .clear_o(clear),
      .go_o   (go),
      .due_o  (due),
      .stop_o (stopping),
      .*
  );

  ppmc_bank_engine #(
      .Quantum  (1),
      .TimeBits (TimeBits),
      .RoundBits(3)
  ) dut (
      .axis_i (axis),
      .clear_i(clear[4:3]),
      .go_i   (go),
      .due_i  (due),
      .*
  );

  `FV_ASSUME(one_axis, watched_i == $past(watched_i))

  // ---- visits --------------------------------------------------------------------------------------

  logic [4:0] clk_q;  // cycles since reset, at most 31
  logic [2:0] rest_q;  // cycles since the end of the last visit of the watched axis
  logic known_q;  // the watched axis has been visited
  logic ends;  // a visit of the watched axis is in its last stage
  logic clears;  // this visit resets the axis

  assign ends = axis[5] == watched_i && clk_q > 5'd4;

  always_ff @(posedge clk_i)
    if (!rst_ni) {clk_q, rest_q, known_q, clears} <= '0;
    else begin
      clk_q   <= (clk_q == '1) ? '1 : clk_q + 1'b1;
      rest_q  <= ends ? '0 : rest_q + 1'b1;
      known_q <= known_q || ends;
      clears  <= clear[4];
    end

  `FV_ASSERT(bank_gen_01_once_a_round, !known_q || ends == (rest_q == 3'd7))

  // ---- state kept from visit to visit --------------------------------------------------------------

  localparam int unsigned HoldBits = 15;

  logic [TimeBits+$bits(walk_t)+$bits(setting_t)+$bits(command_t)-1:0] early_q;
  logic [$bits(rest_t)+HoldBits+32-1:0] late_q;
  pace_t pace_q;
  words_t words_q;
  ramp_t ramp_q;
  units_t units_q;
  status_t status_q;
  logic [31:0] position_q;
  logic worded_q, ramped_q, chopped_q;  // the host has set words_q; ramp_q; units_q

  always_ff @(posedge clk_i)
    if (!rst_ni) {worded_q, ramped_q, chopped_q} <= '0;
    else begin
      if (ends) {early_q, late_q, pace_q} <= {dut.early5_q, dut.late5_q, dut.pace5_q};
      if (ends) {status_q, position_q} <= {status_o, position_o};
      if (axis[4] == watched_i && known_q) begin
        if (dut.take4_q) {worded_q, words_q} <= {1'b1, dut.code4_q, dut.params4_q[31:8]};
        if (dut.plan4_q.init)
          {ramped_q, ramp_q} <= {
            1'b1, dut.init.chop, dut.params4_q[7:0], dut.params4_q[15:8], dut.params4_q[29:16]
          };
        if (dut.plan4_q.switching) {chopped_q, units_q} <= {1'b1, dut.params4_q[31:16]};
      end
    end

  // For the induction: the words are the same in the stages before those that use them.
  for (genvar i = 1; i < 6; i++) begin : g_stage
    `FV_ASSERT(lemma_axis, clk_q < 5'(i) || axis[i] == axis[0] - 3'(i))
    `FV_ASSERT(lemma_clear, clear[i] == (clk_q < 5'(8 + i)))
  end
  `FV_ASSERT(lemma_clear_first, clear[0] == (clk_q < 5'd8))
  `FV_ASSERT(lemma_rest, !known_q || axis[5] == watched_i + 3'd1 + rest_q)
  `FV_ASSERT(lemma_known, known_q ? clk_q > 5'd5 : !(worded_q || ramped_q || chopped_q))
  `FV_ASSERT(lemma_axis_first, clk_q == '1 || axis[0] == clk_q[2:0])
  `FV_ASSERT(lemma_early1, !(known_q && axis[1] == watched_i) || dut.early1_q == early_q)
  `FV_ASSERT(lemma_pace_r, !(known_q && axis[0] + 3'd1 == watched_i) || dut.pace_r_q == pace_q)
  `FV_ASSERT(lemma_pace0, !(known_q && axis[0] == watched_i) || dut.pace0_q == pace_q)
  `FV_ASSERT(lemma_pace1, !(known_q && axis[1] == watched_i) || dut.pace1_q == pace_q)
  logic lemma_words1_holds;
  assign lemma_words1_holds =
      axis[1] != watched_i || clk_q < 5'd6 || ((!worded_q || dut.words1_q == words_q) && (!ramped_q ||
      dut.ramp1_q == ramp_q));
  `FV_ASSERT(lemma_words1, lemma_words1_holds)
  logic lemma_words2_holds;
  assign lemma_words2_holds =
      axis[2] != watched_i || clk_q < 5'd6 || ((!worded_q || dut.words2_q == words_q) && (!ramped_q ||
      dut.ramp2_q == ramp_q));
  `FV_ASSERT(lemma_words2, lemma_words2_holds)

  `FV_ASSERT(bank_gen_05_motion_stays, !(known_q && axis[2] == watched_i) || dut.early2_q == early_q)
  `FV_ASSERT(bank_gen_05_position_stays, !(known_q && axis[2] == watched_i) || dut.late2_q == late_q)
  `FV_ASSERT(bank_gen_05_pace_stays, !(known_q && axis[2] == watched_i) || dut.pace2_q == pace_q)
  `FV_ASSERT(bank_gen_05_words_stay, !(worded_q && axis[3] == watched_i) || dut.words3_q == words_q)
  `FV_ASSERT(bank_gen_05_ramp_stays, !(ramped_q && axis[3] == watched_i) || dut.ramp3_q == ramp_q)
  `FV_ASSERT(bank_gen_05_units_stay, !(chopped_q && axis[3] == watched_i) || dut.units3_q == units_q)

  // ---- effects of a visit ----------------------------------------------------------------------------

  logic same;  // visit of the watched axis that follows another one
  assign same = known_q && ends && !clears;

  `FV_ASSERT(one_order, 2'(order_o.pulse) + 2'(order_o.rise) + 2'(order_o.sets) <= 2'd1 || clk_q < 5'd8)
  `FV_ASSERT(bank_mot_02_none_when_stopped, !order_o.pulse || clk_q < 5'd8 || $past(seen_i.armed, 3))
  `FV_ASSERT(no_pulse_without_a_motion,
             !same || !(order_o.pulse || order_o.rise) || (status_q.busy && status_o.busy))
  `FV_ASSERT(bank_mot_03_position_by_one, !same || position_o - position_q inside {32'd0, 32'd1, '1})
  `FV_ASSERT(bank_hsk_01_taken_as_written,
             !same || status_o.taken == status_q.taken || status_o.taken == $past(mail_i.seq, 4))
  `FV_ASSERT(bank_hsk_01_motion_by_a_byte,
             !(same && status_o.busy && !status_q.busy) || status_o.taken != status_q.taken)
  `FV_ASSERT(bank_hsk_04_answer_by_a_byte, !(same && answer_we_o) || status_o.taken != status_q.taken)
  `FV_ASSERT(p104_end_07_interrupt_at_an_end, !(same && call_o) || (status_q.busy && !status_o.busy))
  `FV_ASSERT(bank_gen_05_reset,
             !(clears && clk_q > 5'd8) || (status_o == '0 && order_o == '0 && position_o == '0))

  // Words in the memories.
  logic [$bits(early_q)-1:0] early_word;
  logic [$bits(late_q)-1:0] late_word;
  pace_t pace_word;
  words_t words_word;
  ramp_t ramp_word;
  units_t units_word;
  assign early_word = dut.earlies[watched_i];
  assign late_word  = dut.lates[watched_i];
  assign pace_word  = dut.paces[watched_i];
  assign words_word = dut.words[watched_i];
  assign ramp_word  = dut.ramps[watched_i];
  assign units_word = dut.chops[watched_i];

  `FV_ASSERT(lemma_words, !known_q || {early_word, late_word, pace_word} == {early_q, late_q, pace_q})
  logic lemma_set_holds;
  assign lemma_set_holds =
      (!worded_q || words_word == words_q) && (!ramped_q || ramp_word == ramp_q) && (!chopped_q ||
      units_word == units_q);
  `FV_ASSERT(lemma_set, lemma_set_holds)

  // For the induction: the stages of the watched axis, and what the outputs of its last visit imply.
  localparam int unsigned BusyAt = $bits(command_t) + $bits(setting_t) + $bits(walk_t) - 1;
  `FV_ASSERT(lemma_visit3,
             !(known_q && axis[3] == watched_i) || {dut.early3_q, dut.late3_q} == {early_q, late_q})
  `FV_ASSERT(lemma_visit4,
             !(known_q && axis[4] == watched_i) || {dut.early4_q, dut.late4_q} == {early_q, late_q})
  `FV_ASSERT(lemma_visit_last,
             !known_q || (status_q == {early_q[5:0], early_q[BusyAt]} && position_q == late_q[31:0]))
  `FV_ASSERT(lemma_visit_armed,
             !dut.plan4_q.pulse || clk_q < 5'd8 || (dut.seen4_q.armed && dut.early4_q.walk.busy))

  // Assumptions of the visits, for every axis in every stage.
  for (genvar n = 0; n < 8; n++) begin : g_axis
    logic [$bits(early_q)-1:0] word;
    walk_t walk;
    setting_t setting;
    command_t command;
    assign word = dut.earlies[n];
    assign {walk, setting, command} = word[0+:$bits(walk_t)+$bits(setting_t)+$bits(command_t)];
    `FV_ASSERT(lemma_kept0, clk_q < 5'd3 || rests(walk, setting, command))
  end
  `FV_ASSERT(lemma_kept1, clk_q < 5'd5 || rests(dut.early1_q.walk, dut.early1_q.setting, dut.early1_q.command
             ))
  `FV_ASSERT(lemma_kept2, clk_q < 5'd6 || rests(dut.early2_q.walk, dut.early2_q.setting, dut.early2_q.command
             ))
  `FV_ASSERT(lemma_kept3, clk_q < 5'd7 || rests(dut.early3_q.walk, dut.early3_q.setting, dut.early3_q.command
             ))
  `FV_ASSERT(lemma_kept4, clk_q < 5'd8 || rests(dut.early4_q.walk, dut.early4_q.setting, dut.early4_q.command
             ))
  `FV_ASSERT(lemma_kept5, clk_q < 5'd2 || rests(dut.early5_q.walk, dut.early5_q.setting, dut.early5_q.command
             ))

  function automatic logic rests(walk_t walk, setting_t setting, command_t command);
    return walk.busy ? !setting.building && (command.error || command.number == '0) : !(walk.run || walk.low);
  endfunction

  `FV_COVER(seen_words, worded_q && ramped_q && chopped_q && known_q && axis[3] == watched_i)
  `FV_COVER(seen_answer, same && answer_we_o && status_o.taken != status_q.taken)
  `FV_COVER(seen_motion, same && status_o.busy && !status_q.busy)

endmodule

`default_nettype wire
