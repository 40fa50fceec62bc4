// SPDX-License-Identifier: Apache-2.0
// ppmc312_motion: controls an operation from its acceptance to the report of its end: statuses, start gate,
//         pulses, causes, both phases of a zero return.
// Rules:  P312-MOT-01/06/30/34/35, P312-MOT-40..43, P312-STA-01..04, P312-INP-10/12/20/30/32, P312-OVR-12.
// Timing: t0 is the edge that ends the cycle of order_i.start, or of the end of the start gate. Pins and
//         stops act in the cycle in which they are sampled: no pulse begins in this cycle. pout_o and dir_o
//         are registered; counted_o is high in the first cycle after the rise of pout_o.
`include "ppmc_assert.svh"
`default_nettype none

module ppmc312_motion
  import ppmc312_pkg::*;
  import ppmc312_link_pkg::*;
  import ppmc312_stage_pkg::*;
#(
    parameter int unsigned ClkHz  = 16_000_000,
    parameter int unsigned XtalHz = 16_000_000
) (
    input  wire logic          clk_i,          // clock
    input  wire logic          rst_ni,         // reset, asynchronous
    // active table
    input  wire table_t        table_i,        // description of the table
    input  wire target_t       home_i,         // look-up result of table_i.rate_acc
    output look_t              look_o,         // read port of the table
    input  wire stage_t        stage_i,        // stage at look_o, two cycles later
    // instructions
    input  wire motion_order_t order_i,        // starts and rate changes
    input  wire logic          change_ramp_i,  // with order_i.change: change along the table
    input  wire logic          halt_i,         // strobe: immediate stop
    input  wire logic          decel_i,        // strobe: decelerate to the end
    input  wire settings_t     settings_i,     // high-speed limit, monitoring
    // pins
    input  wire levels_t       levels_i,       // switches and drive inputs, filtered
    input  wire logic          run_i,          // 1: starts are not held
    input  wire logic          extck_i,        // external clock, asynchronous
    output logic               pout_o,         // 1: a pulse is active
    output logic               dir_o,          // 0: CW, 1: CCW
    // alarm
    input  wire alarm_t        multi_i,        // multiple occurrence
    input  wire logic          leave_i,        // strobe: alarm clear, and no alarm is active
    output alarm_t             alarm_o,        // alarm to be reported
    // state
    output status_e            status_o,       // status of the device
    output logic               end_wait_o,     // a motion waits for END
    output logic               output_o,       // 1: pulses are being output
    output logic               launch_o,       // strobe: t0
    output logic               rested_o,       // strobe: pulse output has ended
    output logic               counted_o,      // strobe: a pulse in direction dir_o
    output logic               held_o,         // strobe: report E2
    output logic               stop_o,         // strobe: report E0
    output cause_t             cause_o         // cause of the end; valid with stop_o
);

  typedef enum logic [2:0] {
    StRest,
    StHeld,   // start gate
    StGo,
    StDrain,  // no further pulses; the last one runs out
    StEnd     // waits for END
  } state_e;

  state_e state_q;
  op_t op_q;
  cause_t cause_d, cause_q, walk_q, request;
  logic abn_q, enter, stay, turn_q, turn_d, phase2, wait_pos_q, low_turn;
  logic hard, fire, due, ends, rest, decel_q, org_q, slow_q, near, slow, gate;
  logic limit, high_limit, origin;
  logic too_fast, fast_q, complete_q;
  // why_…_q: requests that led to the decision in next_*
  logic why_slow_q;
  logic [1:0] why_decel_q, why_near_q;
  logic [5:0] young_q;  // bit 5: the rate of pulse 1 is not valid yet
  logic next_end, next_low, next_count, next_slow, next_walk, flat, walking, first, complete;
  logic [15:0] next_rate, rate;
  plan_t plan;

  // ---- pins ---------------------------------------------------------------------------------------

  logic  unused_table;
  assign unused_table = &{1'b0, table_i};

  assign limit = dir_o ? !levels_i.bl_n : !levels_i.fl_n;
  assign high_limit = dir_o ? !levels_i.bhl_n : !levels_i.fhl_n;
  assign origin = !levels_i.org_n && (!op_q.index || !levels_i.index_n);
  assign gate = run_i || settings_i.ungated;
  assign enter = (!levels_i.alm_n || multi_i.valid) && !abn_q;
  assign alarm_o = '{valid: enter || multi_i.valid, code: multi_i.valid ? multi_i.code : 2'd0};

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) {fast_q, slow_q, complete_q} <= '0;
    else begin
      complete_q <= complete;  // delayed, because position comparisons are later
      fast_q <= rate <= settings_i.limit_rate;
      slow_q <= too_fast;
    end
  end

  assign too_fast = high_limit && fast_q && state_q == StGo && !young_q[5];

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) {why_slow_q, why_decel_q, why_near_q, young_q} <= '0;
    else begin
      why_slow_q  <= slow_q;
      why_decel_q <= {why_decel_q[0], decel_q};
      why_near_q  <= {why_near_q[0], near};
      young_q     <= launch_o ? '1 : {young_q[4:0], 1'b0};
    end
  end

  // ---- stop and deceleration requests -------------------------------------------------------------

  assign near = org_q || (op_q.zero && origin);  // zero return, phase 1
  assign slow = slow_q || decel_q || near;

  always_comb begin
    request     = '0;
    request.als = enter || abn_q;
    request.stl = limit;
    request.org = op_q.origin && origin;
    request.stp = halt_i || (order_i.pos_halt && !complete_q);  // the last pulse needs no stop
    hard        = state_q == StGo && request != '0;
  end

  assign fire = state_q == StGo && due && !next_end && !hard && !(first && slow);
  assign ends = state_q == StGo && (hard || (due && next_end && !first) || (first && slow));
  // After the deceleration at the origin, or if no deceleration was necessary, phase 2 of the zero return
  // follows.
  assign low_turn = first ? near && !slow_q && !decel_q : why_near_q[1] && !why_slow_q && !why_decel_q[1];

  always_comb begin
    cause_d = '0;
    turn_d  = 1'b0;
    if (complete) cause_d.nos = 1'b1;
    else if (hard) begin
      if (request.als) cause_d.als = 1'b1;
      else if (request.stl) cause_d.stl = 1'b1;
      else if (request.org) cause_d.org = 1'b1;
      else cause_d.stp = 1'b1;
    end else if (first || next_low) begin
      cause_d.low = 1'b1;
      turn_d      = low_turn;
    end else begin
      cause_d = walk_q;
      turn_d  = walk_q.org;
    end
  end

  assign stay = state_q == StDrain && turn_q && (halt_i || decel_i);
  assign phase2 = state_q == StDrain && turn_q && !pout_o && !enter && !stay;
  assign launch_o = (order_i.start && gate) || (state_q == StHeld && gate && !enter) || phase2;
  assign held_o = state_q == StHeld && gate && !enter;
  assign rest = state_q == StDrain && !turn_q && !pout_o && (!wait_pos_q || order_i.settled || abn_q);
  assign rested_o = rest;
  assign stop_o   = (rest && !(settings_i.end_watch && levels_i.end_n && !cause_q.als && !abn_q)) ||
      (state_q == StEnd && (!levels_i.end_n || !settings_i.end_watch || abn_q)) ||
      (state_q == StHeld && enter);
  assign cause_o = (state_q == StHeld) ? '{als: 1'b1, default: 1'b0} : cause_q;
  assign output_o = state_q inside {StGo, StDrain};
  assign end_wait_o = state_q == StEnd;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      state_q    <= StRest;
      abn_q      <= 1'b0;
      op_q       <= '0;
      dir_o      <= 1'b0;
      cause_q    <= '0;
      walk_q     <= '0;
      turn_q     <= 1'b0;
      wait_pos_q <= 1'b0;
      decel_q    <= 1'b0;
      org_q      <= 1'b0;
      counted_o  <= 1'b0;
    end else begin
      counted_o <= fire;
      if (enter) abn_q <= 1'b1;
      else if (leave_i) abn_q <= 1'b0;

      unique case (state_q)
        StRest:  if (order_i.start && !gate) state_q <= StHeld;
        StHeld:  if (enter) state_q <= StRest;
        StGo:
        if (ends) begin
          state_q    <= StDrain;
          cause_q    <= cause_d;
          turn_q     <= turn_d;
          wait_pos_q <= order_i.pos_halt && !complete;
        end
        StDrain: begin
          if (order_i.pos_halt && !complete) wait_pos_q <= 1'b1;
          if (enter && (turn_q || (wait_pos_q && cause_q.stp))) begin
            cause_q <= '{als: 1'b1, default: 1'b0};
            turn_q  <= 1'b0;
          end else if (stay) begin  // a stop between the two phases
            cause_q <= '{stp: halt_i, low: !halt_i, default: 1'b0};
            turn_q  <= 1'b0;
          end else if (rest) state_q <= stop_o ? StRest : StEnd;
        end
        default: if (stop_o) state_q <= StRest;
      endcase

      if (order_i.start) op_q <= order_i.op;
      if (launch_o) begin
        state_q    <= StGo;
        dir_o      <= phase2 ? !op_q.ccw : (order_i.start ? order_i.op.ccw : op_q.ccw);
        turn_q     <= 1'b0;
        wait_pos_q <= 1'b0;
        walk_q     <= '0;
        decel_q    <= 1'b0;
        org_q      <= 1'b0;
        if (phase2) begin
          op_q.zero   <= 1'b0;
          op_q.origin <= 1'b1;
        end
      end else begin
        // Requests that have been evaluated at a boundary are cleared.
        decel_q <= (decel_i && state_q == StGo) || (decel_q && !(fire && next_slow && why_decel_q[1]));
        org_q   <= near && !(fire && next_slow && why_near_q[1]);
        if (fire && next_walk)
          walk_q <= '{
              del: why_slow_q,
              dec: !why_slow_q && why_decel_q[1],
              org: !why_slow_q && !why_decel_q[1],
              default: 1'b0
          };
        else if (walking && walk_q.org && (slow_q || decel_q))
          walk_q <= '{del: slow_q, dec: !slow_q, default: 1'b0};
      end
    end
  end

  always_comb begin
    unique case (state_q)
      StGo, StDrain: status_o = flat ? StatusFix : StatusAcc;
      StHeld:        status_o = StatusWrn;
      StEnd:         status_o = StatusFix;
      default:       status_o = table_i.valid ? StatusNor : StatusIni;
    endcase
    if (abn_q) status_o = StatusAbn;
  end

  // ---- pulses -------------------------------------------------------------------------------------

  always_comb begin
    plan = order_i.plan;
    if (phase2) begin
      plan.endless = 1'b1;
      plan.climb   = 1'b0;
    end
    if (phase2 || order_i.home) plan.to = home_i;
  end

  ppmc312_stage_seq u_seq (
      .clk_i,
      .rst_ni,
      .first_acc_i (table_i.first_acc),
      .first_dec_i (table_i.first_dec),
      .rate_dec_i  (table_i.rate_dec),
      .look_o,
      .stage_i,
      .load_i      (launch_o),
      .plan_i      (plan),
      .single_i    (order_i.home),
      .change_i    (order_i.change && state_q == StGo),
      .change_ramp_i,
      .slow_i      ((too_fast || decel_q || near) && state_q == StGo),  // at most 4 cycles after the pin
      .next_end_o  (next_end),
      .next_low_o  (next_low),
      .next_count_o(next_count),
      .next_slow_o (next_slow),
      .next_walk_o (next_walk),
      .next_rate_o (next_rate),
      .step_i      (fire),
      .rate_o      (rate),
      .flat_o      (flat),
      .walk_o      (walking),
      .first_o     (first),
      .complete_o  (complete)
  );

  ppmc312_interval #(
      .ClkHz    (ClkHz),
      .XtalHz   (XtalHz),
      .RateBits (RATE_BITS),
      .WidthXtal(WIDTH_XTAL)
  ) u_interval (
      .clk_i,
      .rst_ni,
      .base_i (table_i.base),
      .extck_i,
      .arm_i  (launch_o),
      .first_i(first),
      .fire_i (fire),
      .rate_i (next_rate),
      .due_o  (due),
      .high_o (pout_o)
  );

`ifndef SYNTHESIS
  `PPMC_ASSERT(p312_prt_04, !(fire && hard))
  `PPMC_ASSERT(p312_mot_35, !stop_o || $onehot(cause_o))
  `PPMC_ASSERT(p312_mot_06, !(ends && next_end && !hard && !first) || !pout_o)
  `PPMC_ASSERT(p312_blk_01_8, !order_i.start || (state_q == StRest && !abn_q))
  // Without a pulse nothing is counted; after a load next_count is not valid yet.
  `PPMC_ASSERT(p312_mot_07_count, !(ends && !hard && !first && next_count) || complete)
`endif

endmodule

`default_nettype wire
