// SPDX-License-Identifier: Apache-2.0
// Written by `make boards` from constraints/colorlight_v70/board.yml and ppmc104_carrier.sv; change those, not this.
// board_colorlight_v70_ppmc104: PPMC-104 with UART host on Colorlight 5A-75B V7.0 (LFE5U-25F-6BG256C), clk 100 MHz
//         from the 25 MHz oscillator.
// Rules:  pins, LEDs, wiring: docs/boards.md; constraints/colorlight_v70/ppmc104/pins.lpf. Outputs have 5 V. Inputs
//         have a function only after the exchange of U9; before, they read as 1 (inactive), so that no limit switch
//         stops the motor. CSEL and VSEL have no pins; the bridge sets them. The board has no button and no LED for
//         this project.
// Timing: see ppmc104_carrier.
`default_nettype none

module board_colorlight_v70_ppmc104 #(
    parameter int unsigned XTAL_HZ    = 16_000_000,
    parameter              TIMING     = "FAST",
    parameter bit          PHASE_IDLE = 1'b0,        // level of s until the first initialisation
    parameter bit          BRIDGE     = 1'b1,        // 0: character host for small FPGAs, not the UART bridge
    parameter int unsigned BAUD       = 115_200,     // baud rate of the UART host after reset
    parameter int unsigned RECORD     = 0            // 4 .. 16: 2**RECORD records of the pins; 0: no recorder
) (
    input  wire logic       clk_25m,   // 25 MHz
    // UART host
    input  wire logic       uart_rxd,  // from the PC
    output logic            uart_txd,  // to the PC
    // clock selection; with HOST = "UART", strap outputs of the host can also set csel and vsel to 0
    input  wire logic       clock,
    // switches, active low
    input  wire logic       l1_n,
    input  wire logic       l2_n,
    input  wire logic       l3_n,
    input  wire logic       l4_n,
    input  wire logic       cnp_n,
    input  wire logic       alm_n,
    // auxiliary
    output logic      [3:0] auxo,
    output logic            aux_n,
    // motor
    output logic      [5:1] s,
    output logic            hold,
    output logic            pout_n,
    output logic            dir,
    // constant
    output logic            phy_rst_n  // reset of the Ethernet chips
);

  localparam int unsigned ClkHz = 100_000_000;

  logic clk, lock, rst_n, led_link, led_moving, led_switch, unused;
  logic [3:0] leds;

  ppmc_clock_ulx3s u_clock (
      .clk_25m_i(clk_25m),
      .clk_o    (clk),
      .lock_o   (lock)
  );

  ppmc_board_leds #(
      .ClkHz(ClkHz)
  ) u_leds (
      .clk_i   (clk),
      .lock_i  (lock),
      .req_ni  (1'b1),
      .rst_no  (rst_n),
      .link_i  (led_link),
      .moving_i(led_moving),
      .switch_i(led_switch),
      .leds_o  (leds)
  );

  ppmc104_carrier #(
      .CLK_HZ    (ClkHz),
      .XTAL_HZ   (XTAL_HZ),
      .TIMING    (TIMING),
      .PHASE_IDLE(PHASE_IDLE),
      .HOST      ("UART"),
      .BRIDGE    (BRIDGE),
      .BAUD      (BAUD),
      .RECORD    (RECORD)
  ) u_carrier (
      .clk,
      .rst_n,
      .uart_rxd,
      .uart_txd,
      .a0   (1'b1),
      .cs_n (1'b1),
      .rd_n (1'b1),
      .wr_n (1'b1),
      .d_i  ('1),
      .d_o  (),
      .d_oe (),
      .int_n(),
      .csel (1'b1),
      .vsel (1'b1),
      .clock,
      .l1_n,
      .l2_n,
      .l3_n,
      .l4_n,
      .cnp_n,
      .alm_n,
      .auxi ('0),
      .auxo,
      .aux_n,
      .s,
      .hold,
      .pout_n,
      .dir,
      .led_link,
      .led_moving,
      .led_switch
  );


  // The oscillator supplies these chips, too. A reset of them could stop the clock.
  assign phy_rst_n = 1'b1;

  assign unused    = ^{leds};

endmodule

`default_nettype wire
