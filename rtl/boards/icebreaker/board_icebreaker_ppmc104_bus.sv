// SPDX-License-Identifier: Apache-2.0
// board_icebreaker_bus: PPMC-104 with the old chip's bus on an iCEBreaker (iCE40UP5K-SG48), clk 24 MHz.
// Rules:  pins, lamps, wiring: docs/boards.md; constraints/icebreaker-bus.pcf. The three PMODs have 24 pins: S5, HOLD,
//         L3*, L4*, ALM*, CLOCK, AUX* are given up, and so are AUXI, AUXO, CSEL, VSEL.
// Timing: the part's inputs are synchronised inside it.
`default_nettype none

module board_icebreaker_bus #(
    parameter int unsigned XTAL_HZ    = 16_000_000,
    parameter string       TIMING     = "FAST",
    parameter bit          PHASE_IDLE = 1'b0         // 0: for drivers that are on with H, 1: on with L
) (
    input  wire logic       clk_12m,
    input  wire logic       btn_n,       // 0: reset
    // PMOD 1A
    inout  wire logic [7:0] d,
    // PMOD 1B
    input  wire logic       a0,
    input  wire logic       cs_n,
    input  wire logic       rd_n,
    input  wire logic       wr_n,
    output logic            int_n,
    output logic            d_oe,        // direction of a bus transceiver, 1: FPGA to host
    input  wire logic       host_rst_n,
    input  wire logic       cnp_n,
    // PMOD 2
    output logic      [4:1] s,
    output logic            pout_n,
    output logic            dir,
    input  wire logic       l1_n,
    input  wire logic       l2_n,
    // lamps, 0 = on
    output logic            ledg_n,
    output logic            ledr_n
);

  localparam int unsigned ClkHz = 24_000_000;

  logic clk, lock;
  logic moving, link;
  logic [1:0] unused_lamps;
  logic unused_s5;
  logic [7:0] part_d;

  ppmc_clock_icebreaker u_clock (
      .clk_12m_i(clk_12m),
      .clk_o    (clk),
      .lock_o   (lock)
  );

  ppmc104_station #(
      .CLK_HZ    (ClkHz),
      .XTAL_HZ   (XTAL_HZ),
      .TIMING    (TIMING),
      .PHASE_IDLE(PHASE_IDLE),
      .HOST      ("BUS")
  ) u_station (
      .clk,
      .lock,
      .req_n   (btn_n && host_rst_n),
      .uart_rxd(1'b1),
      .uart_txd(),
      .a0,
      .cs_n,
      .rd_n,
      .wr_n,
      .d_i     (d),
      .d_o     (part_d),
      .d_oe,
      .int_n,
      .csel    (1'b1),
      .vsel    (1'b1),
      .clock   (1'b0),
      .l1_n,
      .l2_n,
      .l3_n    (1'b1),
      .l4_n    (1'b1),
      .cnp_n,
      .alm_n   (1'b1),
      .auxi    (4'd0),
      .auxo    (),
      .aux_n   (),
      .s       ({unused_s5, s}),
      .hold    (),
      .pout_n,
      .dir,
      .lamps   ({unused_lamps, moving, link})
  );

  assign d = d_oe ? part_d : 'z;

  assign ledg_n = !link;
  assign ledr_n = !moving;

endmodule

`default_nettype wire
