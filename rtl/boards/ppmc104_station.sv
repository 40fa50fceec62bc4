// SPDX-License-Identifier: Apache-2.0
// ppmc104_station: what the tops of all boards share: ppmc104_carrier with its reset and its lamps.
// Rules:  lamps, wiring: docs/boards.md.
// Timing: of ppmc104 and ppmc_board_reset; the inputs need no synchroniser outside.
`default_nettype none

module ppmc104_station #(
    parameter int unsigned CLK_HZ     = 24_000_000,
    parameter int unsigned XTAL_HZ    = 16_000_000,
    parameter string       TIMING     = "FAST",
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
    input  wire logic       a0,
    input  wire logic       cs_n,
    input  wire logic       rd_n,
    input  wire logic       wr_n,
    input  wire logic [7:0] d_i,
    output logic      [7:0] d_o,
    output logic            d_oe,      // with the UART host always 0: the part's reads stay inside
    output logic            int_n,
    // straps and external base clock
    input  wire logic       csel,
    input  wire logic       vsel,
    input  wire logic       clock,
    // switches, 0 = active
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
    // lamps, 1 = on: out of reset, a switch is active, motor moves, link
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
      .switch_i(!(l1_n && l2_n && l3_n && l4_n && alm_n)),
      .lamps_o (lamps)
  );

  ppmc104_carrier #(
      .CLK_HZ    (CLK_HZ),
      .XTAL_HZ   (XTAL_HZ),
      .TIMING    (TIMING),
      .PHASE_IDLE(PHASE_IDLE),
      .HOST      (HOST),
      .BAUD      (BAUD)
  ) u_board (
      .clk,
      .rst_n,
      .uart_rxd,
      .uart_txd,
      .a0,
      .cs_n,
      .rd_n,
      .wr_n,
      .d_i,
      .d_o,
      .d_oe    (part_oe),
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
      .led_link(link)
  );

  assign d_oe = HOST == "BUS" && part_oe;

endmodule

`default_nettype wire
