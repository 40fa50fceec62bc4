// SPDX-License-Identifier: Apache-2.0
// Written by `make boards` from constraints/arty_a7/board.yml and ppmc104_carrier.sv; change those, not this.
// board_arty_a7_ppmc104: PPMC-104 with UART or bus host on Arty A7-35T, -100T (XC7A35T, XC7A100T), clk 100 MHz from
//         the oscillator.
// Rules:  pins, LEDs, wiring: docs/boards.md; constraints/arty_a7/ppmc104/pins.xdc. Use Vivado. This project has
//         linted this board, but not built or run it.
// Timing: see ppmc104_carrier.
`default_nettype none

module board_arty_a7_ppmc104 #(
    parameter int unsigned XTAL_HZ    = 16_000_000,
    parameter              TIMING     = "FAST",
    parameter bit          PHASE_IDLE = 1'b0,        // level of s until the first initialisation
    parameter              HOST       = "UART",      // or "BUS"
    parameter bit          BRIDGE     = 1'b1,        // 0: character host for small FPGAs, not the UART bridge
    parameter int unsigned BAUD       = 115_200,     // baud rate of the UART host after reset
    parameter int unsigned RECORD     = 0            // 4 .. 16: 2**RECORD records of the pins; 0: no recorder
) (
    input  wire logic       clk,         // 100 MHz
    input  wire logic       ck_rst_n,    // 0: reset
    input  wire logic       host_rst_n,  // 0: reset, from the host
    // UART host
    input  wire logic       uart_rxd,    // from the PC
    output logic            uart_txd,    // to the PC
    // bus host; with HOST = "UART", d_oe = 0, because reads then remain inside the FPGA
    input  wire logic       a0,
    input  wire logic       cs_n,
    input  wire logic       rd_n,
    input  wire logic       wr_n,
    inout  wire logic [7:0] d,
    output logic            d_oe,        // direction of a bus transceiver, 1: FPGA to host
    output logic            int_n,
    // clock selection; with HOST = "UART", strap outputs of the host can also set csel and vsel to 0
    input  wire logic       csel,
    input  wire logic       vsel,
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
    output logic      [3:0] led
);

  localparam int unsigned ClkHz = 100_000_000;

  logic rst_n, led_link, led_moving, led_switch;
  logic [3:0] leds;
  logic [7:0] part_d;

  ppmc_board_leds #(
      .ClkHz(ClkHz)
  ) u_leds (
      .clk_i   (clk),
      .lock_i  (1'b1),
      .req_ni  (ck_rst_n && host_rst_n),
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
      .HOST      (HOST),
      .BRIDGE    (BRIDGE),
      .BAUD      (BAUD),
      .RECORD    (RECORD)
  ) u_carrier (
      .clk,
      .rst_n,
      .uart_rxd,
      .uart_txd,
      .a0,
      .cs_n,
      .rd_n,
      .wr_n,
      .d_i(d),
      .d_o(part_d),
      .d_oe,
      .int_n,
      .csel,
      .vsel,
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

  assign d   = d_oe ? part_d : 'z;
  assign led = leds;

endmodule

`default_nettype wire
