// SPDX-License-Identifier: Apache-2.0
// pmc006_motion: executes a motion from its acceptance to its end. Latches the settings, plans the ramps,
//         generates the steps, follows changes of the target speed, and computes the current compensation.
// Rules:  P006-STA-10, P006-CMD-54, P006-MOT-01..05, P006-MOT-10..23, P006-MOT-30/31, P006-MOT-40..42,
//         P006-MOT-50..52, P006-EXC-21..24.
// Timing: motion_o.busy rises at edge s, which ends the cycle of motion_start_i.start or .run. t = 0 is the
//         first µs tick at or after s + 800 cycles. A step that is scheduled at time t is made two cycles
//         after µs tick t. step_o is combinational: it is high in the cycle before the edge at which the
//         step is made.
`include "ppmc_assert.svh"
`default_nettype none

module pmc006_motion
  import pmc006_pkg::*;
  import pmc006_calc_pkg::*;
(
    input  wire logic                  clk_i,
    input  wire logic                  rst_ni,
    input  wire logic                  us_i,            // strobe every microsecond
    input  wire motor_settings_t       settings_i,      // parameter registers
    input  wire logic            [7:0] base_i,          // base code RB; valid one cycle after settings_i
    // accepted instructions
    input  wire motion_start_t         motion_start_i,  // start of a motion
    input  wire logic                  halt_i,          // 1: stop immediately; step_o is low while halt_i = 1
    input  wire sample_t               adc_i,           // sample h of the analog speed input
    output motion_status_t             motion_o,        // state of the motion
    output logic                       step_o,          // 1: a step is made at the next rising edge
    output drive_cmd_t                 drive_cmd_o      // values for the drive
);

  logic start, start_q, t0, update, load_settings, load_base_q, sample, advance, motion_end;
  logic load_v, calc_busy;
  logic short_q, speed_q, stop_q, analog_q, end_run, busy_q, forward_q, steady_q;
  logic [11:0] ve_q;
  logic [ 7:0] base_q;
  logic [2:0] acc_q, dec_q;
  logic [10:0] ccomp_q, scomp_q, current_comp, current_comp_now;
  logic [6:0] lead_angle, lead_angle_now;
  logic [7:0] increment_q;
  logic [13:0] v, next_v, vmax_q;
  logic [30:0] left;
  logic [9:0] adc_q, h_q;
  logic [7:0] mstep;
  phase_e phase;

  assign start = motion_start_i.start || motion_start_i.run;
  // While no motion is in progress, the registers follow the inputs every cycle, because start is
  // timing-critical.
  assign load_settings = !busy_q || t0 || update;
  assign end_run = speed_q && phase == PhEnd && !motion_start_i.speed;
  assign drive_cmd_o = '{
          increment: increment_q,
          current_comp: current_comp_now,
          lead_angle: lead_angle_now
      };
  assign motion_o = '{busy: busy_q, forward: forward_q, steady: steady_q};

  always_comb for (int unsigned i = 0; i < 8; i++) mstep[i] = increment_q[7-i];

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      busy_q    <= 1'b0;
      start_q   <= 1'b0;
      forward_q <= 1'b1;
      adc_q     <= '0;
    end else begin
      start_q <= start;
      if (start) busy_q <= 1'b1;
      else if (motion_end) busy_q <= 1'b0;
      if (start) forward_q <= settings_i.dir;
      if (adc_i.valid) adc_q <= adc_i.level;
    end
  end

  // No reset: these registers are set before a motion begins.
  always_ff @(posedge clk_i) begin
    if (!busy_q || sample) h_q <= adc_q;
    if (!busy_q) begin
      speed_q <= motion_start_i.run;
      short_q <= motion_start_i.start && motion_start_i.count[30:8] == '0;
      ve_q    <= settings_i.vstop;
      acc_q   <= settings_i.acc;
      dec_q   <= settings_i.dec;
      for (int unsigned i = 1; i < 8; i++) increment_q[7-i] <= settings_i.mstep[i];
      increment_q[7] <= settings_i.mstep == '0;
    end
    load_base_q <= load_settings;
    if (load_base_q) base_q <= base_i;
    if (load_settings) begin
      vmax_q   <= settings_i.vmax;
      analog_q <= settings_i.regulate;
      stop_q   <= !motion_start_i.speed;
      ccomp_q  <= settings_i.ccomp;
      scomp_q  <= settings_i.scomp;
      steady_q <= busy_q && phase == PhCruise && next_v != '0;  // at t = 0, next_v is the planned speed
    end
  end

  pmc006_calc u_calc (
      .clk_i,
      .rst_ni,
      .plan_i        (start_q),
      .advance_i     (advance),
      .busy_o        (calc_busy),
      .short_i       (short_q),
      .speed_i       (speed_q),
      .stop_i        (stop_q),
      .analog_i      (analog_q),
      .acc_i         (acc_q),
      .dec_i         (dec_q),
      .v_i           (v),
      .ve_i          (ve_q),
      .left_i        (left),
      .mstep_i       (mstep),
      .vmax_i        (vmax_q),
      .adc_i         (h_q),
      .base_i        (base_q),
      .ccomp_i       (ccomp_q),
      .scomp_i       (scomp_q),
      .phase_o       (phase),
      .next_v_o      (next_v),
      .load_v_o      (load_v),
      .current_comp_o(current_comp),
      .lead_angle_o  (lead_angle)
  );

  pmc006_rate u_rate (
      .clk_i,
      .rst_ni,
      .us_i,
      .count_i       (motion_start_i.count),
      .vstart_i      (settings_i.vstart),
      .endless_i     (speed_q),
      .busy_i        (busy_q),
      .halt_i,
      .end_run_i     (end_run),
      .load_v_i      (load_v),
      .next_v_i      (next_v),
      .current_comp_i(current_comp),
      .lead_angle_i  (lead_angle),
      .t0_o          (t0),
      .update_o      (update),
      .sample_o      (sample),
      .advance_o     (advance),
      .step_o,
      .motion_end_o  (motion_end),
      .v_o           (v),
      .left_o        (left),
      .current_comp_o(current_comp_now),
      .lead_angle_o  (lead_angle_now)
  );

  logic unused_settings;

  assign unused_settings = &{
    1'b0, settings_i.autodec, settings_i.att, settings_i.cur, settings_i.free, settings_i.mstep[0]
  };

`ifndef SYNTHESIS
  `PPMC_ASSERT(motion_start_when_idle, !(start && busy_q))
  `PPMC_ASSERT(motion_planned_in_time, !(t0 && calc_busy))
`endif

endmodule

`default_nettype wire
