// SPDX-License-Identifier: Apache-2.0
// ppmc_axis: executes one motion from start to end. Determines the time and low time of each pulse, and the
//         cause of the end.
// Rules:  P104-OPR-01..12, P104-BCK-01..05, P104-INT-01..05, P104-TIM-02..05, P104-END-01..06,
//         P104-LIM-01..10; P2104-OPR-02, P2104-TIM-02, P2104-LIM-07, P2104-DS-21; STMC-MOT-05..08,
//         STMC-CLK-01..05.
// Timing: motion_o.busy rises at the edge that ends the cycle of start_i. Pulse 1 occurs WidthXtal crystal
//         cycles later; if run_i was low, this time begins when the RUN gate ends. With the external clock,
//         pulse 1 occurs at the first clock edge at or after this time.
//         When no pulse is left, busy falls one cycle after low_o falls, or at the next edge if low_o is
//         already 0. event_o.done is high in the cycle before busy falls.
//         No output is a pin. Pins follow low_o and event_o through one register (ppmc_motor_port).
// Note:   the comment above `edges` describes the external clock.
`include "ppmc_assert.svh"
`default_nettype none

module ppmc_axis
  import ppmc_motion_pkg::*;
#(
    parameter int unsigned ClkHz = 16_000_000,
    parameter int unsigned XtalHz = 16_000_000,
    parameter int unsigned CountBits = 24,
    parameter int unsigned RateBits = 8,
    parameter int unsigned StepBits = 14,
    parameter int unsigned LevelBits = StepBits,  // bits of ramp_level (maximum: acceleration pulses + 1)
    parameter int unsigned WidthXtal = 80,  // pulse width and direction set-up time in crystal cycles
    parameter int unsigned FastQuanta = 8,  // period of the fast internal base clock in quanta
    parameter int unsigned SlowQuanta = 32,  // period of the slow internal base clock in quanta
    parameter int unsigned ExtraQuanta = 30,  // extra time in quanta if base_i.extra = 1; 0: no extra time
    parameter int unsigned HalfRates = 3,  // number of rates whose pulse width is half an interval
    parameter bit StopAtSlow = 1'b0,  // 1: at the start-up rate, a deceleration request stops immediately
    parameter bit SlowAlways = 1'b0,  // 1: in POUT mode, slow-down limits also act outside the plateau
    parameter bit SlowOrigin = 1'b0,  // 1: a slow-down limit ends an origin search immediately
    parameter bit OriginAtPulse = 1'b0,  // 1: a search ends with a pulse at the origin, 0: without a pulse
    parameter bit PulsePin = 1'b1  // 0: no pulse output; low_o stays 0, the last pulse ends the motion
) (
    input wire logic clk_i,
    input wire logic rst_ni,
    // start; operation and data are loaded with start_i
    input wire logic start_i,  // strobe: an operation starts at the next edge
    input wire op_t op_i,  // operation to start
    input wire logic [CountBits-1:0] count_i,  // number of pulses, minus 1
    input wire logic [RateBits-1:0] rate_i,  // rate at constant speed
    input wire base_clock_t base_i,  // base clock of the operation
    // current ramp, stable while busy
    input wire logic [RateBits-1:0] rate_slow_i,  // start-up rate
    input wire logic [RateBits-1:0] rate_fast_i,  // high-speed rate
    output logic [RateBits-1:0] lut_addr_o,  // rate r, which is the address of lut_data_i
    input wire logic [StepBits-1:0] lut_data_i,  // threshold of rate r, two cycles later; at rate_fast_i: PA
    // stops
    input wire logic halt_i,  // strobe: immediate stop command
    input wire logic decel_i,  // strobe: deceleration stop command
    input wire switches_t switches_i,  // switches, synchronised
    input wire logic slow_i,  // slow_seen_o, directly or delayed; 1: act on a slow-down limit
    output logic slow_seen_o,  // 1: a slow-down limit is active and effective
    input wire logic run_i,  // 0: a motion that has not begun waits in the RUN gate
    input wire logic go_i,  // 0: pulse 1 must wait
    input wire logic end_delay_i,  // 1: the motion must not end yet
    // clocks
    input wire logic quantum_i,  // strobe: quantum tick, restarted by restart_o
    input wire logic clock_pin_i,  // external base clock, asynchronous
    output logic restart_o,  // strobe: restart the quantum count (at pulse 1 and at the end)
    // state
    output motion_t motion_o,  // state of the motion
    output logic [RateBits-1:0] rate_o,  // rate of the running interval
    output logic low_o,  // 1: a pulse is active
    output motion_event_t event_o,  // events at the next edge
    output stop_cause_t cause_o,  // causes of the end; valid with event_o.done
    output logic [CountBits-1:0] left_o  // remaining pulses minus 1, at least 0; the host reads this number
);

  localparam int unsigned ShortPeriodXtal = 128;  // P104-TIM-05, rate 0: 8 us at 16 MHz
  // P104-INT-03: 8.5 us at 16 MHz
  localparam int unsigned LongPeriodXtal = (ExtraQuanta != 0) ? 136 : ShortPeriodXtal;
  localparam int unsigned ExtraXtal = 4 * ExtraQuanta;

  typedef enum logic [1:0] {
    StIdle,
    StStart,  // direction set-up; then waits for the first base edge
    StRun,    // outputs pulses
    StFinish  // no further pulse; waits for the end of the last low time
  } state_e;

  state_e state_q;
  logic short_period_q;
  switches_t stop_switches;
  logic busy, running, gated_q, armed, fire, last, complete, stop, done, top;
  op_t op_q;
  base_clock_t base_q;
  logic interval_end, width_past, lookup_busy, rising, forced, flagged, dec, at_start_rate, last_pulse;
  logic low, base_tick, rise, fall, ext_long_period, ext_short_period, tick, hit, half, edges, ext_count, cut;

  assign armed = state_q == StStart || state_q == StRun;
  assign busy = state_q != StIdle;
  assign running = state_q == StRun;
  assign done = state_q == StFinish && !low_o && !end_delay_i;
  assign restart_o = (fire && state_q == StStart) || done;
  assign low_o = PulsePin && low;
  assign last = last_pulse || (OriginAtPulse && op_q.origin && switches_i.origin);

  // An immediate end also suppresses a pulse that is scheduled for the same edge.
  always_comb begin
    fire = 1'b0;
    if (state_q == StStart) fire = width_past && go_i && (op_q.single || !base_q.external || rise);
    if (state_q == StRun) fire = interval_end && !(base_q.external && low_o);
    if (stop) fire = 1'b0;
  end

  // In the RUN gate, limits and alarm are effective, but the origin is not. The direction set-up begins
  // when the gate ends.
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) gated_q <= 1'b0;
    else if (start_i || run_i) gated_q <= !run_i;
  end

  always_comb begin
    stop_switches = switches_i;
    if (OriginAtPulse || gated_q) stop_switches.origin = 1'b0;
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      state_q <= StIdle;
      op_q    <= '0;
      base_q  <= '0;
      short_period_q <= 1'b0;
    end else begin
      if (start_i) begin
        state_q <= StStart;
        op_q    <= op_i;
        base_q  <= base_i;
      end else if (stop) state_q <= StFinish;
      else if (fire) state_q <= last ? StFinish : StRun;
      else if (done) state_q <= StIdle;
      if (fire) short_period_q <= ext_short_period && base_q.external;
    end
  end

  ppmc_stop_monitor #(
      .StopAtSlow(StopAtSlow),
      .SlowAlways(SlowAlways),
      .SlowOrigin(SlowOrigin)
  ) u_stop (
      .clk_i,
      .rst_ni,
      .clear_i        (start_i),
      .complete_i     (fire && complete),
      .armed_i        (armed),
      .op_i           (op_q),
      .switches_i     (stop_switches),
      .top_i          (top),
      .at_start_rate_i(at_start_rate && running),
      .dec_i          (dec),
      .halt_i,
      .decel_i,
      .slow_i,
      .slow_seen_o,
      .stop_o         (stop),
      .forced_o       (forced),
      .flagged_o      (flagged),
      .cause_o
  );

  ppmc_ramp_seq #(
      .CountBits(CountBits),
      .RateBits (RateBits),
      .StepBits (LevelBits),
      .LutBits  (StepBits)
  ) u_seq (
      .clk_i,
      .rst_ni,
      .slow_i  (rate_slow_i),
      .fast_i  (rate_fast_i),
      .lut_addr_o,
      .lut_data_i,
      .load_i  (start_i),
      .count_i,
      .single_i(op_i.single),
      .rate_i  (op_i.ramp ? rate_slow_i : rate_i),
      .ramp_i  (op_q.ramp),
      .pulse_i (fire),
      .forced_i(forced),
      .rate_o,
      .lookup_busy_o  (lookup_busy),
      .rising_o(rising),
      .last_o  (last_pulse),
      .final_o (complete),
      .top_o   (top),
      .at_start_rate_o (at_start_rate),
      .dec_o   (dec),
      .left_o
  );

  ppmc_pulse_shaper #(
      .ClkHz    (ClkHz),
      .XtalHz   (XtalHz),
      .RateBits (RateBits),
      .WidthXtal(WidthXtal),
      .HalfXtal (2 * FastQuanta),
      .HalfRates(HalfRates)
  ) u_shaper (
      .clk_i,
      .rst_ni,
      .arm_i  (start_i || gated_q),
      .pulse_i(fire),
      .full_i (last || base_q.extra),
      .halve_i(!base_q.external && !base_q.slow),
      .rate_i (rate_o),
      .cut_i  (cut),
      .low_o  (low),
      .past_o (width_past)
  );

  // Interval: counts base clocks and adds the extra time. A base clock is internal, or an edge of the clock
  // pin.
  // With the external clock, pulses and cuts of low_o occur in the cycle of an effective edge, and act at
  // the end of this cycle:
  // - Edge number rate + 1 after a pulse outputs the next pulse (u_rate: hit_o). If extra time remains, the
  //   pulse is output after this time. If low_o = 1 at an edge, the pulse is output at the next edge
  //   instead. This can occur only after a pulse of rate 0 whose period is not short.
  // - Edge number floor((rate + 1) / 2) marks the middle of the interval (u_rate: half_o). It cuts low_o,
  //   unless the pulse is a full pulse, which is never cut. At rate 0, the falling edge cuts low_o if the
  //   period before the pulse was short (u_shaper, P104-TIM-05).
  // Both numbers refer to the rate of the running interval, which u_seq outputs with the pulse. This rate may
  // still rise for some cycles (rising = 1), but only from the second deceleration step on. During these
  // cycles, neither event occurs. The middle is marked afterwards, and the next pulse is not yet possible
  // (times in ppmc_ramp_seq).
  assign edges = base_q.external && rise;
  assign tick = base_q.external ? edges && ext_count : base_tick;
  assign cut   = base_q.external &&
      ((half && rate_o != '0) || (short_period_q && fall && rate_o == '0 && !rising));

  ppmc_base_clock #(
      .FastQuanta (FastQuanta),
      .SlowQuanta (SlowQuanta),
      .ExtraQuanta(ExtraQuanta)
  ) u_base (
      .clk_i,
      .rst_ni,
      .restart_i(fire),
      .quantum_i,
      .slow_i   (base_q.slow),
      .extra_i  (base_q.extra),
      .tick_o   (base_tick)
  );

  ppmc_ext_clock #(
      .LongPeriodCycles (ppmc_pkg::cyc_round(LongPeriodXtal, ClkHz, XtalHz)),
      .ShortPeriodCycles(ppmc_pkg::cyc(ShortPeriodXtal, ClkHz, XtalHz))
  ) u_ext (
      .clk_i,
      .rst_ni,
      .pin_i(clock_pin_i),
      .rise_o(rise),
      .fall_o(fall),
      .long_period_o(ext_long_period),
      .short_period_o(ext_short_period)
  );

  ppmc_rate_counter #(
      .RateBits(RateBits)
  ) u_rate (
      .clk_i,
      .rst_ni,
      .restart_i(fire),
      .tick_i   (tick),
      .rate_i   (rate_o),
      .wait_i   (lookup_busy),
      .rising_i (rising),
      .hit_o    (hit),
      .half_o   (half)
  );

  if (ExtraQuanta != 0) begin : g_extra
    ppmc_ext_extra_time #(
        .ExtraCycles(ppmc_pkg::cyc_round(ExtraXtal, ClkHz, XtalHz))
    ) u_extra_time (
        .clk_i,
        .rst_ni,
        .en_i         (base_q.external && base_q.extra),
        .restart_i    (fire),
        .edge_i       (edges),
        .long_period_i(ext_long_period),
        .hit_i        (hit),
        .count_o      (ext_count),
        .fire_o       (interval_end)
    );
  end else begin : g_plain
    logic unused_long;

    assign unused_long  = ext_long_period;
    assign ext_count    = 1'b1;
    assign interval_end = hit;
  end

  assign event_o = '{pulse: fire, last: last, complete: complete, stop: stop, done: done};
  assign motion_o = '{
          busy: busy,
          moving: armed,
          running: running,
          gated: gated_q,
          dec: dec || flagged,
          top: top,
          op: op_q,
          base: base_q
      };

  // The assertions check that no pulse occurs at or after an immediate end, that a motion completes its
  // count if no cause ends it, and that no pulse is missed because a low time was not cut.
`ifndef SYNTHESIS
  `PPMC_ASSERT(p104_lim_03_no_pulse, !(fire && stop))
  // External clock edges less than 4 cycles apart are too fast (P104-BAD-14, P2104-BAD-19): the cut may be
  // late.
  logic [2:0] ticked_q;
  logic too_fast, too_fast_q;
  assign too_fast = too_fast_q || (tick && ticked_q != '0);
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) {ticked_q, too_fast_q} <= '0;
    else begin
      ticked_q   <= {ticked_q[1:0], tick};
      too_fast_q <= too_fast && !start_i;
    end
  end
  `PPMC_ASSERT(p104_tim_05_cut,
               !(running && interval_end && low_o && base_q.external && rate_o != '0 && !too_fast))
  `PPMC_ASSERT(p2104_opr_02, !(fire && gated_q))
  `PPMC_ASSERT(p104_opr_12, !(start_i && busy))
  logic final_seen_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) final_seen_q <= 1'b0;
    else if (start_i) final_seen_q <= 1'b0;
    else if (fire && complete) final_seen_q <= 1'b1;
  end
  `PPMC_ASSERT(p104_end_05, !done || op_q.origin || final_seen_q || cause_o != '0)
`endif

endmodule

`default_nettype wire
