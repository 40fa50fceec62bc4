// SPDX-License-Identifier: Apache-2.0
// Written by `make boards` from constraints/icebreaker/board.yml and ppmc2104_carrier.sv; change those, not this.
// board_icebreaker_ppmc2104: PPMC-2104 with UART host on iCEBreaker (iCE40UP5K-SG48), clk 24 MHz from the 12 MHz
//         oscillator.
// Rules:  pins, LEDs, wiring: docs/boards.md; constraints/icebreaker/ppmc2104/pins.pcf. CSEL, RUN and ERRINT are
//         strap outputs of the bridge; S5 of axis 1, the phases of axis 2, the external base clocks and AUXI have no
//         pins. The break-off section must not be attached.
// Timing: see ppmc2104_carrier.
`default_nettype none

module board_icebreaker_ppmc2104 #(
    parameter int unsigned XTAL_HZ  = 16_000_000,
    parameter              TIMING   = "FAST",
    parameter bit          PHASE_ON = 1'b1,        // level of s1, s2 of an energised winding
    parameter int unsigned BAUD     = 115_200,     // baud rate of the bridge after reset
    parameter int unsigned RECORD   = 0            // 4 .. 16: 2**RECORD records of the pins; 0: no recorder
) (
    input  wire logic       clk_12m,   // 12 MHz
    input  wire logic       btn_n,     // 0: reset
    // UART host
    input  wire logic       uart_rxd,  // from the PC
    output logic            uart_txd,  // to the PC
    // switches, active low
    input  wire logic [2:1] fl_n,
    input  wire logic [2:1] bl_n,
    input  wire logic [2:1] fhl_n,
    input  wire logic [2:1] bhl_n,
    input  wire logic [2:1] org_n,
    input  wire logic [2:1] alm_n,
    // auxiliary
    output logic      [1:0] auxo,
    // motors
    output logic      [4:1] s1,
    output logic      [2:1] hold,
    output logic      [2:1] pout_n,
    output logic      [2:1] dir,
    // LEDs, 0 = on
    output logic            ledg_n,
    output logic            ledr_n
);

  localparam int unsigned ClkHz = 24_000_000;

  logic clk, lock, rst_n, led_link, led_moving, led_switch, unused;
  logic [3:0] leds;
  logic [5:1] part_s1;

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

  ppmc2104_carrier #(
      .CLK_HZ  (ClkHz),
      .XTAL_HZ (XTAL_HZ),
      .TIMING  (TIMING),
      .PHASE_ON(PHASE_ON),
      .HOST    ("UART"),
      .BAUD    (BAUD),
      .RECORD  (RECORD)
  ) u_carrier (
      .clk,
      .rst_n,
      .uart_rxd,
      .uart_txd,
      .cs_n    (1'b1),
      .a0      (1'b1),
      .busc    (1'b0),
      .ds_wrs_n(1'b1),
      .rw_rds_n(1'b1),
      .d_i     ('1),
      .d_o     (),
      .d_oe    (),
      .int_n   (),
      .errint_n(1'b1),
      .run     ('1),
      .csel    ('1),
      .extck   ('0),
      .fl_n,
      .bl_n,
      .fhl_n,
      .bhl_n,
      .org_n,
      .alm_n,
      .auxi    ('0),
      .auxo,
      .clk_o   (),
      .s1      (part_s1),
      .s2      (),
      .hold,
      .pout_n,
      .dir,
      .led_link,
      .led_moving,
      .led_switch
  );

  assign s1     = part_s1[4:1];
  assign ledg_n = ~leds[0];
  assign ledr_n = ~leds[1];

  assign unused = ^{part_s1[5], leds[3:2]};

endmodule

`default_nettype wire
