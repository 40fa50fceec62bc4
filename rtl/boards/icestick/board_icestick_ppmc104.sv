// SPDX-License-Identifier: Apache-2.0
// Written by `make boards` from constraints/icestick/board.yml and ppmc104_carrier.sv; change those, not this.
// board_icestick_ppmc104: PPMC-104 with UART host on iCEstick (iCE40HX1K-TQ144), clk 12 MHz from the oscillator.
// Rules:  pins, LEDs, wiring: docs/boards.md; constraints/icestick/ppmc104/pins.pcf. The UART bridge does not fit
//         into this FPGA. The PC executes its scripts (docs/char_host.md). CSEL and VSEL are strap outputs of the
//         host interface. The board has no button.
// Timing: see ppmc104_carrier.
`default_nettype none

module board_icestick_ppmc104 #(
    parameter int unsigned XTAL_HZ    = 16_000_000,
    parameter              TIMING     = "FAST",
    parameter bit          PHASE_IDLE = 1'b0,        // level of s until the first initialisation
    parameter int unsigned BAUD       = 115_200      // baud rate of the UART host after reset
) (
    input  wire logic       clk_12m,   // 12 MHz
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
    input  wire logic [3:0] auxi,
    output logic      [3:0] auxo,
    output logic            aux_n,
    // motor
    output logic      [5:1] s,
    output logic            hold,
    output logic            pout_n,
    output logic            dir,
    // LEDs, 1 = on
    output logic      [2:0] led
);

  localparam int unsigned ClkHz = 12_000_000;

  logic rst_n, led_link, led_moving, led_switch, unused;
  logic [3:0] leds;

  ppmc_board_leds #(
      .ClkHz(ClkHz)
  ) u_leds (
      .clk_i   (clk_12m),
      .lock_i  (1'b1),
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
      .BRIDGE    (0),
      .BAUD      (BAUD)
  ) u_carrier (
      .clk  (clk_12m),
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
      .auxi,
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

  assign led    = {leds[3], leds[2], leds[1]};

  assign unused = ^{leds[0]};

endmodule

`default_nettype wire
