// SPDX-License-Identifier: Apache-2.0
// Written by `make boards` from constraints/tangnano9k/board.yml and ppmc_bank_carrier.sv; change those, not this.
// board_tangnano9k_bank: PPMC bank with UART or SPI host on Tang Nano 9K (GW1NR-LV9QN88PC6/I5), clk 54 MHz from the
//         27 MHz oscillator.
// Rules:  pins, LEDs, wiring: docs/boards.md; constraints/tangnano9k/bank/pins.cst. Pulse and direction of 16 axes
//         use 32 of the 37 pins with 3.3 V, and SPI uses the others. There are no pins for switches or phases. The
//         crystal frequency is 13.5 MHz, so that times are exact. The base clock is 421.875 kHz.
// Timing: see ppmc_bank_carrier.
`default_nettype none

module board_tangnano9k_bank #(
    parameter bit          PHASE_IDLE = 1'b0,     // level of s before the first initialisation
    parameter              HOST       = "UART",   // or "SPI"
    parameter int unsigned BAUD       = 115_200,  // baud rate of the bridge after reset
    parameter int unsigned RECORD     = 0         // 4 .. 16: 2**RECORD records of the pins; 0: no recorder
) (
    input  wire logic        clk_27m,   // 27 MHz
    input  wire logic        btn_n,     // 0: reset
    // UART host
    input  wire logic        uart_rxd,  // from the PC
    output logic             uart_txd,  // to the PC
    // SPI host
    input  wire logic        spi_cs_n,
    input  wire logic        sck,
    input  wire logic        mosi,
    output logic             miso,
    output logic             int_n,     // low: at least one axis has a pending interrupt
    // motors
    output logic      [15:0] pout_n,
    output logic      [15:0] dir,
    // LEDs, 0 = on
    output logic      [ 3:0] led_n
);

  localparam int unsigned ClkHz = 54_000_000;

  logic clk, lock, rst_n, led_link, led_moving, led_switch, part_miso, miso_oe;
  logic [3:0] leds;

  ppmc_clock_tangnano u_clock (
      .clk_27m_i(clk_27m),
      .clk_o    (clk),
      .lock_o   (lock)
  );

  ppmc_board_leds #(
      .ClkHz(ClkHz)
  ) u_leds (
      .clk_i   (clk),
      .lock_i  (lock),
      .req_ni  (btn_n),
      .rst_no  (rst_n),
      .link_i  (led_link),
      .moving_i(led_moving),
      .switch_i(led_switch),
      .leds_o  (leds)
  );

  ppmc_bank_carrier #(
      .CLK_HZ    (ClkHz),
      .XTAL_HZ   (13500000),
      .AXES      (16),
      .PHASE_IDLE(PHASE_IDLE),
      .HOST      (HOST),
      .BAUD      (BAUD),
      .RECORD    (RECORD)
  ) u_carrier (
      .clk,
      .rst_n,
      .uart_rxd,
      .uart_txd,
      .spi_cs_n,
      .sck,
      .mosi,
      .miso_o(part_miso),
      .miso_oe,
      .int_n,
      .l1_n  ('1),
      .l2_n  ('1),
      .l3_n  ('1),
      .l4_n  ('1),
      .cnp_n ('1),
      .alm_n ('1),
      .s     (),
      .hold  (),
      .pout_n,
      .dir,
      .led_link,
      .led_moving,
      .led_switch
  );

  assign miso  = miso_oe ? part_miso : 'z;
  assign led_n = ~leds;

endmodule

`default_nettype wire
