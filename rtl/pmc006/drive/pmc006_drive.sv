// SPDX-License-Identifier: Apache-2.0
// pmc006_drive: electrical angle, standstill timer, current references and H-bridges of both motor phases.
// Rules:  P006-EXC-01..03, P006-EXC-30..32, P006-STA-12; pmc006_refs and pmc006_hbridge implement other
//         rules.
// Timing: the angle changes at the edge that ends the cycle of step_i. The references follow 25 to 56 cycles
//         later (pmc006_refs). The bridge enables follow boot_i and settings_i.free by one cycle.
`default_nettype none

module pmc006_drive
  import pmc006_pkg::*;
#(
    parameter int unsigned ClkHz    = 16_000_000,
    parameter int unsigned TOffNs   = 20_000,
    parameter int unsigned TBlankNs = 1_000
) (
    input  wire logic                   clk_i,
    input  wire logic                   rst_ni,
    input  wire logic                   us_i,            // strobe every microsecond
    input  wire logic                   boot_i,          // 1: the device is booting, no current
    input  wire motor_settings_t        settings_i,      // parameter registers
    input  wire logic            [ 7:0] base_i,          // base code RB; valid one cycle after settings_i
    // motion
    input  wire logic                   busy_i,          // 1: a motion is in progress
    input  wire logic                   step_i,          // 1: a step is made at the next rising edge
    input  wire logic                   forward_i,       // 1: the step is forward
    input  wire logic            [ 7:0] increment_i,     // angle of a step, 512 per electrical turn
    input  wire logic            [10:0] current_comp_i,  // current compensation B
    input  wire logic            [ 6:0] lead_angle_i,    // lead angle W
    // pins
    input  wire logic                   cmp_a_i,         // comparator of phase A, raw pin
    input  wire logic                   cmp_b_i,         // comparator of phase B, raw pin
    output logic                 [ 7:0] phase_a_ref_o,   // current reference of phase A
    output logic                        phase_a_sign_o,  // sign of phase_a_ref_o
    output logic                 [ 7:0] phase_b_ref_o,   // current reference of phase B
    output logic                        phase_b_sign_o,  // sign of phase_b_ref_o
    output logic                        pwm_a_ref_o,     // bit stream of phase_a_ref_o
    output logic                        pwm_b_ref_o,     // bit stream of phase_b_ref_o
    output logic                        bridge_a_en_o,   // 1: the bridge of phase A is enabled
    output logic                        bridge_b_en_o,   // 1: the bridge of phase B is enabled
    output logic                        m10_o,           // phase A, first half bridge; 1: high side on
    output logic                        m11_o,           // phase A, second half bridge; 1: high side on
    output logic                        m20_o,           // phase B, first half bridge; 1: high side on
    output logic                        m21_o            // phase B, second half bridge; 1: high side on
);

  localparam int unsigned IdleUs = 100_000;
  localparam int unsigned OffCycles = ppmc_pkg::cyc(TOffNs, ClkHz, 1_000_000_000);
  localparam int unsigned BlankCycles = ppmc_pkg::cyc(TBlankNs, ClkHz, 1_000_000_000);
  localparam int unsigned FastCycles = (OffCycles / 2 > BlankCycles) ? OffCycles / 2 : BlankCycles;

  logic [8:0] angle_q;
  logic off, idle;

  assign off = boot_i || settings_i.free;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) angle_q <= 9'd64;
    else if (step_i) angle_q <= forward_i ? angle_q + 9'(increment_i) : angle_q - 9'(increment_i);
  end

  ppmc_hold_timer #(
      .Quanta(IdleUs)
  ) u_idle (
      .clk_i,
      .rst_ni,
      .busy_i   (busy_i || boot_i),
      .quantum_i(us_i),
      .units_i  (1'b0),
      .hold_o   (idle)
  );

  pmc006_refs u_refs (
      .clk_i,
      .rst_ni,
      .off_i   (off),
      .decay_i (idle && !busy_i && settings_i.autodec),
      .att_i   (settings_i.att),
      .base_i,
      .current_comp_i,
      .lead_angle_i,
      .forward_i,
      .angle_i (angle_q),
      .a_ref_o (phase_a_ref_o),
      .a_sign_o(phase_a_sign_o),
      .b_ref_o (phase_b_ref_o),
      .b_sign_o(phase_b_sign_o)
  );

  pmc006_hbridge #(
      .OffCycles  (OffCycles),
      .BlankCycles(BlankCycles),
      .FastCycles (FastCycles)
  ) u_bridge_a (
      .clk_i,
      .rst_ni,
      .on_i   (!off),
      .ref_i  (phase_a_ref_o),
      .sign_i (phase_a_sign_o),
      .cmp_i  (cmp_a_i),
      .pwm_o  (pwm_a_ref_o),
      .en_o   (bridge_a_en_o),
      .high0_o(m10_o),
      .high1_o(m11_o)
  );

  pmc006_hbridge #(
      .OffCycles  (OffCycles),
      .BlankCycles(BlankCycles),
      .FastCycles (FastCycles)
  ) u_bridge_b (
      .clk_i,
      .rst_ni,
      .on_i   (!off),
      .ref_i  (phase_b_ref_o),
      .sign_i (phase_b_sign_o),
      .cmp_i  (cmp_b_i),
      .pwm_o  (pwm_b_ref_o),
      .en_o   (bridge_b_en_o),
      .high0_o(m20_o),
      .high1_o(m21_o)
  );

  logic unused_settings;

  assign unused_settings = &{
    1'b0,
    settings_i.mstep,
    settings_i.cur,
    settings_i.acc,
    settings_i.dec,
    settings_i.vstart,
    settings_i.vstop,
    settings_i.ccomp,
    settings_i.scomp,
    settings_i.vmax,
    settings_i.dir,
    settings_i.regulate
  };

endmodule

`default_nettype wire
