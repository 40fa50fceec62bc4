// SPDX-License-Identifier: Apache-2.0
// ppmc_ramp_seq: pulse count and place on the ramp: how many pulses are left and at which rate the next
// interval runs.
// Rules:  P104-PRO-01..06, P104-FDC-01..03/05, P104-RMP-01/02, P104-OPR-02, P104-RD-07.
// Timing: all that pulse_i changes stands after its edge, but rate_o may still rise while seek_o is set: a
//         deceleration step looks its rate up while its interval already runs. An acceleration step is looked
//         up one interval ahead.
// How:    climb_q is the number of acceleration pulses made and not yet walked back (index of the running
//         interval + 1).
`include "ppmc_assert.svh"
`default_nettype none

module ppmc_ramp_seq #(
    parameter int unsigned CountBits = 24,  // pulses
    parameter int unsigned RateBits  = 8,
    parameter int unsigned StepBits  = 14,  // steps of the ramp, steps_i + 1 must fit
    parameter int unsigned LutBits   = 14   // width of the ramp table
) (
    input  wire logic                 clk_i,
    input  wire logic                 rst_ni,
    // ramp in force
    input  wire logic [ RateBits-1:0] slow_i,      // start-up rate
    input  wire logic [ RateBits-1:0] fast_i,      // high-speed rate
    input  wire logic [ StepBits-1:0] steps_i,     // acceleration pulses PA
    output logic      [ RateBits-1:0] lut_addr_o,  // r; thr(r) is expected two clk later
    input  wire logic [  LutBits-1:0] lut_data_i,
    // operation
    input  wire logic                 load_i,      // start: takes count and rate
    input  wire logic [CountBits-1:0] count_i,     // pulses to make, minus 1
    input  wire logic                 single_i,    // one pulse, whatever count_i says
    input  wire logic [ RateBits-1:0] rate_i,      // rate of a constant-speed operation
    input  wire logic                 ramp_i,      // use the ramp; steady while the motion lasts
    input  wire logic                 pulse_i,     // pulse event
    input  wire logic                 forced_i,    // forced deceleration; never withdrawn
    // state
    output logic      [ RateBits-1:0] rate_o,      // rate of the running interval
    output logic                      seek_o,      // a look-up runs: no pulse may come
    output logic                      rising_o,    // and rate_o is not final yet
    output logic                      last_o,      // a pulse now would be the last one
    output logic                      final_o,     // and would complete the count
    output logic                      top_o,       // running interval is on the plateau
    output logic                      crawl_o,     // before any deceleration: it has the start-up rate
    output logic                      dec_o,       // natural deceleration has begun
    output logic      [CountBits-1:0] left_o       // pulses left minus 1, but at least 0
);

  typedef enum logic [2:0] {
    StRest,
    StTurn,  // from the running rate to the next slower one
    StRead,  // table access
    StWait,
    StTest
  } state_e;

  state_e state_q;
  logic [StepBits-1:0] climb_q;
  logic [RateBits-1:0] probe_q;  // rate under test
  logic near_q, full_q, zero_q, low_q;  // comparisons, a clk after the counters
  logic load_q, slower_q, down_q;
  logic probe_slow_q;  // probe_q is the start-up rate; it stands still long before it is used
  logic up, down, odd, high, reached, more;

  // Where the walk goes at a pulse event. left_o is the number of pulses that follow this one.
  always_comb begin
    odd     = left_o[0] ^ climb_q[0];  // with near_q: the way down is as long as the way left
    down    = ramp_i && (forced_i || dec_o || (near_q && odd));
    up      = ramp_i && !down && !near_q && !top_o;
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
      near_q <= !high && left_o[StepBits-1:0] <= climb_q;
      full_q <= climb_q == steps_i;
      zero_q <= !high && left_o[StepBits-1:0] == '0;
      low_q  <= climb_q[StepBits-1:1] == '0;
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
    if (load_i) crawl_o <= 1'b1;
    else if (pulse_i && up) crawl_o <= probe_slow_q;
  end

  assign high = left_o[CountBits-1:StepBits] != '0;

  // No reset: every motion begins with a load.
  always_ff @(posedge clk_i) begin
    if (load_i) climb_q <= '0;
    else if (pulse_i && (up || down)) climb_q <= climb_q + {{(StepBits - 1) {down}}, 1'b1};
  end

  // Rate look-up. Downhill in rate (acceleration): probe_q goes down while climb_q has reached its
  // threshold, and becomes the
  // rate at the next step up. Uphill: the rate follows probe_q while the index, climb_q - 1, is below its
  // threshold.
  assign reached = {climb_q, !slower_q} >= {StepBits'(lut_data_i), slower_q};  // > where slower, else >=
  assign more = slower_q ? (rate_o != slow_i && !reached) : (probe_q != fast_i && reached);
  assign seek_o = state_q != StRest;
  assign rising_o = seek_o && down_q;
  assign lut_addr_o = probe_q;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      state_q  <= StRest;
      probe_q  <= '0;
      rate_o   <= '0;
      load_q   <= 1'b0;
      slower_q <= 1'b0;
      down_q   <= 1'b0;
    end else begin
      load_q <= load_i;
      if (load_q) rate_o <= probe_q;
      if (load_i) begin
        probe_q  <= ramp_i ? slow_i : rate_i;
        slower_q <= 1'b0;
        state_q  <= StRest;
      end else if (pulse_i && ramp_i) begin
        // Once turned, the next slower rate and its threshold already wait.
        slower_q <= !up;
        down_q   <= down;
        if (up) rate_o <= probe_q;
        if (up) state_q <= StRead;
        else if (slower_q) state_q <= StTest;
        else begin
          probe_q <= rate_o;
          state_q <= StTurn;
        end
      end else begin
        unique case (state_q)
          StTurn: begin
            probe_q <= probe_q + 1'b1;
            state_q <= StRead;
          end
          StRead:  state_q <= StWait;
          StWait:  state_q <= StTest;
          StTest: begin
            state_q <= more ? StRead : StRest;
            if (more) begin
              probe_q <= slower_q ? probe_q + 1'b1 : probe_q - 1'b1;
              if (slower_q) rate_o <= probe_q;
            end
          end
          default: ;
        endcase
      end
    end
  end

`ifndef SYNTHESIS
  `PPMC_ASSERT(p104_rmp_rate_range, !(pulse_i && ramp_i) || (rate_o <= slow_i && rate_o >= fast_i))
  `PPMC_ASSERT(p104_pro_index, !(pulse_i && ramp_i) || 32'(climb_q) <= 32'(steps_i) + 1)
`endif

endmodule

`default_nettype wire
