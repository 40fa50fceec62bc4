// SPDX-License-Identifier: Apache-2.0
// ppmc312_stage_builder_fv: proves that a build writes each word of its table once and in order, and ends.
// The results of the arithmetic and the words of the RAM have any value; an operation lasts at most 3 cycles
// here.
`include "ppmc_fv.svh"
`include "common/ppmc_lemma.svh"
`default_nettype none

module ppmc312_stage_builder_fv
  import ppmc312_stage_pkg::*;
(
    input wire logic          clk_i,
    input wire logic          power_i,
    input wire logic          start_i,
    input wire curve_t        curve_i,
    input wire logic          op_busy_i,
    input wire logic   [39:0] hi_i,
    input wire logic   [23:0] lo_i
);

  logic busy_o, too_few_pulses_o, op_start_o, op_mul_o;
  table_write_t table_write_o;
  logic [1:0] begins_o;
  logic [6:0] first_acc_i, first_dec_i;
  logic [ 5:0] op_steps_o;
  logic [23:0] op_lo_o;
  logic [39:0] word_o;

  `FV_RESET
  `FV_ANY_START(power_i)

  ppmc312_stage_builder dut (
      .rst_ni(rst_dut_n),
      .*
  );

  // An operation is busy from the cycle after its start on.
  logic started_q;
  logic [1:0] op_age_q;
  always_ff @(posedge clk_i or negedge rst_dut_n)
    if (!rst_dut_n) {started_q, op_age_q} <= '0;
    else begin
      started_q <= op_start_o;
      op_age_q  <= (op_start_o || !op_busy_i) ? '0 : op_age_q + 2'd1;
    end
  `FV_ASSUME(operation_begins, !started_q || op_busy_i)
  `FV_ASSUME(operation_ends, op_age_q < 2'd3)
  `FV_ASSUME(busy_with_an_operation, !op_busy_i || started_q || $past(op_busy_i))
  `FV_ASSUME(starts_when_idle, !start_i || !busy_o)
  `FV_ASSUME(curve_stands, !busy_o || curve_i == $past(curve_i))

  // The table unit stores the stages at which the sides begin.
  always_ff @(posedge clk_i or negedge rst_dut_n)
    if (!rst_dut_n) {first_acc_i, first_dec_i} <= '0;
    else begin
      if (begins_o[0]) first_acc_i <= table_write_o.stage;
      if (begins_o[1]) first_dec_i <= table_write_o.stage;
    end

  // ---- words ------------------------------------------------------------------------------------------

  logic [7:0] rates_q;  // stages whose rates are written
  logic [1:0][7:0] next_q;  // next stage of each side; 0: none is written
  logic [1:0] we_side;
  logic [1:0][6:0] first;
  logic few_q, busy_q, built_q;  // built_q: a build has been started

  assign we_side = {table_write_o.we_dec, table_write_o.we_acc};
  assign first   = {first_dec_i, first_acc_i};

  always_ff @(posedge clk_i or negedge rst_dut_n)
    if (!rst_dut_n) busy_q <= 1'b0;
    else busy_q <= busy_o;

  always_ff @(posedge clk_i or negedge rst_dut_n)
    if (!rst_dut_n) {rates_q, next_q, few_q, built_q} <= '0;
    else if (start_i) {rates_q, next_q, few_q, built_q} <= 26'd1;
    else begin
      if (table_write_o.we_rate) rates_q <= rates_q + 8'd1;
      for (int unsigned n = 0; n < 2; n++) if (we_side[n]) next_q[n] <= 8'(table_write_o.stage) + 8'd1;
      if (we_side != '0 && table_write_o.data <= 24'd1) few_q <= 1'b1;
    end

  `FV_LEMMA(writes_one_word, $onehot0({table_write_o.we_rate, we_side}))
  `FV_LEMMA(writes_in_a_build, busy_o || {table_write_o.we_rate, we_side} == '0)
  `FV_LEMMA(rates_in_order, !table_write_o.we_rate || 8'(table_write_o.stage) == rates_q)
  for (genvar n = 0; n < 2; n++) begin : g_side
    // verilog_format: off
    `FV_LEMMA(
        pulses_in_order,
        !we_side[n] || 8'(table_write_o.stage) == (next_q[n] == '0 ? 8'(first[n]) : next_q[n]))
  // verilog_format: on
    `FV_LEMMA(pulses_after_rates, !we_side[n] || rates_q == 8'd127)
  end
  `FV_LEMMA(no_deceleration_side, !we_side[1] || curve_i.split)
  `FV_LEMMA(complete_rates, !(busy_q && !busy_o) || rates_q == 8'd127)
  `FV_LEMMA(complete_acc, !(busy_q && !busy_o) || next_q[0] == 8'd127)
  `FV_LEMMA(complete_dec, !(busy_q && !busy_o && $past(curve_i.split)) || next_q[1] == 8'd127)
  `FV_LEMMA(p312_tbl_05_few, !built_q || too_few_pulses_o == few_q)
  `FV_LEMMA(operand_idle, busy_o || !busy_q || !op_start_o)

  // ---- end --------------------------------------------------------------------------------------------

  // A build ends, because each state ends, and each change of the state increases its rank.
  logic [3:0] still, still_q;  // cycles since the state began
  logic [5:0] place_q, place;
  logic [13:0] rank, rank_q;
  logic [4:0] step;
  assign place = {dut.pass_q, dut.state_q, dut.side_q};
  // verilog_format: off
  assign step = (dut.state_q == 4'd13) ? 5'd16 : 5'(dut.state_q) + ((dut.pass_q && dut.side_q) ? 5'd3 : 5'd0);
  // verilog_format: on
  assign rank  = {dut.pass_q, (dut.state_q <= 4'd3) ? 7'd0 : dut.stage_q, step, dut.side_q && !dut.pass_q};
  assign still = (place == place_q) ? still_q + 4'd1 : '0;
  always_ff @(posedge clk_i) {still_q, place_q, rank_q} <= {still, place, rank};

  `FV_LEMMA(ends_each_state, !busy_o || still <= (dut.wait_q ? 4'd3 + 4'(op_age_q) : 4'(dut.phase_q)))
  `FV_LEMMA(ends_in_order, !(busy_q && busy_o) || rank > rank_q || place == place_q)

  // ---- lemmas -----------------------------------------------------------------------------------------

  // verilog_format: off
  `FV_LEMMA(
      lemma_rates,
      !busy_o || dut.pass_q || rates_q == ((dut.state_q <= 4'd3) ? 8'd0
          : 8'(dut.stage_q) + 8'(dut.state_q inside {4'd9, 4'd13} || (dut.state_q == 4'd8 && dut.side_q))))
  // verilog_format: on
  `FV_LEMMA(lemma_all_rates, !dut.pass_q || !busy_o || rates_q == 8'd127)

  logic [1:0] done_q;  // sides whose word of this stage is written
  always_ff @(posedge clk_i or negedge rst_dut_n)
    if (!rst_dut_n) done_q <= '0;
    else done_q <= (!busy_o || dut.state_q == 4'd13) ? '0 : done_q | we_side;
  for (genvar n = 0; n < 2; n++) begin : g_side_lemma
    logic [7:0] next;
    assign next = done_q[n] ? 8'(dut.stage_q) + 8'd1 : (dut.stage_q > first[n]) ? 8'(dut.stage_q) : '0;
    `FV_LEMMA(lemma_next, !busy_o || next_q[n] == ((dut.pass_q && (n == 0 || curve_i.split)) ? next : '0))
    // verilog_format: off
    `FV_LEMMA(
        lemma_open,
        !busy_o || !dut.pass_q || dut.state_q == 4'd4 && dut.stage_q == first[n]
            && {dut.phase_q, dut.wait_q} == '0 || dut.open_q[n] == (dut.stage_q >= first[n]))
    // verilog_format: on
    `FV_LEMMA(lemma_first, first[n] <= 7'd126)
  end
  // verilog_format: off
  `FV_LEMMA(
      lemma_done,
      !busy_o || !dut.pass_q || (dut.state_q == 4'd13
          ? done_q == {dut.open_q[1] && curve_i.split, dut.open_q[0]}
          : !done_q[1] && done_q[0] == (dut.side_q && dut.open_q[0])))
  `FV_LEMMA(
      lemma_pass,
      !busy_o || dut.stage_q <= 7'd126 && (dut.state_q == 4'd4 || dut.state_q == 4'd13
          || dut.pass_q == (dut.state_q inside {4'd10, 4'd11, 4'd12})) && (!dut.side_q || curve_i.split
          || dut.state_q == 4'd8))
  `FV_LEMMA(
      lemma_side,
      !dut.side_q || !busy_o || (dut.state_q inside {[4'd8 : 4'd12]} && (!dut.pass_q || dut.open_q[1])))
  // Phase 2 starts an operation, then wait_q is 1 until it ends.
  `FV_LEMMA(
      lemma_phase,
      (dut.works || !(dut.wait_q || op_start_o)) && (dut.works || dut.state_q == 4'd1 || dut.phase_q == '0)
          && op_start_o == (dut.works && dut.phase_q == 2'd2) && (!dut.wait_q || dut.phase_q == '0)
          && dut.phase_q != '1)
  // verilog_format: on
  `FV_LEMMA(lemma_busy, !busy_o || (built_q && dut.state_q <= 4'd13))

  logic reset_q = 1'b0;  // a cover begins with a reset
  always_ff @(posedge clk_i) reset_q <= reset_q || !rst_dut_n;
  `FV_COVER(seen_second_stage, reset_q && table_write_o.we_rate && table_write_o.stage == 7'd1)

endmodule

`default_nettype wire
