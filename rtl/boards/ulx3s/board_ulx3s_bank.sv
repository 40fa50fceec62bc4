// SPDX-License-Identifier: Apache-2.0
// Written by `make boards` from constraints/ulx3s/board.yml and ppmc_bank_carrier.sv; change those, not this.
// board_ulx3s_bank: PPMC bank with UART or SPI host on ULX3S v2.0 … v3.0 (LFE5U-25F, -85F, CABGA381), clk 100 MHz
//         from the 25 MHz oscillator.
// Rules:  pins, LEDs, wiring: docs/boards.md; constraints/ulx3s/bank/pins.lpf. 25 of the 32 axes have pins for pulse
//         and direction. No axis has pins for switches or phases. The SPI host is wired to the pins of J1, or it is
//         the ESP32 of the board. The ESP32 calls these pins GPIO26, 25, 33, 35, 34.
// Timing: see ppmc_bank_carrier.
`default_nettype none

module board_ulx3s_bank #(
    parameter int unsigned XTAL_HZ    = 16_000_000,
    parameter bit          PHASE_IDLE = 1'b0,        // level of s before the first initialisation
    parameter              HOST       = "UART",      // or "SPI"
    parameter int unsigned BAUD       = 115_200,     // baud rate of the bridge after reset
    parameter int unsigned RECORD     = 0            // 4 .. 16: 2**RECORD records of the pins; 0: no recorder
) (
    input  wire logic        clk_25m,    // 25 MHz
    input  wire logic        btn_f1,     // 1: reset
    // UART host
    input  wire logic        uart_rxd,   // from the PC
    output logic             uart_txd,   // to the PC
    // SPI host
    input  wire logic        spi_cs_n,
    input  wire logic        sck,
    input  wire logic        mosi,
    output logic             miso,
    output logic             int_n,      // low: at least one axis has a pending interrupt
    // motors
    output logic      [24:0] pout_n,
    output logic      [24:0] dir,
    // LEDs, 1 = on
    output logic      [ 3:0] led,
    // constant
    output logic             wifi_gpio0  // boot pin of the ESP32
);

  localparam int unsigned ClkHz = 100_000_000;

  logic clk, lock, rst_n, led_link, led_moving, led_switch, part_miso, miso_oe, unused;
  logic [ 3:0] leds;
  logic [31:0] part_pout_n;
  logic [31:0] part_dir;

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
      .req_ni  (!btn_f1),
      .rst_no  (rst_n),
      .link_i  (led_link),
      .moving_i(led_moving),
      .switch_i(led_switch),
      .leds_o  (leds)
  );

  ppmc_bank_carrier #(
      .CLK_HZ    (ClkHz),
      .XTAL_HZ   (XTAL_HZ),
      .AXES      (32),
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
      .pout_n(part_pout_n),
      .dir   (part_dir),
      .led_link,
      .led_moving,
      .led_switch
  );

  assign miso       = miso_oe ? part_miso : 'z;
  assign pout_n     = part_pout_n[24:0];
  assign dir        = part_dir[24:0];
  assign led        = leds;

  // A low level would put the ESP32 into its boot loader at its next reset.
  assign wifi_gpio0 = 1'b1;

  assign unused     = ^{part_pout_n[31:25], part_dir[31:25]};

endmodule

`default_nettype wire
