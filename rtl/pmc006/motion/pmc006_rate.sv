// SPDX-License-Identifier: Apache-2.0
// pmc006_rate: time and steps of the running motion: update ticks, current speed, rate accumulator, steps
// left.
// Rules:  P006-MOT-01..05, section 5.3.
// Timing: E = edge of a us tick. At E, the count of ticks, V, B and W change, or the motion ends. A scheduled
//         step is made at E + 2 (step_o is high in the cycle before that edge); advance_o follows in the
//         cycle after it. busy_i falls on the edge of stop_o.
`include "ppmc_assert.svh"
`default_nettype none

module pmc006_rate (
    input  wire logic        clk_i,
    input  wire logic        rst_ni,
    input  wire logic        us_i,       // strobe every microsecond
    input  wire logic [30:0] count_i,    // steps, sampled in the cycle before busy_i rises
    input  wire logic [11:0] vstart_i,   // VSTART, the first V, sampled with count_i
    input  wire logic        endless_i,  // kind V
    input  wire logic        busy_i,     // the motion is in progress
    input  wire logic        halt_i,     // stop immediately
    input  wire logic        rest_i,     // end at this update tick
    input  wire logic        start_v_i,  // load Vn into V
    input  wire logic [13:0] next_i,     // Vn
    input  wire logic [10:0] bump_i,     // Bn
    input  wire logic [ 6:0] lead_i,     // Wn
    output logic             launch_o,   // t = 0
    output logic             update_o,   // update tick
    output logic             sample_o,   // every 100th update tick
    output logic             advance_o,  // start of advance()
    output logic             step_o,     // combinational: a step is made
    output logic             stop_o,     // combinational: the motion ends, halted or completed
    output logic      [13:0] v_o,        // V
    output logic      [30:0] left_o,     // R
    output logic      [10:0] bump_o,     // B
    output logic      [ 6:0] lead_o      // W
);

  // Cycles between acceptance and t = 0: more than the planner needs.
  localparam int unsigned Plan = 800;
  localparam logic [6:0] Ticks = 7'd100;

  // The accumulator holds ACCU + 2^20 - 10^6, so that a carry is a step.
  localparam logic [19:0] Rest = 20'd48_576;

  logic [6:0] ticks_q, updates_q;
  logic [19:0] accu_q;
  logic [20:0] sum;
  logic planned, run_q, tick, wrap, last_q;
  logic begun_q;  // accumulate in this cycle
  logic due_q;  // a step is scheduled
  logic [1:0] updated_q;
  logic [10:0] bump_q;
  logic [6:0] lead_q;

  ppmc_delay #(
      .Ticks(Plan - 1)
  ) u_plan (
      .clk_i,
      .restart_i(!busy_i),
      .tick_i   (1'b1),
      .past_o   (planned)
  );

  assign launch_o = busy_i && !run_q && planned && us_i;
  assign tick     = run_q && busy_i && us_i;
  assign wrap     = ticks_q == Ticks - 1'b1;
  assign update_o = tick && wrap;
  assign sample_o = update_o && updates_q == Ticks - 1'b1;
  assign step_o   = due_q && busy_i && !halt_i;
  assign stop_o   = halt_i || (update_o && rest_i) || (due_q && last_q && !endless_i);
  assign sum      = {1'b0, accu_q} + {1'b0, due_q ? Rest : 20'(v_o)};

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      run_q     <= 1'b0;
      begun_q   <= 1'b0;
      updated_q <= '0;
      due_q     <= 1'b0;
      advance_o <= 1'b0;
    end else begin
      // busy_i clears run_q one cycle after stop_o, because stop_o is timing-critical.
      run_q     <= busy_i && (run_q || launch_o);
      begun_q   <= tick;
      updated_q <= {2{busy_i}} & {updated_q[0], launch_o || update_o};
      due_q     <= begun_q && sum[20] && busy_i;
      advance_o <= updated_q[1] && busy_i;
    end
  end

  // No reset: the following registers are set before a motion.
  always_ff @(posedge clk_i) begin
    if (!run_q) {ticks_q, updates_q} <= '0;
    else if (tick) begin
      ticks_q <= wrap ? '0 : ticks_q + 1'b1;
      if (wrap) updates_q <= sample_o ? '0 : updates_q + 1'b1;
    end

    if (!run_q) accu_q <= Rest;
    else if (begun_q || due_q) accu_q <= sum[19:0];

    // V follows VSTART until a motion is accepted, because the start of a motion is timing-critical.
    if (!busy_i) v_o <= 14'(vstart_i);
    else if (update_o || start_v_i) v_o <= next_i;

    if (!busy_i) left_o <= count_i;
    else if (step_o) left_o <= left_o - 1'b1;
    last_q <= left_o == 31'd1;
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) {bump_q, lead_q} <= '0;
    else if (!busy_i) {bump_q, lead_q} <= '0;
    else if (update_o) {bump_q, lead_q} <= {bump_i, lead_i};
  end

  assign bump_o = bump_q & {11{busy_i}};
  assign lead_o = lead_q & {7{busy_i}};

`ifndef SYNTHESIS
  `PPMC_ASSERT(rate_pulse_apart, !(step_o && $past(step_o)))
`endif

endmodule

`default_nettype wire
