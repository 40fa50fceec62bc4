// SPDX-License-Identifier: Apache-2.0
// ppmc312_stage_seq_fv: counts the pulses of a motion, and follows an arbitrary stage of the table. All other
// words of the table may have any value in every cycle.
`include "ppmc_fv.svh"
`include "common/ppmc_lemma.svh"
`default_nettype none

module ppmc312_stage_seq_fv
  import ppmc312_stage_pkg::*;
(
    input wire logic            clk_i,
    input wire logic            power_i,
    input wire logic     [ 6:0] first_acc_i,
    input wire logic     [ 6:0] first_dec_i,
    input wire logic     [15:0] rate_dec_i,
    input wire stage_t          any_i,
    input wire logic     [ 6:0] number_i,       // the arbitrary stage
    input wire stage_t          word_i,         // its rate, and its acceleration pulses
    input wire logic     [23:0] dec_i,          // its deceleration pulses
    input wire logic            load_i,
    input wire profile_t        profile_i,
    input wire logic            single_i,
    input wire logic            change_i,
    input wire logic            change_ramp_i,
    input wire logic            slow_i,
    input wire logic            step_i
);

  table_addr_t table_addr_o, addr1_q, addr2_q;
  logic next_end_o, next_low_o, next_count_o, next_slow_o, next_final_decel_o;
  logic [15:0] next_rate_o, rate_o;
  logic const_rate_o, final_decel_o, first_o, complete_o;
  stage_t stage_i;

  `FV_RESET
  `FV_ANY_START(power_i)

  ppmc312_stage_seq dut (
      .rst_ni(rst_dut_n),
      .*
  );

  // Table: latency 2 cycles.
  logic hit;  // stage_i is the arbitrary stage
  assign hit = addr2_q.stage == number_i;
  assign stage_i = hit ? '{rate: word_i.rate, pulses: addr2_q.side ? dec_i : word_i.pulses} : any_i;
  always_ff @(posedge clk_i) {addr2_q, addr1_q} <= {addr1_q, table_addr_o};
  // verilog_format: off
  `FV_ASSUME(
      table_stands,
      {first_acc_i, first_dec_i, rate_dec_i} == $past({first_acc_i, first_dec_i, rate_dec_i}))
  // verilog_format: on
  `FV_ASSUME(one_stage, {number_i, word_i, dec_i} == $past({number_i, word_i, dec_i}))

  // A boundary follows the previous one by at least 4 cycles, pulse 1 follows the start by more.
  logic moving_q, endless_q, boundary;
  logic slow1_q, slow2_q;
  logic [ 2:0] age_q;  // cycles since the boundary or the start, at most 7
  logic [31:0] left_q;  // remaining pulses
  `FV_ASSUME(boundaries, !step_i || (moving_q && !load_i && age_q >= (first_o ? 3'd7 : 3'd3)))
  `FV_ASSUME(no_pulse_after_the_end, !(step_i && next_end_o))
  `FV_ASSUME(one_pulse_at_least, !load_i || profile_i.endless || profile_i.count != '0)

  always_ff @(posedge clk_i or negedge rst_dut_n)
    if (!rst_dut_n) {moving_q, age_q} <= '0;
    else begin
      if (load_i) moving_q <= 1'b1;
      if (load_i || step_i) age_q <= '0;
      else if (age_q != '1) age_q <= age_q + 3'd1;
    end

  always_ff @(posedge clk_i) begin
    {slow2_q, slow1_q} <= {slow1_q, slow_i};
    if (load_i) {endless_q, left_q} <= {profile_i.endless, profile_i.count};
    else if (step_i) left_q <= left_q - 32'd1;
  end

  assign boundary = moving_q && age_q >= (first_o ? 3'd7 : 3'd3);  // a pulse may begin

  // ---- number of pulses, requests -----------------------------------------------------------------------

  logic final_q;  // the deceleration to the end has begun, and no rate change (88) has cancelled it
  logic search1_q, search2_q;
  always_ff @(posedge clk_i or negedge rst_dut_n)
    if (!rst_dut_n) final_q <= 1'b0;
    else if (load_i) final_q <= 1'b0;
    else if (step_i) final_q <= next_final_decel_o || (final_q && !dut.action_q2.change_used);

  always_ff @(posedge clk_i) {search2_q, search1_q} <= {search1_q, dut.searching_q};

  `FV_LEMMA(p312_mot_07_left, !moving_q || (complete_o == (!endless_q && left_q == '0)))
  `FV_LEMMA(p312_mot_07_ends, !boundary || (next_count_o == complete_o && (!complete_o || next_end_o)))
  // verilog_format: off
  `FV_LEMMA(
      p312_mot_30_slow,
      !boundary || !slow2_q || search2_q || next_end_o || dut.next_q2.final_decel || dut.mode_q.last
          || dut.mode_q.final_decel)
  // verilog_format: on
  `FV_LEMMA(p312_mot_30_low, !boundary || !next_low_o || slow2_q)
  `FV_LEMMA(p312_mot_30_stays, !moving_q || !final_q || final_decel_o)

  // ---- stages ---------------------------------------------------------------------------------------------

  logic table_rate;  // the rate of this interval is that of a stage
  logic here_q;  // the arbitrary stage was entered with all its pulses
  logic [23:0] n_q, pulses;  // pulses of this stage that have begun, and that it has
  logic [1:0] goes_on;  // decision 1 and 2 cycles ago: the next stage of the same ramp begins
  logic [1:0][6:0] to_stage;
  logic [6:0] adjacent;
  assign table_rate = moving_q && !first_o && !dut.mode_q.const_rate;
  assign pulses     = dut.mode_q.down ? dec_i : word_i.pulses;
  assign goes_on    = {dut.action_q2.enter, dut.action_q.enter} & ~dut.low_end_q & ~dut.ramp_end_q;
  assign to_stage   = {addr2_q.stage, addr1_q.stage};
  assign adjacent   = dut.stage_q + {{6{dut.mode_q.down}}, 1'b1};

  always_ff @(posedge clk_i or negedge rst_dut_n)
    if (!rst_dut_n) here_q <= 1'b0;
    else if (load_i) here_q <= 1'b0;
    else if (step_i)
      here_q <= dut.action_q2.enter ? hit && !dut.action_q2.is_partial :
          here_q && dut.next_q2.down == dut.mode_q.down;
  always_ff @(posedge clk_i) if (step_i) n_q <= dut.action_q2.enter ? 24'd1 : n_q + 24'd1;

  `FV_LEMMA(p312_mot_20_rate, !table_rate || dut.stage_q != number_i || rate_o == word_i.rate)
  `FV_LEMMA(p312_mot_20_pulses, !(table_rate && here_q) || dut.more_q == pulses - n_q)
  // verilog_format: off
  `FV_LEMMA(
      p312_mot_20_next,
      !(boundary && table_rate && goes_on[1] && !next_end_o) || (to_stage[1] == adjacent
          && dut.next_q2.down == dut.mode_q.down && (!here_q || n_q == pulses)))
  // verilog_format: on

  // ---- lemmas ---------------------------------------------------------------------------------------------

  `FV_LEMMA(lemma_first, !first_o || (moving_q && !here_q))
  `FV_LEMMA(lemma_left, !moving_q || (dut.endless_q == endless_q && dut.left_q == left_q))
  `FV_LEMMA(lemma_address, dut.addr_q == to_stage)
  `FV_LEMMA(lemma_side, addr1_q.side == dut.next_q.down && addr2_q.side == dut.next_q2.down)
  // verilog_format: off
  `FV_LEMMA(
      lemma_from_table,
      !moving_q || ((age_q < 3'd2 || dut.next_q.const_rate || (dut.action_q.from_table && (table_rate
          || first_o || dut.action_q.enter))) && (age_q < 3'd3 || dut.next_q2.const_rate
          || (dut.action_q2.from_table && (table_rate || first_o || dut.action_q2.enter)))))
  `FV_LEMMA(
      lemma_final,
      !moving_q || (!(dut.mode_q.final_decel && dut.mode_q.const_rate) && (age_q < 3'd2
          || (!(dut.next_q.final_decel && dut.next_q.const_rate) && (!dut.action_q.final_decel
          || dut.next_q.final_decel))) && (age_q < 3'd3 || (!(dut.next_q2.final_decel
          && dut.next_q2.const_rate) && (!dut.action_q2.final_decel || dut.next_q2.final_decel)))))
  `FV_LEMMA(
      lemma_compared,
      !moving_q || age_q == '0 || (dut.zero_q == complete_o && dut.stage_done_q == (dut.more_q == '0)
          && (!table_rate || dut.adjacent_q == adjacent)))
  `FV_LEMMA(
      lemma_decision,
      !moving_q || age_q < 3'd2 || (dut.action_q.count == complete_o && (!dut.action_q.count
          || dut.action_q.ends) && (!dut.action_q.low || slow1_q) && (!slow1_q || search1_q
          || dut.action_q.ends || dut.next_q.final_decel || dut.mode_q.last || dut.mode_q.final_decel)
          && (!final_q || dut.next_q.final_decel || dut.action_q.change_used) && (!(table_rate && goes_on[0]
          && !dut.action_q.ends) || (to_stage[0] == adjacent && dut.next_q.down == dut.mode_q.down
          && dut.more_q == '0))))
  `FV_LEMMA(
      lemma_decided,
      !moving_q || age_q < 3'd3 || (dut.action_q2.count == complete_o && (!dut.action_q2.count
          || dut.action_q2.ends) && (!dut.action_q2.low || slow2_q) && (!slow2_q || search2_q
          || dut.action_q2.ends || dut.next_q2.final_decel || dut.mode_q.last || dut.mode_q.final_decel)
          && (!final_q || dut.next_q2.final_decel || dut.action_q2.change_used) && (!(table_rate && goes_on[1]
          && !dut.action_q2.ends) || (to_stage[1] == adjacent && dut.next_q2.down == dut.mode_q.down
          && dut.more_q == '0))))
  // verilog_format: on

  logic reset_q = 1'b0;  // a cover begins with a reset
  always_ff @(posedge clk_i) reset_q <= reset_q || !rst_dut_n;
  `FV_COVER(seen_stage, reset_q && table_rate && here_q && n_q == 24'd2 && left_q == 32'd7)
  `FV_COVER(seen_decel, reset_q && final_decel_o && next_end_o && !next_count_o && boundary)

endmodule

`default_nettype wire
