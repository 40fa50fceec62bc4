// SPDX-License-Identifier: Apache-2.0
// Written by `make boards` from constraints/icebreaker/board.yml and ppmc104_carrier.sv; change those, not this.
// board_icebreaker_ppmc104_bus: PPMC-104 with bus host on iCEBreaker (iCE40UP5K-SG48), clk 24 MHz from the 12 MHz
//         oscillator.
// Rules:  pins, LEDs, wiring: docs/boards.md; constraints/icebreaker/ppmc104-bus/pins.pcf. The three PMODs have 24
//         pins, so S5, HOLD, L3*, L4*, ALM*, CLOCK, AUX*, AUXI, AUXO, CSEL and VSEL have no pins. The break-off
//         section must not be connected to PMOD 2: its buttons would act as limit switches.
// Timing: see ppmc104_carrier.
`default_nettype none

module board_icebreaker_ppmc104_bus #(
    parameter int unsigned XTAL_HZ    = 16_000_000,
    parameter              TIMING     = "FAST",
    parameter bit          PHASE_IDLE = 1'b0,        // level of s until the first initialisation
    parameter bit          BRIDGE     = 1'b1         // 0: character host for small FPGAs, not the UART bridge
) (
    input  wire logic       clk_12m,     // 12 MHz
    input  wire logic       btn_n,       // 0: reset
    input  wire logic       host_rst_n,  // 0: reset, from the host
    // bus host; with HOST = "UART", d_oe = 0, because reads then remain inside the FPGA
    input  wire logic       a0,
    input  wire logic       cs_n,
    input  wire logic       rd_n,
    input  wire logic       wr_n,
    inout  wire logic [7:0] d,
    output logic            d_oe,        // direction of a bus transceiver, 1: FPGA to host
    output logic            int_n,
    // switches, active low
    input  wire logic       l1_n,
    input  wire logic       l2_n,
    input  wire logic       cnp_n,
    // motor
    output logic      [4:1] s,
    output logic            pout_n,
    output logic            dir,
    // LEDs, 0 = on
    output logic            ledg_n,
    output logic            ledr_n
);

  localparam int unsigned ClkHz = 24_000_000;

  logic clk, lock, rst_n, led_link, led_moving, led_switch, unused;
  logic [3:0] leds;
  logic [7:0] part_d;
  logic [5:1] part_s;

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
      .req_ni  (btn_n && host_rst_n),
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
      .HOST      ("BUS"),
      .BRIDGE    (BRIDGE)
  ) u_carrier (
      .clk,
      .rst_n,
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
      .auxi    ('0),
      .auxo    (),
      .aux_n   (),
      .s       (part_s),
      .hold    (),
      .pout_n,
      .dir,
      .led_link,
      .led_moving,
      .led_switch
  );

  assign d      = d_oe ? part_d : 'z;
  assign s      = part_s[4:1];
  assign ledg_n = ~leds[0];
  assign ledr_n = ~leds[1];

  assign unused = ^{part_s[5], leds[3:2]};

endmodule

`default_nettype wire
