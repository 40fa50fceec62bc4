// SPDX-License-Identifier: Apache-2.0
// ppmc2104_station: what the tops of all boards share: ppmc2104_carrier with its reset, its lamps, its phase drivers.
// Rules:  lamps, wiring: docs/boards.md.
// Timing: of ppmc2104 and ppmc_board_reset; the inputs need no synchroniser outside.
`default_nettype none

module ppmc2104_station #(
    parameter int unsigned CLK_HZ   = 24_000_000,
    parameter int unsigned XTAL_HZ  = 16_000_000,
    parameter string       TIMING   = "FAST",
    parameter bit          PHASE_ON = 1'b1,        // level of s1, s2 that switches a winding on
    parameter string       HOST     = "UART",      // or "BUS"
    parameter int unsigned BAUD     = 115_200
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
    input  wire logic       busc,
    input  wire logic       ds_wrs_n,
    input  wire logic       rw_rds_n,
    input  wire logic [7:0] d_i,
    output logic      [7:0] d_o,
    output logic            d_oe,      // with the UART host always 0: the part's reads stay inside
    output logic            int_n,
    // straps and external base clocks
    input  wire logic       errint_n,
    input  wire logic [2:1] run,
    input  wire logic [2:1] csel,
    input  wire logic [2:1] extck,
    // switches, 0 = active
    input  wire logic [2:1] fl_n,
    input  wire logic [2:1] bl_n,
    input  wire logic [2:1] fhl_n,
    input  wire logic [2:1] bhl_n,
    input  wire logic [2:1] org_n,
    input  wire logic [2:1] alm_n,
    // auxiliary
    input  wire logic [1:0] auxi,
    output logic      [1:0] auxo,
    output logic            clk_o,
    // motors
    output logic      [5:1] s1,
    output logic      [5:1] s2,
    output logic      [2:1] hold,
    output logic      [2:1] pout_n,
    output logic      [2:1] dir,
    // lamps, 1 = on: out of reset, a switch is active, a motor moves, link
    output logic      [3:0] lamps
);

  logic rst_n, part_oe, link;
  logic [5:1] s1_n, s2_n;

  ppmc_board_panel #(
      .ClkHz(CLK_HZ)
  ) u_panel (
      .clk_i   (clk),
      .lock_i  (lock),
      .req_ni  (req_n),
      .rst_no  (rst_n),
      .link_i  (link),
      .moving_i(hold != '1),
      .switch_i((fl_n & bl_n & fhl_n & bhl_n & alm_n) != '1),
      .lamps_o (lamps)
  );

  ppmc2104_carrier #(
      .CLK_HZ (CLK_HZ),
      .XTAL_HZ(XTAL_HZ),
      .TIMING (TIMING),
      .HOST   (HOST),
      .BAUD   (BAUD)
  ) u_board (
      .clk,
      .rst_n,
      .uart_rxd,
      .uart_txd,
      .cs_n,
      .a0,
      .busc,
      .ds_wrs_n,
      .rw_rds_n,
      .d_i,
      .d_o,
      .d_oe    (part_oe),
      .int_n,
      .errint_n,
      .run,
      .csel,
      .extck,
      .fl_n,
      .bl_n,
      .fhl_n,
      .bhl_n,
      .org_n,
      .alm_n,
      .auxi,
      .auxo,
      .clk_o,
      .s1_n,
      .s2_n,
      .hold,
      .pout_n,
      .dir,
      .led_link(link)
  );

  assign d_oe = HOST == "BUS" && part_oe;
  assign s1   = PHASE_ON ? ~s1_n : s1_n;
  assign s2   = PHASE_ON ? ~s2_n : s2_n;

endmodule

`default_nettype wire
