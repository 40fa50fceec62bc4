// SPDX-License-Identifier: Apache-2.0
// ppmc_ramp_seq: pulse count and place on the ramp: how many pulses are left and at which rate the next
// interval runs.
// Rules:  P104-PRO-01..06, P104-FDC-01..03/05, P104-RMP-01/02, P104-OPR-02, P104-RD-07, P104-BCK-05.
// Timing: pulses are at least 3 clk apart, the first one 4 clk behind load_i. What pulse_i changes stands after
//         its edge, but for rate_o, which is the rate of the new interval
//         - speeding up or holding: at once. The look-up of the next rate follows; for its 3 n + 1 clk, n = rates
//           that the ramp skips, seek_o keeps a pulse back.
//         - first step down: one clk later (rising_o). It is the rate of the interval before the last step up.
//         - further steps down: when rising_o falls. The look-up runs in the new interval, 3 n + 1 clk, too, and
//           rate_o rises from the rate before.
//         Base clocks 4 clk apart never come to the end of an interval before its look-up does: n is at most its
//         rate. Those 6 clk apart do not come to its middle: on ramps of 4 steps and more n is smaller, or 1.
// How:    climb is the number of acceleration pulses made and not yet walked back (index of the running
//         interval + 1); room_q has its bits inverted.
`include "ppmc_assert.svh"
`default_nettype none

module ppmc_ramp_seq #(
    parameter int unsigned CountBits = 24,  // pulses
    parameter int unsigned RateBits  = 8,
    parameter int unsigned StepBits  = 14,  // steps of the ramp, PA + 1 must fit
    parameter int unsigned LutBits   = 14   // width of the ramp table
) (
    input wire logic clk_i,
    input wire logic rst_ni,
    // ramp in force
    input wire logic [RateBits-1:0] slow_i,  // start-up rate
    input wire logic [RateBits-1:0] fast_i,  // high-speed rate
    output logic [RateBits-1:0] lut_addr_o,  // r; thr(r) is expected two clk later
    input wire logic [LutBits-1:0] lut_data_i,  // thr(r); at fast_i: acceleration pulses PA
    // operation
    input wire logic load_i,  // start: takes count and rate
    input wire logic [CountBits-1:0] count_i,  // pulses to make, minus 1
    input wire logic single_i,  // one pulse, whatever count_i says
    input wire logic [RateBits-1:0] rate_i,  // rate of the first interval: slow_i, or of constant speed
    input wire logic ramp_i,  // use the ramp; steady between load_i and the next one
    input wire logic pulse_i,  // pulse event
    input wire logic forced_i,  // forced deceleration; never withdrawn but by the end of the motion
    // state
    output logic [RateBits-1:0] rate_o,  // rate of the running interval
    output logic seek_o,  // a look-up runs: no pulse may come
    output logic rising_o,  // and rate_o may still rise
    output logic last_o,  // a pulse now would be the last one
    output logic final_o,  // and would complete the count
    output logic top_o,  // running interval is on the plateau
    output logic crawl_o,  // before any deceleration: it has the start-up rate
    output logic dec_o,  // natural deceleration has begun
    output logic [CountBits-1:0] left_o  // pulses left minus 1, but at least 0
);

  typedef enum logic [1:0] {
    StRest,  // the threshold of probe_q stands
    StRead,  // table access
    StWait,
    StTest
  } state_e;

  state_e state_q;
  logic [StepBits-1:0] climb, room_q;  // room_q = ~climb: to compare is to add then, without inverters
  logic [RateBits-1:0] probe_q;  // rate under test
  logic [RateBits-1:0] back_q;  // rate of the interval before the last step up
  logic near_q, full_q, zero_q, low_q;  // comparisons, a clk after the counters
  logic load_q;  // probe_q is the rate of the running interval
  logic slower_q;  // the way down has begun
  logic end_q;  // the look-up has come to the end of the ramp; what it compares stands still before a test
  logic probe_slow_q;  // probe_q is the start-up rate; it stands still long before it is used
  logic up, down, turn, odd, high, step, below, reached, more;
  logic [StepBits:0] unused_sum;

  // Where the walk goes at a pulse event. left_o is the number of pulses that follow this one.
  always_comb begin
    odd     = left_o[0] ^ climb[0];  // with near_q: the way down is as long as the way left
    down    = ramp_i && (forced_i || dec_o || (near_q && odd));
    up      = ramp_i && !down && !near_q && !top_o;
    turn    = down && !slower_q;
    final_o = zero_q;
    last_o  = zero_q || (forced_i && low_q);
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      near_q <= 1'b0;
      full_q <= 1'b0;
      zero_q <= 1'b0;
      low_q  <= 1'b0;
      top_o  <= 1'b0;
      dec_o  <= 1'b0;
    end else begin
      near_q <= !high && !ppmc_pkg::less(32'(climb), 32'(left_o[StepBits-1:0]));
      full_q <= reached;  // at rest up to the way down: PA, no other threshold is left
      zero_q <= !high && left_o[StepBits-1:0] == '0;
      low_q  <= climb[StepBits-1:1] == '0;
      if (load_i) begin
        top_o <= 1'b0;
        dec_o <= 1'b0;
      end else if (pulse_i) begin
        if (up || down) top_o <= up && full_q;
        if (ramp_i && near_q && (odd || !top_o)) dec_o <= 1'b1;
      end
    end
  end

  // Synchronous reset, which the part's reset is long enough for: it doubles as the load of a single step.
  always_ff @(posedge clk_i) begin
    if (!rst_ni || (load_i && single_i)) left_o <= '0;
    else if (load_i) left_o <= count_i;
    else if (pulse_i && !zero_q) left_o <= left_o - 1'b1;
  end

  // No reset: every motion begins with a load.
  always_ff @(posedge clk_i) begin
    probe_slow_q <= probe_q == slow_i;
    end_q <= slower_q ? rate_o == slow_i : probe_q == fast_i;
    if (load_i) crawl_o <= 1'b1;
    else if (pulse_i && up) crawl_o <= probe_slow_q;
  end

  assign high  = left_o[CountBits-1:StepBits] != '0;

  assign climb = ~room_q;

  // No reset: every motion begins with a load.
  always_ff @(posedge clk_i) begin
    if (load_i) room_q <= '1;
    else if (pulse_i && (up || down)) room_q <= room_q + {{(StepBits - 1) {!down}}, 1'b1};
  end

  // Rate look-up. Going up the ramp, probe_q sinks while climb has reached its threshold; at rest it is the rate
  // of the next step up. Going down, rate_o follows probe_q while the index, climb - 1, is below its threshold;
  // at rest probe_q is the next slower rate. The threshold stands then, so that a look-up begins with a test.
  // below: climb < threshold, where slower <=; the sum is too large for its bits then.
  assign {below, unused_sum} = {1'b0, StepBits'(lut_data_i), slower_q} + {1'b0, room_q, slower_q};
  assign reached             = !below;
  assign more                = !end_q && reached != slower_q;
  assign step                = (load_q && slower_q) || (state_q == StTest && more);
  assign seek_o              = state_q != StRest || load_q;
  assign rising_o            = seek_o && slower_q;
  assign lut_addr_o          = probe_q;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      state_q  <= StRest;
      probe_q  <= '0;
      rate_o   <= '0;
      load_q   <= 1'b0;
      slower_q <= 1'b0;
    end else begin
      load_q <= load_i || (pulse_i && turn);
      if (load_q || (pulse_i && up) || (step && slower_q)) rate_o <= probe_q;

      if (load_i) probe_q <= rate_i;
      else if (pulse_i && turn) probe_q <= back_q;
      else if (step) probe_q <= probe_q + {{(RateBits - 1) {!slower_q}}, 1'b1};

      if (load_i) slower_q <= 1'b0;
      else if (pulse_i && down) slower_q <= 1'b1;

      unique case (state_q)
        StRest:  if (pulse_i && (up || (down && slower_q))) state_q <= StTest;
        StRead:  state_q <= StWait;
        StWait:  state_q <= StTest;
        default: state_q <= more ? StRead : StRest;
      endcase
      if (load_i) state_q <= StRest;
    end
  end

  // No reset: the first step up loads it.
  always_ff @(posedge clk_i) begin
    if (pulse_i && up) back_q <= rate_o;
  end

`ifndef SYNTHESIS
  `PPMC_ASSERT(p104_rmp_02_answer, state_q != StTest || probe_q == $past(probe_q, 2))
  `PPMC_ASSERT(p104_bck_05_known, !(pulse_i && ramp_i && seek_o))
  `PPMC_ASSERT(p104_rmp_rate_range, !(pulse_i && ramp_i) || (rate_o <= slow_i && rate_o >= fast_i))
  `PPMC_ASSERT(p104_pro_index, !(pulse_i && up) || !end_q || 32'(climb) <= 32'(lut_data_i))
`endif

endmodule

`default_nettype wire
