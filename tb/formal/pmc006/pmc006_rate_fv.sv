// SPDX-License-Identifier: Apache-2.0
// pmc006_rate_fv: compares steps, update ticks and the end of a motion with an accumulator and counters.
`include "ppmc_fv.svh"
`include "common/ppmc_lemma.svh"
`default_nettype none

module pmc006_rate_fv (
    input wire logic        clk_i,
    input wire logic        power_i,
    input wire logic        us_i,
    input wire logic [30:0] count_i,
    input wire logic [11:0] vstart_i,
    input wire logic        endless_i,
    input wire logic        start_i,
    input wire logic        halt_i,
    input wire logic        end_run_i,
    input wire logic        load_v_i,
    input wire logic [13:0] next_v_i,
    input wire logic [10:0] current_comp_i,
    input wire logic [ 6:0] lead_angle_i
);

  logic busy_i, t0_o, update_o, sample_o, advance_o, step_o, motion_end_o;
  logic [13:0] v_o;
  logic [30:0] left_o;
  logic [10:0] current_comp_o;
  logic [ 6:0] lead_angle_o;

  `FV_RESET
  `FV_ANY_START(power_i)

  pmc006_rate dut (
      .rst_ni(rst_dut_n),
      .*
  );

  // Motion: begins with start_i, ends with motion_end_o.
  logic busy_q, endless_q, run_q;  // run_q: after t = 0
  logic [ 9:0] age_q;  // cycles of the motion, at most 1023
  logic [30:0] left_q;  // steps that are left
  logic [19:0] accu_q;  // accumulator of the rules, below 10^6
  logic [20:0] sum;
  logic [6:0] ticks_q, updates_q;
  logic [1:0] us_age_q;  // cycles since the last tick of the motion, at most 3
  logic tick, due_q, us_q;  // us_q: V is added in this cycle; due_q: a step is made in this cycle
  logic last_q;  // in the last cycle, one step was left
  logic [2:0] advance_q;
  logic [13:0] v_q;
  logic [17:0] drive_q;  // B and W

  typedef logic [798:0][9:0] states_t;
  function automatic states_t states();
    for (int unsigned n = 0; n < 799; n++) states[n] = 10'(ppmc_lfsr_pkg::after(n, 10));
  endfunction
  localparam states_t States = states();

  assign busy_i = busy_q;
  assign tick = run_q && us_i;
  assign sum = 21'(accu_q) + 21'(v_q);

  `FV_ASSUME(us_apart, !us_i || us_age_q == '1)
  `FV_ASSUME(start_at_standstill, !start_i || !(busy_q || halt_i))
  `FV_ASSUME(kind_stable, !busy_q || age_q == '0 || endless_i == endless_q)
  `FV_ASSUME(one_step_at_least, !(busy_q && age_q == '0) || endless_i || left_q != '0)

  always_ff @(posedge clk_i or negedge rst_dut_n)
    if (!rst_dut_n) {busy_q, run_q, due_q, us_q, advance_q, drive_q} <= '0;
    else begin
      busy_q <= start_i || (busy_q && !motion_end_o);
      run_q <= busy_q && !motion_end_o && (run_q || t0_o);
      us_q <= tick && !motion_end_o;
      advance_q <= {3{busy_q}} & {advance_q[1:0], t0_o || update_o};
      if (!busy_q) drive_q <= '0;
      else if (update_o) drive_q <= {current_comp_i, lead_angle_i};
      due_q <= us_q && sum >= 21'd1_000_000 && busy_q;
    end

  always_ff @(posedge clk_i) begin
    us_age_q <= us_i ? '0 : (us_age_q == '1) ? '1 : us_age_q + 1'b1;
    endless_q <= endless_i;
    last_q <= left_q == 31'd1;
    if (!busy_q) v_q <= 14'(vstart_i);
    else if (update_o || load_v_i) v_q <= next_v_i;
    if (!busy_q) {age_q, left_q, accu_q, ticks_q, updates_q} <= {10'd0, count_i, 20'd0, 7'd0, 7'd0};
    else begin
      if (age_q != '1) age_q <= age_q + 1'b1;
      if (step_o) left_q <= left_q - 1'b1;
      if (us_q) accu_q <= (sum >= 21'd1_000_000) ? 20'(sum - 21'd1_000_000) : sum[19:0];
      if (tick) ticks_q <= (ticks_q == 7'd99) ? '0 : ticks_q + 1'b1;
      if (update_o) updates_q <= (updates_q == 7'd99) ? '0 : updates_q + 1'b1;
    end
  end

  `FV_LEMMA(lemma_run, busy_q ? run_q == dut.run_q : !run_q)
  `FV_LEMMA(lemma_age, !run_q || age_q >= 10'd799)
  // verilog_format: off
  `FV_LEMMA(
      lemma_planned,
      !busy_q || (age_q >= 10'd799 ? dut.planned : !dut.planned
          && dut.u_plan.u_timer.count_q == States[age_q]))
  // verilog_format: on
  `FV_LEMMA(lemma_ticks, !busy_q || {dut.ticks_q, dut.updates_q} == {ticks_q, updates_q} || age_q == '0)
  `FV_LEMMA(lemma_no_ticks, !busy_q || run_q || {ticks_q, updates_q, accu_q} == '0)
  `FV_LEMMA(lemma_range, ticks_q <= 7'd99 && updates_q <= 7'd99 && accu_q < 20'd1_000_000)
  `FV_LEMMA(lemma_accumulate, !busy_q || (us_q == dut.accumulate_q && due_q == dut.step_pending_q))
  `FV_LEMMA(lemma_times, (!us_q || (us_age_q == 2'd0 && run_q)) && (!due_q || us_age_q == 2'd1))
  `FV_LEMMA(lemma_accu, !busy_q || age_q == '0 || dut.accu_q == (due_q ? accu_q : accu_q + 20'd48_576))
  `FV_LEMMA(lemma_left, !busy_q || (left_o == left_q && (endless_i || left_q != '0)))
  `FV_LEMMA(lemma_last, !busy_q || age_q == '0 || dut.last_step_q == last_q)
  `FV_LEMMA(lemma_last_stable, !busy_q || age_q == '0 || us_age_q == 2'd2 || last_q == (left_q == 31'd1))
  `FV_LEMMA(lemma_advance, {advance_o, dut.update_dly_q} == advance_q)
  `FV_LEMMA(lemma_v, v_o == v_q)

  `FV_ASSERT(p006_mot_04_begin, t0_o == (busy_q && !run_q && us_i && age_q >= 10'd799))
  `FV_ASSERT(p006_mot_03_step, step_o == (due_q && busy_q && !halt_i))
  // verilog_format: off
  `FV_ASSERT(
      p006_mot_05_end,
      !busy_q || motion_end_o == (halt_i || (update_o && end_run_i) || (due_q && left_q == 31'd1
          && !endless_i)))
  // verilog_format: on
  `FV_ASSERT(p006_mot_05_count, !(step_o && !endless_i) || left_q != '0)
  `FV_ASSERT(p006_mot_50_update, update_o == (tick && busy_q && ticks_q == 7'd99))
  `FV_ASSERT(p006_mot_51_sample, sample_o == (update_o && updates_q == 7'd99))
  `FV_ASSERT(advance, advance_o == advance_q[2])
  `FV_LEMMA(drive, {current_comp_o, lead_angle_o} == (busy_q ? drive_q : '0))
  `FV_COVER(seen_step, step_o && left_q == 31'd5 && v_q == 14'd100 && $past(rst_dut_n))
  `FV_COVER(seen_end, motion_end_o && busy_q && !halt_i && !update_o && $past(rst_dut_n))
  `FV_COVER(seen_sample, sample_o)

endmodule

`default_nettype wire
