// SPDX-License-Identifier: Apache-2.0
// board_icebreaker_ppmc2104: PPMC-2104 with the UART bridge on an iCEBreaker (iCE40UP5K-SG48), clk 24 MHz.
// Rules:  pins, lamps, wiring: docs/boards.md; constraints/icebreaker-ppmc2104.pcf. CSEL, RUN and ERRINT are straps
//         of the bridge; the phases of axis 2, the external base clocks and AUXI have no pins.
// Timing: the part's inputs are synchronised inside it.
`default_nettype none

module board_icebreaker_ppmc2104 #(
    parameter int unsigned XTAL_HZ  = 16_000_000,
    parameter string       TIMING   = "FAST",
    parameter bit          PHASE_ON = 1'b1,        // level of s1 that switches a winding on
    parameter int unsigned BAUD     = 115_200
) (
    input  wire logic       clk_12m,
    input  wire logic       btn_n,     // 0: reset
    input  wire logic       uart_rxd,
    output logic            uart_txd,
    // PMOD 1A: motors
    output logic      [2:1] pout_n,
    output logic      [2:1] dir,
    output logic      [4:1] s1,
    // PMOD 1B: axis 1, PMOD 2: axis 2; switches, 0 = active
    input  wire logic [2:1] fl_n,
    input  wire logic [2:1] bl_n,
    input  wire logic [2:1] fhl_n,
    input  wire logic [2:1] bhl_n,
    input  wire logic [2:1] org_n,
    input  wire logic [2:1] alm_n,
    output logic      [2:1] hold,
    output logic      [1:0] auxo,
    // lamps, 0 = on
    output logic            ledg_n,
    output logic            ledr_n
);

  localparam int unsigned ClkHz = 24_000_000;

  logic clk, lock;
  logic moving, link, unused_s5;
  logic [1:0] unused_lamps;

  ppmc_clock_icebreaker u_clock (
      .clk_12m_i(clk_12m),
      .clk_o    (clk),
      .lock_o   (lock)
  );

  ppmc2104_station #(
      .CLK_HZ  (ClkHz),
      .XTAL_HZ (XTAL_HZ),
      .TIMING  (TIMING),
      .PHASE_ON(PHASE_ON),
      .HOST    ("UART"),
      .BAUD    (BAUD)
  ) u_station (
      .clk,
      .lock,
      .req_n   (btn_n),
      .uart_rxd,
      .uart_txd,
      .cs_n    (1'b1),
      .a0      (1'b1),
      .busc    (1'b0),
      .ds_wrs_n(1'b1),
      .rw_rds_n(1'b1),
      .d_i     (8'd0),
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
      .s1      ({unused_s5, s1}),
      .s2      (),
      .hold,
      .pout_n,
      .dir,
      .lamps   ({unused_lamps, moving, link})
  );

  assign ledg_n = !link;
  assign ledr_n = !moving;

endmodule

`default_nettype wire
