// SPDX-License-Identifier: Apache-2.0
// stmc_station: what the tops of all boards share: stmc_carrier with its reset and its lamps.
// Rules:  lamps, wiring: docs/boards.md.
// Timing: of stmc and ppmc_board_reset; the inputs need no synchroniser outside.
`default_nettype none

module stmc_station #(
    parameter int unsigned CLK_HZ     = 24_000_000,
    parameter int unsigned XTAL_HZ    = 16_000_000,
    parameter string       TIMING     = "FAST",
    parameter string       READ_MAP   = "SHEET",     // or "FAMILY"
    parameter bit          PHASE_IDLE = 1'b0,
    parameter string       HOST       = "UART",      // or "BUS"
    parameter int unsigned BAUD       = 115_200
) (
    input  wire logic       clk,
    input  wire logic       lock,      // 1: clk is good; 1 without a PLL
    input  wire logic       req_n,     // 0: reset wanted
    // UART host
    input  wire logic       uart_rxd,
    output logic            uart_txd,
    // bus host
    input  wire logic       cs_n,
    input  wire logic       a0,
    input  wire logic       rd_n,
    input  wire logic       wr_n,
    input  wire logic [7:0] d_i,
    output logic      [7:0] d_o,
    output logic            d_oe,      // with the UART host always 0: the part's reads stay inside
    output logic            int_n,
    // switches, 0 = active
    input  wire logic       l1_n,
    input  wire logic       l2_n,
    input  wire logic       l3_n,
    input  wire logic       l4_n,
    input  wire logic       cnp_n,
    input  wire logic       mon,       // 1 = the motor may run
    // motor
    output logic      [5:1] s,
    output logic            hold,
    // lamps, 1 = on: out of reset, a switch is active or MON is low, motor moves, link
    output logic      [3:0] lamps
);

  logic rst_n, part_oe, link;

  ppmc_board_panel #(
      .ClkHz(CLK_HZ)
  ) u_panel (
      .clk_i   (clk),
      .lock_i  (lock),
      .req_ni  (req_n),
      .rst_no  (rst_n),
      .link_i  (link),
      .moving_i(!hold),
      .switch_i(!(l1_n && l2_n && l3_n && l4_n && mon)),
      .lamps_o (lamps)
  );

  stmc_carrier #(
      .CLK_HZ    (CLK_HZ),
      .XTAL_HZ   (XTAL_HZ),
      .TIMING    (TIMING),
      .READ_MAP  (READ_MAP),
      .PHASE_IDLE(PHASE_IDLE),
      .HOST      (HOST),
      .BAUD      (BAUD)
  ) u_board (
      .clk,
      .rst_n,
      .uart_rxd,
      .uart_txd,
      .cs_n,
      .a0,
      .rd_n,
      .wr_n,
      .d_i,
      .d_o,
      .d_oe    (part_oe),
      .int_n,
      .l1_n,
      .l2_n,
      .l3_n,
      .l4_n,
      .cnp_n,
      .mon,
      .s,
      .hold,
      .led_link(link)
  );

  assign d_oe = HOST == "BUS" && part_oe;

endmodule

`default_nettype wire
