// SPDX-License-Identifier: Apache-2.0
// board_icebreaker: PPMC-104 with the UART bridge on an iCEBreaker (iCE40UP5K-SG48), clk 24 MHz.
// Rules:  pins, lamps, wiring: docs/boards.md; constraints/icebreaker.pcf. CSEL and VSEL are straps of the bridge.
// Timing: the part's inputs are synchronised inside it.
`default_nettype none

module board_icebreaker #(
    parameter int unsigned XTAL_HZ    = 16_000_000,
    parameter string       TIMING     = "FAST",
    parameter bit          PHASE_IDLE = 1'b0,        // 0: for drivers that are on with H, 1: on with L
    parameter int unsigned BAUD       = 115_200
) (
    input  wire logic       clk_12m,
    input  wire logic       btn_n,     // 0: reset
    input  wire logic       uart_rxd,
    output logic            uart_txd,
    // PMOD 1A: motor
    output logic      [5:1] s,
    output logic            hold,
    output logic            pout_n,
    output logic            dir,
    // PMOD 1B: switches, 0 = active; external base clock
    input  wire logic       l1_n,
    input  wire logic       l2_n,
    input  wire logic       l3_n,
    input  wire logic       l4_n,
    input  wire logic       cnp_n,
    input  wire logic       alm_n,
    input  wire logic       clock,
    output logic            aux_n,
    // PMOD 2: auxiliary
    input  wire logic [3:0] auxi,
    output logic      [3:0] auxo,
    // lamps, 0 = on
    output logic            ledg_n,
    output logic            ledr_n
);

  localparam int unsigned ClkHz = 24_000_000;

  logic clk, lock;
  logic moving, link;
  logic [1:0] unused_lamps;

  ppmc_clock_icebreaker u_clock (
      .clk_12m_i(clk_12m),
      .clk_o    (clk),
      .lock_o   (lock)
  );

  ppmc104_station #(
      .CLK_HZ    (ClkHz),
      .XTAL_HZ   (XTAL_HZ),
      .TIMING    (TIMING),
      .PHASE_IDLE(PHASE_IDLE),
      .HOST      ("UART"),
      .BAUD      (BAUD)
  ) u_station (
      .clk,
      .lock,
      .req_n(btn_n),
      .uart_rxd,
      .uart_txd,
      .a0   (1'b1),
      .cs_n (1'b1),
      .rd_n (1'b1),
      .wr_n (1'b1),
      .d_i  (8'd0),
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
      .lamps   ({unused_lamps, moving, link})
  );

  assign ledg_n = !link;
  assign ledr_n = !moving;

endmodule

`default_nettype wire
