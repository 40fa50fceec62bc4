// SPDX-License-Identifier: Apache-2.0
// ppmc_ramp_seq: counts the pulses of a motion, traverses the ramp, and outputs the rate of each interval.
// Rules:  P104-PRO-01..06, P104-FDC-01..03/05, P104-RMP-01/02, P104-OPR-02, P104-RD-07, P104-BCK-05.
// Timing: all state that pulse_i changes is valid after its edge, except rate_o, the rate of the new
//         interval.
//         - Acceleration and constant rate: rate_o changes at the same edge. The look-up of the next rate
//           follows. It takes 3 n + 1 cycles, where n is the number of rates that the ramp skips. During
//           this time, lookup_busy_o delays a pulse.
//         - First deceleration step: rate_o changes one cycle later (rising_o = 1), to the rate of the
//           interval before the last acceleration step.
//         - Further deceleration steps: the look-up runs in the new interval, also for 3 n + 1 cycles.
//           During the look-up, rate_o rises from the previous rate, and is valid when rising_o falls.
// Assumes: pulses are at least 3 cycles apart; pulse 1 is at least 4 cycles after load_i.
`include "ppmc_assert.svh"
`default_nettype none

module ppmc_ramp_seq #(
    parameter int unsigned CountBits = 24,  // bits of the pulse count
    parameter int unsigned RateBits  = 8,
    parameter int unsigned StepBits  = 14,  // bits of ramp_level (maximum: acceleration pulses + 1)
    parameter int unsigned LutBits   = 14   // bits of a word of the ramp table
) (
    input wire logic clk_i,
    input wire logic rst_ni,
    // current ramp
    input wire logic [RateBits-1:0] slow_i,  // start-up rate
    input wire logic [RateBits-1:0] fast_i,  // high-speed rate
    output logic [RateBits-1:0] lut_addr_o,  // rate r, which is the address of lut_data_i
    input wire logic [LutBits-1:0] lut_data_i,  // threshold of r, two cycles after lut_addr_o; at fast_i: PA
    // operation
    input wire logic load_i,  // strobe: start; load count_i and rate_i
    input wire logic [CountBits-1:0] count_i,  // number of pulses, minus 1
    input wire logic single_i,  // 1: one pulse, regardless of count_i
    input wire logic [RateBits-1:0] rate_i,  // rate of the first interval: slow_i, or the constant rate
    input wire logic ramp_i,  // 1: use the ramp; stable from load_i to the next load_i
    input wire logic pulse_i,  // strobe: a pulse
    input wire logic forced_i,  // 1: forced deceleration; remains 1 until the motion ends
    // state
    output logic [RateBits-1:0] rate_o,  // rate of the running interval
    output logic lookup_busy_o,  // 1: a look-up is running, and no pulse may occur
    output logic rising_o,  // 1: a look-up is running, and rate_o may still rise
    output logic last_o,  // 1: the next pulse is the last pulse
    output logic final_o,  // 1: the next pulse completes the count
    output logic top_o,  // 1: the running interval is on the plateau
    output logic at_start_rate_o,  // 1: the interval has the start-up rate; valid before any deceleration
    output logic dec_o,  // 1: the natural deceleration has begun
    output logic [CountBits-1:0] left_o  // remaining pulses minus 1; at least 0
);

  typedef enum logic [1:0] {
    StRest,  // the threshold of lookup_rate_q is valid
    StRead,  // reads the table
    StWait,
    StTest
  } state_e;

  state_e state_q;
  // ramp_level: number of acceleration pulses that have been output and are not yet reversed. It equals the
  // index of the running interval + 1. It is stored inverted (ramp_level_nq), so that the comparison is an
  // addition without inverters.
  logic [StepBits-1:0] ramp_level, ramp_level_nq;
  logic [RateBits-1:0] lookup_rate_q;  // rate that is being tested
  logic [RateBits-1:0] prev_rate_q;  // rate of the interval before the last acceleration step
  logic near_q, full_q, zero_q, low_q;  // comparisons of left_o and ramp_level, delayed by one cycle
  logic load_q;  // 1: lookup_rate_q is the rate of the running interval
  logic decel_q;  // 1: the deceleration has begun
  logic end_q;  // 1: the look-up is at the end of the ramp; valid before each test
  logic lookup_slow_q;  // lookup_rate_q is the start-up rate; valid long before its use
  logic up, down, decel_starts, odd, high, lookup_step, below, reached, more;
  logic [StepBits:0] unused_sum;

  // Direction of the ramp step at a pulse: up, down or no step. left_o is the number of pulses after this
  // pulse.
  always_comb begin
    odd          = left_o[0] ^ ramp_level[0];  // odd and near_q: decelerate through all remaining pulses
    down         = ramp_i && (forced_i || dec_o || (near_q && odd));
    up           = ramp_i && !down && !near_q && !top_o;
    decel_starts = down && !decel_q;
    final_o      = zero_q;
    last_o       = zero_q || (forced_i && low_q);
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
      near_q <= !high && !ppmc_pkg::less(32'(ramp_level), 32'(left_o[StepBits-1:0]));
      full_q <= reached;  // 1: ramp_level = PA; valid before the deceleration, while no look-up runs
      zero_q <= !high && left_o[StepBits-1:0] == '0;
      low_q  <= ramp_level[StepBits-1:1] == '0;
      if (load_i) begin
        top_o <= 1'b0;
        dec_o <= 1'b0;
      end else if (pulse_i) begin
        if (up || down) top_o <= up && full_q;
        if (ramp_i && near_q && (odd || !top_o)) dec_o <= 1'b1;
      end
    end
  end

  // The reset is synchronous, because the same input of the flip-flops also clears left_o for a single step.
  // The reset of the core is long enough for this.
  always_ff @(posedge clk_i) begin
    if (!rst_ni || (load_i && single_i)) left_o <= '0;
    else if (load_i) left_o <= count_i;
    else if (pulse_i && !zero_q) left_o <= left_o - 1'b1;
  end

  // No reset: every motion begins with a load.
  always_ff @(posedge clk_i) begin
    lookup_slow_q <= lookup_rate_q == slow_i;
    end_q <= decel_q ? rate_o == slow_i : lookup_rate_q == fast_i;
    if (load_i) at_start_rate_o <= 1'b1;
    else if (pulse_i && up) at_start_rate_o <= lookup_slow_q;
  end

  assign high = left_o[CountBits-1:StepBits] != '0;

  assign ramp_level = ~ramp_level_nq;

  // No reset: every motion begins with a load.
  always_ff @(posedge clk_i) begin
    if (load_i) ramp_level_nq <= '1;
    else if (pulse_i && (up || down)) ramp_level_nq <= ramp_level_nq + {{(StepBits - 1) {!down}}, 1'b1};
  end

  // Rate look-up.
  // Acceleration: lookup_rate_q decreases while ramp_level has reached the threshold of lookup_rate_q.
  // Afterwards, lookup_rate_q is the rate of the next acceleration step.
  // Deceleration: rate_o follows lookup_rate_q while the index, ramp_level - 1, is below the threshold of
  // lookup_rate_q. Afterwards, lookup_rate_q is the next slower rate.
  // After a look-up, the threshold of lookup_rate_q is valid, so the next look-up begins with a test.
  // below: ramp_level < threshold; during deceleration, ramp_level <= threshold. In these cases, the sum
  // has a carry.
  // n is the number of rates that a look-up skips. It is at most the rate of the interval. Therefore, if the
  // ticks of the base clock are 4 cycles apart, a look-up always ends before the end of its interval. On
  // ramps of at least 4 steps, n is also 1 or smaller than the rate. Therefore, if the ticks are 6 cycles
  // apart, a look-up on such a ramp also ends before the middle of its interval.
  assign {below, unused_sum} = {1'b0, StepBits'(lut_data_i), decel_q} + {1'b0, ramp_level_nq, decel_q};
  assign reached             = !below;
  assign more                = !end_q && reached != decel_q;
  assign lookup_step         = (load_q && decel_q) || (state_q == StTest && more);
  assign lookup_busy_o       = state_q != StRest || load_q;
  assign rising_o            = lookup_busy_o && decel_q;
  assign lut_addr_o          = lookup_rate_q;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      state_q <= StRest;
      lookup_rate_q <= '0;
      rate_o <= '0;
      load_q <= 1'b0;
      decel_q <= 1'b0;
    end else begin
      load_q <= load_i || (pulse_i && decel_starts);
      if (load_q || (pulse_i && up) || (lookup_step && decel_q)) rate_o <= lookup_rate_q;

      if (load_i) lookup_rate_q <= rate_i;
      else if (pulse_i && decel_starts) lookup_rate_q <= prev_rate_q;
      else if (lookup_step) lookup_rate_q <= lookup_rate_q + {{(RateBits - 1) {!decel_q}}, 1'b1};

      if (load_i) decel_q <= 1'b0;
      else if (pulse_i && down) decel_q <= 1'b1;

      unique case (state_q)
        StRest:  if (pulse_i && (up || (down && decel_q))) state_q <= StTest;
        StRead:  state_q <= StWait;
        StWait:  state_q <= StTest;
        default: state_q <= more ? StRead : StRest;
      endcase
      if (load_i) state_q <= StRest;
    end
  end

  // No reset: the first acceleration step loads prev_rate_q.
  always_ff @(posedge clk_i) begin
    if (pulse_i && up) prev_rate_q <= rate_o;
  end

`ifndef SYNTHESIS
  `PPMC_ASSERT(p104_rmp_02_answer, state_q != StTest || lookup_rate_q == $past(lookup_rate_q, 2))
  `PPMC_ASSERT(p104_bck_05_known, !(pulse_i && ramp_i && lookup_busy_o))
  `PPMC_ASSERT(p104_rmp_rate_range, !(pulse_i && ramp_i) || (rate_o <= slow_i && rate_o >= fast_i))
  `PPMC_ASSERT(p104_pro_index, !(pulse_i && up) || !end_q || 32'(ramp_level) <= 32'(lut_data_i))
`endif

endmodule

`default_nettype wire
