// SPDX-License-Identifier: Apache-2.0
// Written by `make boards` from constraints/icebreaker/board.yml and ppmc_bank_carrier.sv; change those, not this.
// board_icebreaker_bank: PPMC bank with UART host on iCEBreaker (iCE40UP5K-SG48), clk 24 MHz from the 12 MHz
//         oscillator.
// Rules:  pins, LEDs, wiring: docs/boards.md; constraints/icebreaker/bank/pins.pcf. The 24 pins are pulse, direction
//         and CCW limit of 8 axes. An axis without an origin switch uses the CCW limit as its origin. The break-off
//         section must not be attached.
// Timing: see ppmc_bank_carrier.
`default_nettype none

module board_icebreaker_bank #(
    parameter int unsigned XTAL_HZ    = 16_000_000,
    parameter bit          PHASE_IDLE = 1'b0,        // level of s before the first initialisation
    parameter int unsigned BAUD       = 115_200,     // baud rate of the bridge after reset
    parameter int unsigned RECORD     = 0            // 4 .. 16: 2**RECORD records of the pins; 0: no recorder
) (
    input  wire logic       clk_12m,   // 12 MHz
    input  wire logic       btn_n,     // 0: reset
    // UART host
    input  wire logic       uart_rxd,  // from the PC
    output logic            uart_txd,  // to the PC
    // switches, active low
    input  wire logic [7:0] l2_n,
    // motors
    output logic      [7:0] pout_n,
    output logic      [7:0] dir,
    // LEDs, 0 = on
    output logic            ledg_n,
    output logic            ledr_n
);

  localparam int unsigned ClkHz = 24_000_000;

  logic clk, lock, rst_n, led_link, led_moving, led_switch, unused;
  logic [3:0] leds;

  ppmc_clock_icebreaker u_clock (
      .clk_12m_i(clk_12m),
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
      .XTAL_HZ   (XTAL_HZ),
      .AXES      (8),
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
      .l1_n    ('1),
      .l2_n,
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

  assign ledg_n = ~leds[0];
  assign ledr_n = ~leds[1];

  assign unused = ^{leds[3:2]};

endmodule

`default_nettype wire
