// SPDX-License-Identifier: Apache-2.0
// isa_4axis: four axes on an 8-bit ISA or PC/104 bus. Contains two PPMC-2104 at one base address with one
//         interrupt.
// Rules:  ISA-01..11; all P2104 rules apply to each device. Manual: docs/ppmc2104/isa.md.
// Timing: the bus and motor pins have the timing of ppmc2104. irq follows int_n by one cycle.
// Note:   device A has axes 1 and 2. Device B has axes 3 and 4; its host addresses them as axes 1 and 2.
`default_nettype none

module isa_4axis #(
    parameter int unsigned CLK_HZ    = 16_000_000,  // clock frequency in Hz, 8e6 .. 200e6
    parameter int unsigned XTAL_HZ   = 16_000_000,  // crystal of the old chip in Hz, 1e6 .. 16e6
    parameter              TIMING    = "FAST",      // or "DATASHEET": processing times of the old chip
    parameter int unsigned BASE_ADDR = 'h300        // first address, 000h .. 3F8h, multiple of 8
) (
    input  wire logic       clk,
    input  wire logic       rst_n,      // power-on reset of the board
    // ISA
    input  wire logic       reset_drv,  // reset of the bus, active high
    input  wire logic [9:0] sa,
    input  wire logic       aen,
    input  wire logic       ior_n,
    input  wire logic       iow_n,
    input  wire logic [7:0] sd_i,
    output logic      [7:0] sd_o,
    output logic            sd_oe,
    output logic            irq,        // high: device A or B requests an interrupt
    // both devices
    input  wire logic       errint_n,   // low: an error requests an interrupt, like the end of a motion
    input  wire logic [3:0] auxi,       // [1:0]: device A, [3:2]: device B
    output logic      [3:0] auxo,
    output logic            clk_o,      // 4 MHz output of device A
    // axes
    input  wire logic [4:1] run,        // high: pulses may start
    input  wire logic [4:1] csel,       // internal base clock, high: 500 kHz, low: 125 kHz
    input  wire logic [4:1] extck,      // external base clock, rising edges
    input  wire logic [4:1] fl_n,       // CW limit
    input  wire logic [4:1] bl_n,       // CCW limit
    input  wire logic [4:1] fhl_n,      // CW slow-down limit
    input  wire logic [4:1] bhl_n,      // CCW slow-down limit
    input  wire logic [4:1] org_n,      // origin
    input  wire logic [4:1] alm_n,      // alarm
    output logic      [4:1] pout_n,
    output logic      [4:1] dir,        // 0: CW, 1: CCW
    output logic      [4:1] hold,
    output logic      [5:1] s1_n,       // phases of axis 1, low: energised
    output logic      [5:1] s2_n,
    output logic      [5:1] s3_n,
    output logic      [5:1] s4_n
);

  localparam int unsigned Parts = 2;

  logic rst_both_n, rst_core_n;
  logic a0;
  logic [Parts-1:0] cs_n, d_oe, int_n;
  logic [Parts-1:0][7:0] d;
  logic [3:0][4:0] s_n;  // phases of axes 4 .. 1
  logic unused_clk;

  assign rst_both_n = rst_n && !reset_drv;
  assign {s4_n, s3_n, s2_n, s1_n} = s_n;

  ppmc_reset u_reset (
      .clk_i (clk),
      .rst_ni(rst_both_n),
      .rst_no(rst_core_n)
  );

  ppmc_isa #(
      .Parts (Parts),
      .Source(1'b1),
      .Base  (BASE_ADDR)
  ) u_isa (
      .clk_i  (clk),
      .rst_ni (rst_core_n),
      .sa_i   (sa),
      .aen_i  (aen),
      .ior_ni (ior_n),
      .iow_ni (iow_n),
      .sd_o,
      .sd_oe_o(sd_oe),
      .irq_o  (irq),
      .cs_no  (cs_n),
      .a0_o   (a0),
      .d_i    (d),
      .d_oe_i (d_oe),
      .int_ni (int_n)
  );

  logic [Parts-1:0] clk_4m;

  assign {unused_clk, clk_o} = clk_4m;

  for (genvar p = 0; p < Parts; p++) begin : g_part
    ppmc2104 #(
        .CLK_HZ (CLK_HZ),
        .XTAL_HZ(XTAL_HZ),
        .TIMING (TIMING)
    ) u_part (
        .clk,
        .rst_n   (rst_both_n),
        .cs_n    (cs_n[p]),
        .a0,
        .busc    (1'b0),              // bus style: separate read and write strobes
        .ds_wrs_n(iow_n),
        .rw_rds_n(ior_n),
        .d_i     (sd_i),
        .d_o     (d[p]),
        .d_oe    (d_oe[p]),
        .int_n   (int_n[p]),
        .errint_n,
        .pout_n  (pout_n[2*p+1+:2]),
        .dir     (dir[2*p+1+:2]),
        .hold    (hold[2*p+1+:2]),
        .s1_n    (s_n[2*p]),
        .s2_n    (s_n[2*p+1]),
        .run     (run[2*p+1+:2]),
        .extck   (extck[2*p+1+:2]),
        .csel    (csel[2*p+1+:2]),
        .fl_n    (fl_n[2*p+1+:2]),
        .bl_n    (bl_n[2*p+1+:2]),
        .fhl_n   (fhl_n[2*p+1+:2]),
        .bhl_n   (bhl_n[2*p+1+:2]),
        .org_n   (org_n[2*p+1+:2]),
        .alm_n   (alm_n[2*p+1+:2]),
        .auxi    (auxi[2*p+:2]),
        .auxo    (auxo[2*p+:2]),
        .clk_o   (clk_4m[p])
    );
  end

endmodule

`default_nettype wire
