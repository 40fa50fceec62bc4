// SPDX-License-Identifier: Apache-2.0
// Written by `make boards` from constraints/colorlight_v70/board.yml and ppmc_bank_carrier.sv; change those, not this.
// board_colorlight_v70_bank: PPMC bank with UART host on Colorlight 5A-75B V7.0 (LFE5U-25F-6BG256C), clk 100 MHz from
//         the 25 MHz oscillator.
// Rules:  pins, LEDs, wiring: docs/boards.md; constraints/colorlight_v70/bank/pins.lpf. All 16 axes have pins for
//         pulse and direction, with 5 V. The limits of axes 0 to 3 have a function only after the exchange of U9;
//         before, they read as 1 (inactive). There are no pins for other switches or for phases. The board has no
//         button and no LED for this project.
// Timing: see ppmc_bank_carrier.
`default_nettype none

module board_colorlight_v70_bank #(
    parameter int unsigned XTAL_HZ    = 16_000_000,
    parameter bit          PHASE_IDLE = 1'b0,        // level of s before the first initialisation
    parameter int unsigned BAUD       = 115_200,     // baud rate of the bridge after reset
    parameter int unsigned RECORD     = 0            // 4 .. 16: 2**RECORD records of the pins; 0: no recorder
) (
    input  wire logic        clk_25m,   // 25 MHz
    // UART host
    input  wire logic        uart_rxd,  // from the PC
    output logic             uart_txd,  // to the PC
    // switches, active low
    input  wire logic [ 3:0] l1_n,
    input  wire logic [ 3:0] l2_n,
    // motors
    output logic      [15:0] pout_n,
    output logic      [15:0] dir,
    // constant
    output logic             phy_rst_n  // reset of the Ethernet chips
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

  ppmc_bank_carrier #(
      .CLK_HZ    (ClkHz),
      .XTAL_HZ   (XTAL_HZ),
      .AXES      (16),
      .PHASE_IDLE(PHASE_IDLE),
      .HOST      ("UART"),
      .BAUD      (BAUD),
      .RECORD    (RECORD)
  ) u_carrier (
      .clk,
      .rst_n,
      .uart_rxd,
      .uart_txd,
      .spi_cs_n(1'b1),
      .sck     (1'b1),
      .mosi    (1'b1),
      .miso_o  (),
      .miso_oe (),
      .int_n   (),
      .l1_n    ({12'b111111111111, l1_n}),
      .l2_n    ({12'b111111111111, l2_n}),
      .l3_n    ('1),
      .l4_n    ('1),
      .cnp_n   ('1),
      .alm_n   ('1),
      .s       (),
      .hold    (),
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
