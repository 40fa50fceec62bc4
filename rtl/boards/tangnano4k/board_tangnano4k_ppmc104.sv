// SPDX-License-Identifier: Apache-2.0
// Written by `make boards` from constraints/tangnano4k/board.yml and ppmc104_carrier.sv; change those, not this.
// board_tangnano4k_ppmc104: PPMC-104 with UART host on Tang Nano 4K (GW1NSR-LV4CQN48PC6/I5), clk 27 MHz from the
//         oscillator.
// Rules:  pins, LEDs, wiring: docs/boards.md; constraints/tangnano4k/ppmc104/pins.cst. Only seven pins of the header
//         have 3.3 V; the UART uses two of them. Phases, HOLD, AUX* and AUXO, the slow-down limits and the alarm have
//         no pins. Limits and alarm without a pin read as 1 (inactive).
// Timing: see ppmc104_carrier.
`default_nettype none

module board_tangnano4k_ppmc104 #(
    parameter int unsigned XTAL_HZ    = 16_000_000,
    parameter              TIMING     = "FAST",
    parameter bit          PHASE_IDLE = 1'b0,        // level of s until the first initialisation
    parameter bit          BRIDGE     = 1'b1,        // 0: character host for small FPGAs, not the UART bridge
    parameter int unsigned BAUD       = 115_200,     // baud rate of the UART host after reset
    parameter int unsigned RECORD     = 0            // 4 .. 16: 2**RECORD records of the pins; 0: no recorder
) (
    input  wire logic clk_27m,   // 27 MHz
    input  wire logic btn_n,     // 0: reset
    // UART host
    input  wire logic uart_rxd,  // from the PC
    output logic      uart_txd,  // to the PC
    // clock selection; with HOST = "UART", strap outputs of the host can also set csel and vsel to 0
    input  wire logic csel,
    input  wire logic vsel,
    // switches, active low
    input  wire logic l1_n,
    input  wire logic l2_n,
    input  wire logic cnp_n,
    // motor
    output logic      pout_n,
    output logic      dir
);

  localparam int unsigned ClkHz = 27_000_000;

  logic rst_n, led_link, led_moving, led_switch, unused;
  logic [3:0] leds;

  ppmc_board_leds #(
      .ClkHz(ClkHz)
  ) u_leds (
      .clk_i   (clk_27m),
      .lock_i  (1'b1),
      .req_ni  (btn_n),
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
      .clk  (clk_27m),
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
      .csel,
      .vsel,
      .clock(1'b1),
      .l1_n,
      .l2_n,
      .l3_n (1'b1),
      .l4_n (1'b1),
      .cnp_n,
      .alm_n(1'b1),
      .auxi ('0),
      .auxo (),
      .aux_n(),
      .s    (),
      .hold (),
      .pout_n,
      .dir,
      .led_link,
      .led_moving,
      .led_switch
  );

  assign unused = ^{leds};

endmodule

`default_nettype wire
