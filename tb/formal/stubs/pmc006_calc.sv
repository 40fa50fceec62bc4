// SPDX-License-Identifier: Apache-2.0
// pmc006_calc, stub for proofs that hold for any results, which can change in any cycle. A run lasts any time
// up to the bounds of the real block, which tests/pmc006/test_calc_rom.py checks.
`default_nettype none

module pmc006_calc
  import pmc006_calc_pkg::*;
(
    input  wire logic        clk_i,
    input  wire logic        rst_ni,
    input  wire logic        plan_i,
    input  wire logic        advance_i,
    output logic             busy_o,
    input  wire logic        short_i,
    input  wire logic        speed_i,
    input  wire logic        stop_i,
    input  wire logic        analog_i,
    input  wire logic [ 2:0] acc_i,
    input  wire logic [ 2:0] dec_i,
    input  wire logic [13:0] v_i,
    input  wire logic [11:0] ve_i,
    input  wire logic [30:0] left_i,
    input  wire logic [ 7:0] mstep_i,
    input  wire logic [13:0] vmax_i,
    input  wire logic [ 9:0] adc_i,
    input  wire logic [ 7:0] base_i,
    input  wire logic [10:0] ccomp_i,
    input  wire logic [10:0] scomp_i,
    output phase_e           phase_o,
    output logic      [13:0] next_v_o,
    output logic             load_v_o,
    output logic      [10:0] current_comp_o,
    output logic      [ 6:0] lead_angle_o
);

  logic [36:0] any;  // not driven; the registers ensure that all blocks read the same value
  logic [2:0] phase_q;

  logic ends_q;
  logic [9:0] left_q;  // cycles that are left

  assign busy_o  = left_q != '0;
  assign phase_o = phase_e'(phase_q);
  always_ff @(posedge clk_i) {ends_q, phase_q, next_v_o, load_v_o, current_comp_o, lead_angle_o} <= any;

  always_ff @(posedge clk_i or negedge rst_ni)
    if (!rst_ni) left_q <= '0;
    else if (plan_i) left_q <= 10'd785;
    else if (advance_i) left_q <= 10'd590;
    else if (busy_o) left_q <= ends_q ? '0 : left_q - 10'd1;

endmodule

`default_nettype wire
