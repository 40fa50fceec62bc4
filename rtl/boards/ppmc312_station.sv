// SPDX-License-Identifier: Apache-2.0
// ppmc312_station: what the tops of all boards share: ppmc312_carrier with its reset and its lamps.
// Rules:  lamps, wiring: docs/boards.md.
// Timing: of ppmc312 and ppmc_board_reset; the inputs need no synchroniser outside.
`default_nettype none

module ppmc312_station #(
    parameter int unsigned CLK_HZ   = 24_000_000,
    parameter int unsigned XTAL_HZ  = 16_000_000,
    parameter string       TIMING   = "FAST",
    parameter string       SUM_MODE = "BINARY",    // or "CHARS"
    parameter string       HOST     = "UART",      // or "BUS", "SERIAL"
    parameter int unsigned BAUD     = 115_200
) (
    input  wire logic       clk,
    input  wire logic       lock,       // 1: clk is good; 1 without a PLL
    input  wire logic       req_n,      // 0: reset wanted
    // UART host, or a master of the part itself
    input  wire logic       uart_rxd,
    output logic            uart_txd,
    // serial line and its straps; it rests with another host
    input  wire logic       rs485_rxd,
    output logic            rs485_txd,
    output logic            rs485_de,
    input  wire logic       hsp,
    input  wire logic [2:0] mod,
    input  wire logic [3:0] adr,
    // bus host
    input  wire logic [2:0] rs,
    input  wire logic       cs_n,
    input  wire logic       oe_n,
    input  wire logic       we_n,
    input  wire logic [7:0] d_i,
    output logic      [7:0] d_o,
    output logic            d_oe,       // with another host always 0: the part's reads stay inside
    output logic            wrq_n,
    output logic            irq_n,
    // switches, drive and encoder, 0 = active but for epin, epdir and run
    input  wire logic       fl_n,
    input  wire logic       bl_n,
    input  wire logic       fhl_n,
    input  wire logic       bhl_n,
    input  wire logic       org_n,
    input  wire logic       index_n,
    input  wire logic       alm_n,
    input  wire logic       end_n,
    input  wire logic       epin,
    input  wire logic       epdir,
    input  wire logic       run,
    input  wire logic       evt0_n,
    input  wire logic       evt1_n,
    input  wire logic       extck,
    input  wire logic [7:0] auxi,
    // motor and drive
    output logic            pout,
    output logic            dir,
    output logic            exon_n,
    output logic            cd_n,
    output logic            cclr_n,
    output logic            aclr_n,
    output logic            zclmp_n,
    output logic            intlk_n,
    output logic      [5:0] auxo_n,
    // lamps, 1 = on: out of reset, a limit or the alarm is active, motor moves, link
    output logic      [3:0] lamps
);

  logic rst_n, part_oe, hold, link;

  ppmc_board_panel #(
      .ClkHz(CLK_HZ)
  ) u_panel (
      .clk_i   (clk),
      .lock_i  (lock),
      .req_ni  (req_n),
      .rst_no  (rst_n),
      .link_i  (link),
      .moving_i(!hold),
      .switch_i(!(fl_n && bl_n && fhl_n && bhl_n && alm_n)),
      .lamps_o (lamps)
  );

  ppmc312_carrier #(
      .CLK_HZ  (CLK_HZ),
      .XTAL_HZ (XTAL_HZ),
      .TIMING  (TIMING),
      .SUM_MODE(SUM_MODE),
      .HOST    (HOST),
      .BAUD    (BAUD)
  ) u_board (
      .clk,
      .rst_n,
      .uart_rxd,
      .uart_txd,
      .rs485_rxd,
      .rs485_txd,
      .rs485_de,
      .hsp,
      .mod,
      .adr,
      .rs,
      .cs_n,
      .oe_n,
      .we_n,
      .d_i,
      .d_o,
      .d_oe    (part_oe),
      .wrq_n,
      .irq_n,
      .fl_n,
      .bl_n,
      .fhl_n,
      .bhl_n,
      .org_n,
      .index_n,
      .alm_n,
      .end_n,
      .epin,
      .epdir,
      .run,
      .evt0_n,
      .evt1_n,
      .extck,
      .auxi,
      .pout,
      .dir,
      .exon_n,
      .cd_n,
      .cclr_n,
      .aclr_n,
      .zclmp_n,
      .intlk_n,
      .auxo_n,
      .hold,
      .led_link(link)
  );

  assign d_oe = HOST == "BUS" && part_oe;

endmodule

`default_nettype wire
