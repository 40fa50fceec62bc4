// SPDX-License-Identifier: Apache-2.0
// ppmc312_motion: controls an operation from its acceptance to the report of its end. Contains the start
//         gate, the pulses, both phases of a zero return, the cause of the end and the status of the
//         device.
// Rules:  P312-MOT-01/06/30/34/35, P312-MOT-40..43, P312-STA-01..04, P312-INP-10/12/20/30/32, P312-OVR-12.
// Timing: t0 is the edge that ends the cycle of motion_req_i.start. If the gate holds the start, t0 is the
//         edge that ends the cycle in which the gate opens. A pin or a stop acts in the cycle in which
//         it is sampled: no pulse begins in this cycle. pout_o and dir_o are registered. counted_o is high in
//         the first cycle after the rise of pout_o.
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
    input  wire logic             clk_i,           // clock
    input  wire logic             rst_ni,          // reset, asynchronous
    // active table
    input  wire table_t           table_i,         // description of the table
    input  wire target_t          start_target_i,  // look-up result for table_i.rate_acc
    output table_addr_t           table_addr_o,    // read port of the table
    input  wire stage_t           stage_i,         // stage at table_addr_o, two cycles later
    // instructions
    input  wire motion_req_t      motion_req_i,    // starts and rate changes
    input  wire logic             change_ramp_i,   // with motion_req_i.change; 1: change along the table
    input  wire logic             halt_i,          // strobe: immediate stop
    input  wire logic             decel_i,         // strobe: decelerate to the end
    input  wire motion_settings_t settings_i,      // high-speed limit, monitoring
    // pins
    input  wire motor_inputs_t    levels_i,        // switches and drive inputs, filtered
    input  wire logic             run_i,           // 0: RUN holds starts
    input  wire logic             extck_i,         // external clock, asynchronous
    output logic                  pout_o,          // 1: a pulse is active
    output logic                  dir_o,           // 0: CW, 1: CCW
    // alarm
    input  wire alarm_event_t     multi_i,         // multiple occurrence
    input  wire logic             abn_end_i,       // strobe: the alarm has been cleared
    output alarm_event_t          alarm_o,         // alarm to be reported
    // state
    output status_e               status_o,        // status of the device
    output logic                  end_wait_o,      // a motion waits for END
    output logic                  output_o,        // 1: pulses are being output
    output logic                  launch_o,        // strobe: t0, a motion starts
    output logic                  output_end_o,    // strobe: pulse output has ended
    output logic                  counted_o,       // strobe: a pulse in direction dir_o
    output logic                  hold_end_o,      // strobe: report E2, a held start is released
    output logic                  stop_o,          // strobe: report E0, a motion has ended
    output end_cause_t            cause_o          // cause of the end; valid with stop_o
);

  typedef enum logic [2:0] {
    StIdle,
    StHold,   // waits for the start gate
    StPulses,
    StLastPulse,  // no further pulse begins; waits for the end of the last pulse
    StWaitEnd     // waits for END
  } state_e;

  state_e state_q;
  operation_t op_q;
  end_cause_t cause_d, cause_q, decel_cause_q, request;
  logic abn_q, enter, abnormal, stop_between, phase2_next_q, phase2_next_d, phase2, wait_pos_q, low_phase2;
  logic immediate, fire, ready, ends, output_end, decel_q, org_q, slow_q, at_origin, slow, gate;
  logic limit, high_limit, origin;
  logic too_fast, fast_q, complete_q;
  // by_…_q: requests that were active when the current decision (next_…) was made
  logic by_slow_q;
  logic [1:0] by_decel_q, by_origin_q;
  logic [5:0] start_delay_q;  // bit 5: the rate of pulse 1 is not valid yet
  logic next_end, next_low, next_count, next_slow, next_final_decel, const_rate, final_decel, first, complete;
  logic [15:0] next_rate, rate;
  profile_t profile;

  // ---- pins ---------------------------------------------------------------------------------------

  logic unused_table;
  assign unused_table = &{1'b0, table_i};

  assign limit = dir_o ? !levels_i.bl_n : !levels_i.fl_n;
  assign high_limit = dir_o ? !levels_i.bhl_n : !levels_i.fhl_n;
  assign origin = !levels_i.org_n && (!op_q.index || !levels_i.index_n);
  assign gate = run_i || settings_i.run_ignored;
  assign enter = (!levels_i.alm_n || multi_i.valid) && !abn_q;
  assign abnormal = enter || abn_q;
  assign alarm_o = '{valid: enter || multi_i.valid, code: multi_i.valid ? multi_i.code : 2'd0};

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) {fast_q, slow_q, complete_q} <= '0;
    else begin
      complete_q <= complete;  // delayed, because the results of position comparisons are also delayed
      fast_q <= rate <= settings_i.limit_rate;
      slow_q <= too_fast;
    end
  end

  assign too_fast = high_limit && fast_q && state_q == StPulses && !start_delay_q[5];

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) {by_slow_q, by_decel_q, by_origin_q, start_delay_q} <= '0;
    else begin
      by_slow_q     <= slow_q;
      by_decel_q    <= {by_decel_q[0], decel_q};
      by_origin_q   <= {by_origin_q[0], at_origin};
      start_delay_q <= launch_o ? '1 : {start_delay_q[4:0], 1'b0};
    end
  end

  // ---- stop and deceleration requests -------------------------------------------------------------

  assign at_origin = org_q || (op_q.zero && origin);  // zero return, phase 1: at the origin
  assign slow = slow_q || decel_q || at_origin;

  always_comb begin
    request     = '0;
    request.als = abnormal;
    request.stl = limit;
    request.org = op_q.origin && origin;
    request.stp = halt_i || (motion_req_i.pos_halt && !complete_q);  // no pos_halt after the last pulse
    immediate   = state_q == StPulses && request != '0;
  end

  assign fire = state_q == StPulses && ready && !next_end && !immediate && !(first && slow);
  assign ends = state_q == StPulses && (immediate || (ready && next_end && !first) || (first && slow));
  // Phase 2 of the zero return follows the deceleration at the origin. It also follows if no deceleration
  // was necessary.
  assign low_phase2 = first ? at_origin && !slow_q && !decel_q :
      by_origin_q[1] && !by_slow_q && !by_decel_q[1];

  always_comb begin
    cause_d = '0;
    phase2_next_d = 1'b0;
    if (complete) cause_d.nos = 1'b1;
    else if (immediate) begin
      if (request.als) cause_d.als = 1'b1;
      else if (request.stl) cause_d.stl = 1'b1;
      else if (request.org) cause_d.org = 1'b1;
      else cause_d.stp = 1'b1;
    end else if (first || next_low) begin
      cause_d.low   = 1'b1;
      phase2_next_d = low_phase2;
    end else begin
      cause_d = decel_cause_q;
      phase2_next_d = decel_cause_q.org;
    end
  end

  assign stop_between = state_q == StLastPulse && phase2_next_q && (halt_i || decel_i);
  assign phase2 = state_q == StLastPulse && phase2_next_q && !pout_o && !enter && !stop_between;
  assign launch_o = (motion_req_i.start && gate) || hold_end_o || phase2;
  // abn_q = 1 if the alarm began in the cycle of motion_req_i.start.
  assign hold_end_o = state_q == StHold && gate && !abnormal;
  assign output_end = state_q == StLastPulse && !phase2_next_q && !pout_o &&
      (!wait_pos_q || motion_req_i.triggers_done || abn_q);
  assign output_end_o = output_end;
  assign stop_o   = (output_end && !(settings_i.end_monitored && levels_i.end_n && !cause_q.als && !abn_q)) ||
      (state_q == StWaitEnd && (!levels_i.end_n || !settings_i.end_monitored || abn_q)) ||
      (state_q == StHold && abnormal);
  assign cause_o = (state_q == StHold) ? '{als: 1'b1, default: 1'b0} : cause_q;
  assign output_o = state_q inside {StPulses, StLastPulse};
  assign end_wait_o = state_q == StWaitEnd;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      state_q       <= StIdle;
      abn_q         <= 1'b0;
      op_q          <= '0;
      dir_o         <= 1'b0;
      cause_q       <= '0;
      decel_cause_q <= '0;
      phase2_next_q <= 1'b0;
      wait_pos_q    <= 1'b0;
      decel_q       <= 1'b0;
      org_q         <= 1'b0;
      counted_o     <= 1'b0;
    end else begin
      counted_o <= fire;
      if (enter) abn_q <= 1'b1;
      else if (abn_end_i) abn_q <= 1'b0;

      unique case (state_q)
        StIdle:  if (motion_req_i.start && !gate) state_q <= StHold;
        StHold:  if (abnormal) state_q <= StIdle;
        StPulses:
        if (ends) begin
          state_q       <= StLastPulse;
          cause_q       <= cause_d;
          phase2_next_q <= phase2_next_d;
          wait_pos_q    <= motion_req_i.pos_halt && !complete;
        end
        StLastPulse: begin
          if (motion_req_i.pos_halt && !complete) wait_pos_q <= 1'b1;
          if (enter && (phase2_next_q || (wait_pos_q && cause_q.stp))) begin
            cause_q <= '{als: 1'b1, default: 1'b0};
            phase2_next_q <= 1'b0;
          end else if (stop_between) begin  // stop between the two phases of a zero return
            cause_q <= '{stp: halt_i, low: !halt_i, default: 1'b0};
            phase2_next_q <= 1'b0;
          end else if (output_end) state_q <= stop_o ? StIdle : StWaitEnd;
        end
        default: if (stop_o) state_q <= StIdle;
      endcase

      if (motion_req_i.start) op_q <= motion_req_i.op;
      if (launch_o) begin
        state_q       <= StPulses;
        dir_o         <= phase2 ? !op_q.ccw : (motion_req_i.start ? motion_req_i.op.ccw : op_q.ccw);
        phase2_next_q <= 1'b0;
        wait_pos_q    <= 1'b0;
        decel_cause_q <= '0;
        decel_q       <= 1'b0;
        org_q         <= 1'b0;
        if (phase2) begin
          op_q.zero   <= 1'b0;
          op_q.origin <= 1'b1;
        end
      end else begin
        // A request is cleared when it has been evaluated at a boundary (end of an interval).
        decel_q <= (decel_i && state_q == StPulses) || (decel_q && !(fire && next_slow && by_decel_q[1]));
        org_q   <= at_origin && !(fire && next_slow && by_origin_q[1]);
        if (fire && next_final_decel)
          decel_cause_q <= '{
              del: by_slow_q,
              dec: !by_slow_q && by_decel_q[1],
              org: !by_slow_q && !by_decel_q[1],
              default: 1'b0
          };
        else if (final_decel && decel_cause_q.org && (slow_q || decel_q))
          decel_cause_q <= '{del: slow_q, dec: !slow_q, default: 1'b0};
      end
    end
  end

  always_comb begin
    unique case (state_q)
      StPulses, StLastPulse: status_o = const_rate ? StatusFix : StatusAcc;
      StHold:                status_o = StatusWrn;
      StWaitEnd:             status_o = StatusFix;
      default:               status_o = table_i.valid ? StatusNor : StatusIni;
    endcase
    if (abn_q) status_o = StatusAbn;
  end

  // ---- pulses -------------------------------------------------------------------------------------

  always_comb begin
    profile = motion_req_i.profile;
    if (phase2) begin
      profile.endless = 1'b1;
      profile.starts_with_accel = 1'b0;
    end
    if (phase2 || motion_req_i.single_pulse) profile.target = start_target_i;
  end

  ppmc312_stage_seq u_seq (
      .clk_i,
      .rst_ni,
      .first_acc_i(table_i.first_acc),
      .first_dec_i(table_i.first_dec),
      .rate_dec_i(table_i.rate_dec),
      .table_addr_o,
      .stage_i,
      .load_i(launch_o),
      .profile_i(profile),
      .single_i(motion_req_i.single_pulse),
      .change_i(motion_req_i.change && state_q == StPulses),
      .change_ramp_i,
      .slow_i((too_fast || decel_q || at_origin) && state_q == StPulses),  // delay from pin: <= 4 cycles
      .next_end_o(next_end),
      .next_low_o(next_low),
      .next_count_o(next_count),
      .next_slow_o(next_slow),
      .next_final_decel_o(next_final_decel),
      .next_rate_o(next_rate),
      .step_i(fire),
      .rate_o(rate),
      .const_rate_o(const_rate),
      .final_decel_o(final_decel),
      .first_o(first),
      .complete_o(complete)
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
      .ready_o(ready),
      .high_o (pout_o)
  );

`ifndef SYNTHESIS
  `PPMC_ASSERT(p312_prt_04, !(fire && immediate))
  `PPMC_ASSERT(p312_mot_35, !stop_o || $onehot(cause_o))
  `PPMC_ASSERT(p312_mot_06, !(ends && next_end && !immediate && !first) || !pout_o)
  `PPMC_ASSERT(p312_blk_01_8, !motion_req_i.start || (state_q == StIdle && !abn_q))
  // Without a pulse, nothing is counted. Between a load and pulse 1, next_count is not valid.
  `PPMC_ASSERT(p312_mot_07_count, !(ends && !immediate && !first && next_count) || complete)
`endif

endmodule

`default_nettype wire
