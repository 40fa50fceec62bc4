// SPDX-License-Identifier: Apache-2.0
// pmc006_motion: a motion from its acceptance to its end: what it keeps of the settings, planning, steps, live
//         target, compensation.
// Rules:  P006-STA-10, P006-CMD-54, P006-MOT-01..05, P006-MOT-10..23, P006-MOT-30/31, P006-MOT-40..42,
//         P006-MOT-50..52, P006-EXC-21..24.
// Timing: busy_o rises at the edge s of start_i or run_i, t = 0 is the first us tick at or after s + 800, a step due
//         at t is made two clk after its us tick. step_o is combinational: high in the clk whose edge makes the
//         step.
`include "ppmc_assert.svh"
`default_nettype none

module pmc006_motion
  import pmc006_pkg::*;
  import pmc006_calc_pkg::*;
(
    input  wire logic             clk_i,
    input  wire logic             rst_ni,
    input  wire logic             us_i,
    input  wire settings_t        settings_i,
    // instructions, already judged
    input  wire logic             start_i,       // s, ROT
    input  wire logic      [30:0] count_i,       // steps, at least 1
    input  wire logic             run_i,         // N = 1 at rest
    input  wire logic             speed_mode_i,  // 0: stop request for a speed run
    input  wire logic             halt_i,        // stop at once; no step in this clk
    input  wire logic      [ 9:0] adc_data_i,
    input  wire logic             adc_valid_i,
    output logic                  busy_o,
    output logic                  step_o,
    output logic                  forward_o,     // of this motion or of the last one
    output logic                  steady_o,      // constant speed, not 0
    output logic           [ 7:0] increment_o,   // angle of a step
    output logic           [10:0] bump_o,        // B
    output logic           [ 6:0] lead_o         // W
);

  logic load, load_q, launch, update, sample, advance, stop, start_v, calc_busy;
  logic short_q, speed_q, stop_q, analog_q, rest, steady_q;
  logic [11:0] ve_q, cur_q;
  logic [2:0] acc_q, dec_q;
  logic [10:0] ccomp_q, scomp_q, bump;
  logic [6:0] lead;
  logic [13:0] v, next, vmax_q;
  logic [30:0] left;
  logic [9:0] adc_q, h_q;
  logic [7:0] mstep;
  phase_e phase;

  assign load = start_i || run_i;
  assign rest = speed_q && phase == PhEnd && !speed_mode_i;
  assign steady_o = steady_q && busy_o;

  always_comb for (int unsigned i = 0; i < 8; i++) mstep[i] = increment_o[7-i];

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      busy_o    <= 1'b0;
      load_q    <= 1'b0;
      forward_o <= 1'b1;
      adc_q     <= '0;
      h_q       <= '0;
    end else begin
      load_q <= load;
      if (load) busy_o <= 1'b1;
      else if (stop) busy_o <= 1'b0;
      if (load) forward_o <= settings_i.dir;
      if (adc_valid_i) adc_q <= adc_data_i;
      if (load || sample) h_q <= adc_q;
    end
  end

  // No reset: an accepted motion sets what follows.
  always_ff @(posedge clk_i) begin
    if (load) begin
      speed_q <= run_i;
      short_q <= start_i && count_i[30:8] == '0;
      ve_q    <= settings_i.vstop;
      acc_q   <= settings_i.acc;
      dec_q   <= settings_i.dec;
      for (int unsigned i = 1; i < 8; i++) increment_o[7-i] <= settings_i.mstep[i];
      increment_o[7] <= settings_i.mstep == '0;
    end
    if (load || launch || update) begin
      vmax_q   <= settings_i.vmax;
      analog_q <= settings_i.regulate;
      stop_q   <= !speed_mode_i;
      cur_q    <= settings_i.cur;
      ccomp_q  <= settings_i.ccomp;
      scomp_q  <= settings_i.scomp;
      steady_q <= !load && phase == PhCruise && next != '0;  // at t = 0 the planning has left V in Vn
    end
  end

  pmc006_calc u_calc (
      .clk_i,
      .rst_ni,
      .plan_i   (load_q),
      .advance_i(advance && busy_o),
      .busy_o   (calc_busy),
      .short_i  (short_q),
      .speed_i  (speed_q),
      .stop_i   (stop_q),
      .analog_i (analog_q),
      .acc_i    (acc_q),
      .dec_i    (dec_q),
      .v_i      (v),
      .ve_i     (ve_q),
      .left_i   (left),
      .mstep_i  (mstep),
      .vmax_i   (vmax_q),
      .adc_i    (h_q),
      .cur_i    (cur_q),
      .ccomp_i  (ccomp_q),
      .scomp_i  (scomp_q),
      .phase_o  (phase),
      .next_o   (next),
      .start_v_o(start_v),
      .bump_o   (bump),
      .lead_o   (lead)
  );

  pmc006_rate u_rate (
      .clk_i,
      .rst_ni,
      .us_i,
      .load_i   (load),
      .count_i,
      .vstart_i (settings_i.vstart),
      .endless_i(speed_q),
      .busy_i   (busy_o),
      .halt_i,
      .rest_i   (rest),
      .start_v_i(start_v),
      .next_i   (next),
      .bump_i   (bump),
      .lead_i   (lead),
      .launch_o (launch),
      .update_o (update),
      .sample_o (sample),
      .advance_o(advance),
      .step_o,
      .stop_o   (stop),
      .v_o      (v),
      .left_o   (left),
      .bump_o,
      .lead_o
  );

  logic unused_settings;

  assign unused_settings = &{1'b0, settings_i.autodec, settings_i.att, settings_i.free, settings_i.mstep[0]};

`ifndef SYNTHESIS
  `PPMC_ASSERT(motion_start_at_rest, !(load && busy_o))
  `PPMC_ASSERT(motion_planned_in_time, !(launch && calc_busy))
`endif

endmodule

`default_nettype wire
