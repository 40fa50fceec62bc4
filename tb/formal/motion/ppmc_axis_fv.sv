// SPDX-License-Identifier: Apache-2.0
// ppmc_axis_fv: a complete motion. Proves the number of pulses, their times and low times, and that no
// pulse follows the end. Times are short: the pulse width is 6 cycles, quanta are at least 4 cycles
// apart, and a period of the base clock has 2 or 3 quanta.
// Assumes: rising edges of the clock pin are at least 8 cycles apart. Table entries are at most PA, and the
// entry of the high-speed rate is PA. Rates and PA are stable during a motion. Stops, switches and
// gates are unconstrained.
`include "ppmc_fv.svh"
`default_nettype none

module ppmc_axis_fv
  import ppmc_motion_pkg::*;
(
    input wire logic              clk_i,
    input wire logic              start_i,
    input wire op_t               op_i,
    input wire logic        [3:0] count_i,
    input wire logic        [1:0] rate_i,
    input wire base_clock_t       base_i,
    input wire logic        [1:0] rate_slow_i,
    input wire logic        [1:0] rate_fast_i,
    input wire logic        [1:0] ramp_steps_i,
    input wire logic        [2:0] lut_data_i,
    input wire logic              halt_i,
    input wire logic              decel_i,
    input wire switches_t         switches_i,
    input wire logic              slow_i,
    input wire logic              run_i,
    input wire logic              go_i,
    input wire logic              end_delay_i,
    input wire logic              quantum_i,
    input wire logic              clock_pin_i
);

  localparam int unsigned Width = 6;

  logic [1:0] lut_addr_o, rate_o;
  logic slow_seen_o, restart_o, low_o;
  motion_t motion_o;
  motion_event_t event_o;
  stop_cause_t cause_o;
  logic [3:0] left_o;

  `FV_RESET

  ppmc_axis #(
      .CountBits  (4),
      .RateBits   (2),
      .StepBits   (3),
      .WidthXtal  (Width),
      .FastQuanta (2),
      .SlowQuanta (3),
      .ExtraQuanta(2),
      .HalfRates  (1)
  ) dut (
      .*
  );

  // ---- assumptions ---------------------------------------------------------------------------------

  logic [1:0] quantum_gap_q;  // cycles since the last quantum, saturates at 3
  logic [2:0] rise_gap_q;  // cycles since the last rise of the pin, saturates at 7

  always_ff @(posedge clk_i)
    if (!rst_ni) {quantum_gap_q, rise_gap_q} <= '0;
    else begin
      quantum_gap_q <= (quantum_i || restart_o) ? '0 : (quantum_gap_q == '1) ? '1 : quantum_gap_q + 1'b1;
      rise_gap_q    <= dut.rise ? '0 : (rise_gap_q == '1) ? '1 : rise_gap_q + 1'b1;
    end

  `FV_ASSUME(start_at_rest, !(start_i && motion_o.busy))
  `FV_ASSUME(quantum_of_four_clk, !quantum_i || quantum_gap_q == '1)
  `FV_ASSUME(pin_not_too_fast, !dut.rise || rise_gap_q == '1)
  `FV_ASSUME(legal_ramp, rate_slow_i >= rate_fast_i && ramp_steps_i != '0)
  // The builder writes no threshold above PA. The entry of the high-speed rate is PA.
  logic [1:0] addr1_q, addr2_q;
  always_ff @(posedge clk_i) {addr2_q, addr1_q} <= {addr1_q, lut_addr_o};
  `FV_ASSUME(table_up_to_pa,
             lut_data_i <= 3'(ramp_steps_i) && (addr2_q != rate_fast_i || lut_data_i == 3'(ramp_steps_i)))
  `FV_ASSUME(steady_ramp, start_i || !motion_o.busy || {rate_slow_i, rate_fast_i, ramp_steps_i} == $past
             ({rate_slow_i, rate_fast_i, ramp_steps_i}))

  // ---- motion as requested by the host -------------------------------------------------------------

  op_t op_q;
  base_clock_t base_q;
  logic ended_q;  // 1: a cause of an immediate end has occurred
  logic [4:0] total_q, pulses_q;  // total_q: requested pulses; pulses_q: pulses that have been output
  logic [1:0] rate_q;
  logic immediate, limit;

  assign limit = op_q.ccw ? switches_i.limit_ccw : switches_i.limit_cw;
  assign immediate = motion_o.moving && (limit || switches_i.alarm || halt_i || (decel_i && !op_q.ramp)
                     || (op_q.origin && switches_i.origin && !motion_o.gated));

  always_ff @(posedge clk_i)
    if (!rst_ni) {op_q, base_q, ended_q, total_q, pulses_q, rate_q} <= '0;
    else if (start_i) begin
      {op_q, base_q, ended_q, pulses_q, rate_q} <= {op_i, base_i, 1'b0, 5'd0, rate_i};
      total_q <= op_i.single ? 5'd1 : 5'(count_i) + 5'd1;
    end else begin
      ended_q  <= ended_q || immediate;
      pulses_q <= pulses_q + 5'(event_o.pulse);
    end

  `FV_ASSERT(p104_lim_03_no_pulse_in_the_clk_of_a_cause, !(immediate && event_o.pulse))
  `FV_ASSERT(p104_end_05_no_pulse_after_it, !(ended_q && event_o.pulse))
  `FV_ASSERT(p104_end_01_a_stop_is_a_stop, !(ended_q && motion_o.moving))
  `FV_ASSERT(no_pulse_without_a_motion, motion_o.busy || !(event_o.pulse || low_o))
  `FV_ASSERT(p104_opr_02_never_too_many, !event_o.pulse || pulses_q < total_q)
  `FV_ASSERT(p104_opr_02_exactly_so_many,
             !(event_o.done && cause_o == '0 && !op_q.origin) || pulses_q == total_q)
  `FV_ASSERT(p104_end_05_complete_is_told, !(event_o.pulse && event_o.complete) || pulses_q + 5'd1 == total_q)

  // These lemmas relate the count to the registers of the axis. The induction over the count needs them.
  logic [1:0] gap_q;  // cycles since the start or the last pulse, saturates at 3

  always_ff @(posedge clk_i)
    if (!rst_ni) gap_q <= '0;
    else gap_q <= (start_i || event_o.pulse) ? 2'd1 : (gap_q == 2'd3) ? 2'd3 : gap_q + 2'(gap_q != '0);

  localparam int unsigned Age = ppmc_lfsr_pkg::width(Width - 1);
  localparam logic [Age-1:0] Second = Age'(ppmc_lfsr_pkg::after(1, Age));

  logic near;  // 1: less than three cycles after the start or a pulse
  assign near = gap_q inside {2'd1, 2'd2};

  `FV_ASSERT(lemma_count_operation, op_q == dut.op_q && base_q == dut.base_q)
  `FV_ASSERT(lemma_count_left,
             !motion_o.moving || (5'(left_o) + 5'd1 + pulses_q == total_q && pulses_q < total_q))
  `FV_ASSERT(lemma_count_zero, !motion_o.moving || gap_q < 2'd2 || dut.complete == (left_o == '0))
  `FV_ASSERT(lemma_count_apart, !event_o.pulse || gap_q == 2'd3)
  `FV_ASSERT(lemma_count_gap, !motion_o.moving || gap_q != '0)
  logic lemma_count_width_holds;
  assign lemma_count_width_holds =
      !near || (!dut.width_past && (dut.u_shaper.age_q == Age'(1) || (gap_q == 2'd2 &&
      dut.u_shaper.age_q == Second)));
  `FV_ASSERT(lemma_count_width, lemma_count_width_holds)
  `FV_ASSERT(lemma_count_quanta,
             !(near && motion_o.running && !base_q.external) || quantum_gap_q == gap_q - 2'd1)
  logic lemma_count_edges_holds;
  assign lemma_count_edges_holds =
      !(near && motion_o.running && base_q.external) || (
          !dut.g_extra.u_extra_time.after_q && (rise_gap_q < 3'd3 ||
      (base_q.extra && dut.g_extra.u_extra_time.before_q)));
  `FV_ASSERT(lemma_count_edges, lemma_count_edges_holds)
  `FV_ASSERT(lemma_count_forced, !dut.flagged || cause_o.stop || cause_o.slow)
  `FV_ASSERT(lemma_count_why,
             !(motion_o.busy && !motion_o.moving) || op_q.origin || cause_o != '0 || pulses_q == total_q)

  // ---- set-up, direction, low time -----------------------------------------------------------------

  // setup_q: cycles since the start or the end of the RUN gate; age_q: cycles since a pulse; both saturate
  // at 7
  logic [2:0] setup_q, age_q;

  always_ff @(posedge clk_i)
    if (!rst_ni) {setup_q, age_q} <= '0;
    else begin
      setup_q <= (start_i || motion_o.gated) ? '0 : (setup_q == '1) ? '1 : setup_q + 1'b1;
      age_q   <= event_o.pulse ? '0 : (age_q == '1) ? '1 : age_q + 1'b1;
    end

  `FV_ASSERT(p104_tim_02_set_up, !event_o.pulse || setup_q >= 3'(Width - 1))
  `FV_ASSERT(p104_tim_02_direction_steady, !motion_o.busy || motion_o.op.ccw == op_q.ccw)
  `FV_ASSERT(p104_tim_05_low_never_longer, !low_o || age_q < 3'(Width))
  `FV_ASSERT(p2104_opr_02_gate, !(motion_o.gated && event_o.pulse))

  // ---- intervals of the internal base clock --------------------------------------------------------

  logic [4:0] quanta_q;  // quanta since the last pulse, saturates at 31

  always_ff @(posedge clk_i)
    if (!rst_ni || event_o.pulse) quanta_q <= '0;
    else if (quantum_i && quanta_q != '1) quanta_q <= quanta_q + 1'b1;

  function automatic logic [4:0] interval(logic [1:0] rate);
    return (5'(rate) + 5'd1) * (base_q.slow ? 5'd3 : 5'd2) + (base_q.extra ? 5'd2 : 5'd0);
  endfunction

  `FV_ASSERT(
      p104_int_01_each_interval,
      !(event_o.pulse && motion_o.running && !base_q.external) || (quantum_i && quanta_q + 5'd1 == interval(
      rate_o)))
  `FV_ASSERT(p104_int_01_constant_rate,
             !(event_o.pulse && motion_o.running && !op_q.ramp) || rate_o == rate_q)

  // These lemmas relate the intervals to the registers of the axis.
  logic [3:0] since_q;  // cycles since the start or the last pulse, saturates at 15
  logic [1:0] from_q;  // rate before the last pulse
  logic still_q;  // 1: neither rate nor base clock changed in the previous cycle
  logic between, inner;  // between: between two pulses; inner: between = 1, and the base clock is internal

  assign between = motion_o.running;
  assign inner   = between && !base_q.external;

  always_ff @(posedge clk_i)
    if (!rst_ni) {since_q, from_q, still_q} <= '0;
    else begin
      since_q <= (start_i || event_o.pulse) ? 4'd1 : (since_q == '1) ? '1 : since_q + 4'(since_q != '0);
      if (event_o.pulse) from_q <= rate_o;
      still_q <= !(start_i || event_o.pulse || dut.lookup_busy || dut.tick);
    end

  logic [1:0] state, probe, counted;
  logic [2:0] ramp_level;
  logic test, read, waits, slower, loads;
  assign {state, probe, counted} = {dut.u_seq.state_q, dut.u_seq.lookup_rate_q, dut.u_rate.count_q};
  assign ramp_level = dut.u_seq.ramp_level;
  assign {test, read, waits} = {state == 2'd3, state == 2'd1, state == 2'd2};
  assign {slower, loads} = {dut.u_seq.decel_q, dut.u_seq.load_q};

  `FV_ASSERT(lemma_rate_since, gap_q == (since_q > 4'd3 ? 2'd3 : since_q[1:0]))
  `FV_ASSERT(lemma_rate_first, !(motion_o.moving && !between) || (state == '0 && !slower && ramp_level == '0))
  logic lemma_rate_near_holds;
  assign lemma_rate_near_holds =
      !motion_o.moving || gap_q < 2'd2 || (dut.u_seq.near_q == (!left_o[3] && ramp_level >= left_o[2:0]) &&
      dut.u_seq.low_q == (ramp_level[2:1] == '0));
  `FV_ASSERT(lemma_rate_near, lemma_rate_near_holds)
  `FV_ASSERT(lemma_rate_loads, !loads || (since_q == 4'd1 && state == '0))
  logic lemma_rate_constant_holds;
  assign lemma_rate_constant_holds =
      !(motion_o.moving && !op_q.ramp) || (!slower && state == '0 && probe == rate_q && (loads ||
      rate_o == rate_q));
  `FV_ASSERT(lemma_rate_constant, lemma_rate_constant_holds)
  `FV_ASSERT(lemma_rate_range,
             !(motion_o.moving && op_q.ramp) || loads || (rate_o <= rate_slow_i && rate_o >= rate_fast_i))
  logic lemma_rate_lookup_holds;
  assign lemma_rate_lookup_holds =
      !(motion_o.moving && op_q.ramp) || (slower ? loads || probe == rate_o + 2'd1 : probe >= rate_fast_i &&
      probe <= rate_slow_i && (loads || probe <= rate_o));
  `FV_ASSERT(lemma_rate_lookup, lemma_rate_lookup_holds)
  logic lemma_rate_prev_holds;
  assign lemma_rate_prev_holds =
      !(between && op_q.ramp) ||
      (dut.u_seq.prev_rate_q >= rate_fast_i && dut.u_seq.prev_rate_q <= rate_slow_i);
  `FV_ASSERT(lemma_rate_prev, lemma_rate_prev_holds)
  logic lemma_rate_end_holds;
  assign lemma_rate_end_holds =
      !(motion_o.moving && (waits || test || (state == '0 && since_q > 4'd2))) ||
      dut.u_seq.end_q == (slower ? rate_o == rate_slow_i : probe == rate_fast_i);
  `FV_ASSERT(lemma_rate_end, lemma_rate_end_holds)
  logic lemma_rate_search_holds;
  assign lemma_rate_search_holds =
      !(between && state != '0) ||
      4'(since_q) == 4'd3 * 4'(slower ? rate_o - from_q : rate_o - probe) +
      (test ? 4'd1 : read ? 4'hF : 4'd0);
  `FV_ASSERT(lemma_rate_search, lemma_rate_search_holds)
  `FV_ASSERT(lemma_rate_searched, !(between && slower && state != '0) || rate_o >= from_q)
  `FV_ASSERT(
      lemma_rate_clk,
      !inner || since_q == '1 || 6'(since_q) >= {1'b0, quanta_q[2:0], 2'b00} + 6'(quantum_gap_q) + 6'd1)
  `FV_ASSERT(lemma_rate_few, !inner || quanta_q < 5'd16)
  logic lemma_rate_edges_holds;
  assign lemma_rate_edges_holds =
      !(between && base_q.external) || since_q == '1 ||
      6'(since_q) >= {1'b0, counted, 3'b000} +
      (dut.g_extra.u_extra_time.before_q ? 6'd0 : 6'(rise_gap_q)) + 6'd1;
  `FV_ASSERT(lemma_rate_edges, lemma_rate_edges_holds)
  `FV_ASSERT(
      lemma_rate_before,
      !(between && base_q.external && base_q.extra && dut.g_extra.u_extra_time.before_q) || counted == '0)
  `FV_ASSERT(lemma_rate_counted, !between || counted <= rate_o || loads)
  logic lemma_rate_left_holds;
  assign lemma_rate_left_holds =
      !inner || (dut.u_base.last_q == (dut.u_base.left_q == '0) && dut.u_base.left_q <= (base_q.slow &&
      !dut.u_base.extra_q ? 2'd2 : 2'd1));
  `FV_ASSERT(lemma_rate_left, lemma_rate_left_holds)
  logic lemma_rate_stretch_holds;
  assign lemma_rate_stretch_holds =
      !inner || !dut.u_base.extra_q || (base_q.extra && counted == '0 &&
      quanta_q + 5'(dut.u_base.left_q) == 5'd1);
  `FV_ASSERT(lemma_rate_stretch, lemma_rate_stretch_holds)
  `FV_ASSERT(lemma_rate_quanta,
             !inner || dut.u_base.extra_q || quanta_q + 5'(dut.u_base.left_q) + 5'd1 == interval(counted))
  `FV_ASSERT(lemma_rate_match, !(between && still_q) || dut.u_rate.match_q == (counted == rate_o))

  `FV_COVER(seen_ramp_to_its_end,
            event_o.pulse && event_o.complete && op_q.ramp && motion_o.dec && pulses_q == 5'd3)
  `FV_COVER(seen_limit_between_pulses, event_o.stop && limit && pulses_q == 5'd2)

endmodule

`default_nettype wire
