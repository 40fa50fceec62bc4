// SPDX-License-Identifier: Apache-2.0
// ppmc312_stage_builder_fv: proves that a build writes each word of its table once and in order, and ends. The
// results of the arithmetic and the words of the RAM have any value; an operation lasts at most 3 cycles here.
`include "ppmc_fv.svh"
`default_nettype none

module ppmc312_stage_builder_fv
  import ppmc312_stage_pkg::*;
(
    input wire logic        clk_i,
    input wire logic        start_i,
    input wire curve_t      curve_i,
    input wire logic        op_busy_i,
    input wire logic [39:0] hi_i,
    input wire logic [23:0] lo_i
);

  logic busy_o, too_few_pulses_o, op_start_o, op_mul_o;
  table_write_t table_write_o;
  logic [1:0] begins_o;
  logic [6:0] first_acc_i, first_dec_i;
  logic [5:0] op_steps_o;
  logic [23:0] op_lo_o;
  logic [39:0] word_o;

  `FV_RESET

  ppmc312_stage_builder dut (.*);

  // An operation is busy from the cycle after its start on.
  logic started_q;
  logic [1:0] op_age_q;
  always_ff @(posedge clk_i)
    if (!rst_ni) {started_q, op_age_q} <= '0;
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
  always_ff @(posedge clk_i)
    if (!rst_ni) {first_acc_i, first_dec_i} <= '0;
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

  always_ff @(posedge clk_i) begin
    busy_q <= rst_ni && busy_o;
    if (!rst_ni) {rates_q, next_q, few_q, built_q} <= '0;
    else if (start_i) {rates_q, next_q, few_q, built_q} <= 26'd1;
    else begin
      if (table_write_o.we_rate) rates_q <= rates_q + 8'd1;
      for (int unsigned n = 0; n < 2; n++) if (we_side[n]) next_q[n] <= 8'(table_write_o.stage) + 8'd1;
      if (we_side != '0 && table_write_o.data <= 24'd1) few_q <= 1'b1;
    end
  end

  `FV_ASSERT(writes_one_word, $onehot0({table_write_o.we_rate, we_side}))
  `FV_ASSERT(writes_in_a_build, busy_o || {table_write_o.we_rate, we_side} == '0)
  `FV_ASSERT(rates_in_order, !table_write_o.we_rate || 8'(table_write_o.stage) == rates_q)
  for (genvar n = 0; n < 2; n++) begin : g_side
    `FV_ASSERT(pulses_in_order,
               !we_side[n] || 8'(table_write_o.stage) == (next_q[n] == '0 ? 8'(first[n]) : next_q[n]))
    `FV_ASSERT(pulses_after_rates, !we_side[n] || rates_q == 8'd127)
  end
  `FV_ASSERT(no_deceleration_side, !we_side[1] || curve_i.split)
  `FV_ASSERT(complete_rates, !(busy_q && !busy_o) || rates_q == 8'd127)
  `FV_ASSERT(complete_acc, !(busy_q && !busy_o) || next_q[0] == 8'd127)
  `FV_ASSERT(complete_dec, !(busy_q && !busy_o && curve_i.split) || next_q[1] == 8'd127)
  `FV_ASSERT(p312_tbl_05_few, busy_o || !built_q || too_few_pulses_o == few_q)
  `FV_ASSERT(operand_idle, busy_o || !busy_q || !op_start_o)

  // ---- end --------------------------------------------------------------------------------------------

  // still_q: cycles in one state and side; changes_q: changes of state in one stage of a pass.
  logic [3:0] still_q, changes_q;
  logic [4:0] place_q, place;
  assign place = {dut.state_q, dut.side_q};

  always_ff @(posedge clk_i) begin
    place_q <= place;
    if (!rst_ni || !busy_o || place != place_q || dut.state_q == 4'd13) still_q <= '0;
    else still_q <= still_q + 4'd1;
    if (!rst_ni || !busy_o || dut.state_q == 4'd13) changes_q <= '0;
    else if (place != place_q && changes_q != '1) changes_q <= changes_q + 4'd1;
  end

  `FV_ASSERT(ends_each_state, still_q < 4'd9)
  `FV_ASSERT(ends_each_stage, changes_q < 4'd13)
  `FV_ASSERT(ends_in_order,
             dut.state_q == 4'd13 || $past(dut.state_q) != 4'd13 || !$past(rst_ni) ||
             (dut.stage_q == $past(dut.stage_q) + 7'd1 && dut.pass_q == $past(dut.pass_q)) ||
             ($past(dut.stage_q) == 7'd126 && (dut.pass_q ? !$past(dut.pass_q) && dut.stage_q == '0 : 1'b0)) ||
             ($past(dut.stage_q) == 7'd126 && $past(dut.pass_q) && !busy_o))

  // ---- lemmas -----------------------------------------------------------------------------------------

  `FV_ASSERT(lemma_rates, !busy_o || dut.pass_q || dut.state_q <= 4'd3 || rates_q ==
             8'(dut.stage_q) + 8'(dut.state_q inside {4'd9, 4'd13} || (dut.state_q == 4'd8 && dut.side_q)))
  `FV_ASSERT(lemma_all_rates, !dut.pass_q || !busy_o || rates_q == 8'd127)

  logic [1:0] done_q;  // sides whose word of this stage is written
  always_ff @(posedge clk_i)
    done_q <= (!rst_ni || !busy_o || dut.state_q == 4'd13) ? '0 : done_q | we_side;
  for (genvar n = 0; n < 2; n++) begin : g_side_lemma
    logic [7:0] next;
    assign next = done_q[n] ? 8'(dut.stage_q) + 8'd1 : (dut.stage_q > first[n]) ? 8'(dut.stage_q) : '0;
    `FV_ASSERT(lemma_next, !busy_o || next_q[n] == ((dut.pass_q && (n == 0 || curve_i.split)) ? next : '0))
    `FV_ASSERT(lemma_open,
               !busy_o || !dut.pass_q || dut.state_q <= 4'd4 && dut.stage_q == first[n] ||
               dut.open_q[n] == (dut.stage_q >= first[n]))
    `FV_ASSERT(lemma_first, first[n] <= 7'd126)
  end
  `FV_ASSERT(lemma_done,
             !busy_o || !dut.pass_q || (dut.state_q == 4'd13 ?
             done_q == {dut.open_q[1] && curve_i.split, dut.open_q[0]} :
             !done_q[1] && done_q[0] == (dut.side_q && dut.open_q[0])))
  `FV_ASSERT(lemma_pass, !busy_o || dut.stage_q <= 7'd126 && (dut.state_q == 4'd4 || dut.state_q == 4'd13 ||
             dut.pass_q == (dut.state_q inside {4'd10, 4'd11, 4'd12})) && (!dut.side_q || curve_i.split ||
             dut.state_q == 4'd8))
  `FV_ASSERT(lemma_side, !dut.side_q || !busy_o || dut.state_q inside {4'd8, 4'd9, 4'd10, 4'd11, 4'd12, 4'd13})

  `FV_COVER(seen_second_stage, table_write_o.we_rate && table_write_o.stage == 7'd1)

endmodule

`default_nettype wire
