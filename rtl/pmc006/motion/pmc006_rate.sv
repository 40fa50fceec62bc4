// SPDX-License-Identifier: Apache-2.0
// pmc006_rate: generates the steps of a motion. Contains the update ticks, the current speed, the rate
//         accumulator and the counter of the remaining steps.
// Rules:  P006-MOT-01..05.
// Timing: E is the edge that ends the cycle of a µs tick. At E, the tick counter, V, B and W change, or the
//         motion ends. A scheduled step is made at E + 2; step_o is high in the cycle before E + 2, and
//         advance_o in the cycle after E + 2. busy_i falls at the edge that ends the cycle of motion_end_o.
`include "ppmc_assert.svh"
`default_nettype none

module pmc006_rate (
    input  wire logic        clk_i,
    input  wire logic        rst_ni,
    input  wire logic        us_i,            // strobe every microsecond
    input  wire logic [30:0] count_i,         // number of steps, sampled in the cycle before busy_i rises
    input  wire logic [11:0] vstart_i,        // VSTART, first value of V; sampled with count_i
    input  wire logic        endless_i,       // 1: speed run, which left_o does not end
    input  wire logic        busy_i,          // 1: the motion is in progress
    input  wire logic        halt_i,          // 1: stop the motion immediately
    input  wire logic        end_run_i,       // 1: end the motion at the next update tick
    input  wire logic        load_v_i,        // strobe: load Vn into V
    input  wire logic [13:0] next_v_i,        // Vn, next value of V
    input  wire logic [10:0] current_comp_i,  // Bn, next value of B
    input  wire logic [ 6:0] lead_angle_i,    // Wn, next value of W
    output logic             t0_o,            // strobe: t = 0
    output logic             update_o,        // strobe: update tick, every 100 µs
    output logic             sample_o,        // strobe in every 100th update tick: sample the speed input
    output logic             advance_o,       // strobe: begin the computation for the next update tick
    output logic             step_o,          // combinational; 1: a step is made at the next edge
    output logic             motion_end_o,    // combinational; 1: the motion ends (halted or complete)
    output logic      [13:0] v_o,             // current speed V
    output logic      [30:0] left_o,          // remaining steps R
    output logic      [10:0] current_comp_o,  // current compensation B
    output logic      [ 6:0] lead_angle_o     // lead angle W
);

  // Minimum time from acceptance to t = 0, in cycles. The planner needs fewer cycles, see pmc006_calc.
  localparam int unsigned PlanCycles = 800;
  localparam logic [6:0] UpdateTicks = 7'd100;  // µs ticks between two update ticks
  localparam logic [6:0] SampleUpdates = 7'd100;  // update ticks between two samples

  // accu_q stores the accumulator of the rules (P006-MOT-01..05) plus 2^20 - 10^6, so that a carry of the sum
  // schedules a step.
  localparam logic [19:0] AccuStart = 20'd48_576;

  logic [6:0] ticks_q, updates_q;
  logic [19:0] accu_q;
  logic [20:0] sum;
  logic planned, run_q, tick, last_tick, last_step_q;
  logic accumulate_q;  // 1: add V to the accumulator in this cycle
  logic step_pending_q;  // 1: a step is scheduled
  logic [1:0] update_dly_q;
  logic [10:0] current_comp_q;
  logic [6:0] lead_angle_q;

  ppmc_delay #(
      .Ticks(PlanCycles - 1)
  ) u_plan (
      .clk_i,
      .restart_i(!busy_i),
      .tick_i   (1'b1),
      .past_o   (planned)
  );

  assign t0_o         = busy_i && !run_q && planned && us_i;
  assign tick         = run_q && busy_i && us_i;
  assign last_tick    = ticks_q == UpdateTicks - 1'b1;
  assign update_o     = tick && last_tick;
  assign sample_o     = update_o && updates_q == SampleUpdates - 1'b1;
  assign step_o       = step_pending_q && busy_i && !halt_i;
  assign motion_end_o = halt_i || (update_o && end_run_i) || (step_pending_q && last_step_q && !endless_i);
  assign sum          = {1'b0, accu_q} + {1'b0, step_pending_q ? AccuStart : 20'(v_o)};

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      run_q          <= 1'b0;
      accumulate_q   <= 1'b0;
      update_dly_q   <= '0;
      step_pending_q <= 1'b0;
      advance_o      <= 1'b0;
    end else begin
      // run_q is cleared by busy_i, one cycle after motion_end_o, because motion_end_o is timing-critical.
      run_q          <= busy_i && (run_q || t0_o);
      accumulate_q   <= tick;
      update_dly_q   <= {2{busy_i}} & {update_dly_q[0], t0_o || update_o};
      step_pending_q <= accumulate_q && sum[20] && busy_i;
      advance_o      <= update_dly_q[1] && busy_i;
    end
  end

  // No reset: these registers are set before a motion begins.
  always_ff @(posedge clk_i) begin
    if (!run_q) {ticks_q, updates_q} <= '0;
    else if (tick) begin
      ticks_q <= last_tick ? '0 : ticks_q + 1'b1;
      if (last_tick) updates_q <= sample_o ? '0 : updates_q + 1'b1;
    end

    if (!run_q) accu_q <= AccuStart;
    else if (accumulate_q || step_pending_q) accu_q <= sum[19:0];

    // V follows VSTART every cycle until a motion is accepted, because the start of a motion is
    // timing-critical.
    if (!busy_i) v_o <= 14'(vstart_i);
    else if (update_o || load_v_i) v_o <= next_v_i;

    if (!busy_i) left_o <= count_i;
    else if (step_o) left_o <= left_o - 1'b1;
    last_step_q <= left_o == 31'd1;
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) {current_comp_q, lead_angle_q} <= '0;
    else if (!busy_i) {current_comp_q, lead_angle_q} <= '0;
    else if (update_o) {current_comp_q, lead_angle_q} <= {current_comp_i, lead_angle_i};
  end

  assign current_comp_o = current_comp_q & {11{busy_i}};
  assign lead_angle_o   = lead_angle_q & {7{busy_i}};

`ifndef SYNTHESIS
  `PPMC_ASSERT(rate_steps_apart, !(step_o && $past(step_o)))
`endif

endmodule

`default_nettype wire
