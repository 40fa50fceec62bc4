// SPDX-License-Identifier: Apache-2.0
// line_node: a PPMC-312 in serial mode on the virtual line: ppmc312_carrier with ports for the straps and
//         the motor. Each line_node has the ports clk, rst_n, uart_rxd, line and busy.
// Timing: see ppmc312_carrier. While busy is 0 and the line is idle, only the line can cause a change.
`default_nettype none

module line_node #(
    parameter int unsigned CLK_HZ   = 8_000_000,
    parameter int unsigned XTAL_HZ  = 16_000_000,
    parameter              TIMING   = "FAST",
    parameter              SUM_MODE = "BINARY"
) (
    input  wire logic       clk,
    input  wire logic       rst_n,
    // line
    input  wire logic       uart_rxd,
    output logic            line,      // output of the driver; 1 while the driver is off
    // straps
    input  wire logic [2:0] mod,
    input  wire logic [3:0] adr,
    // switches and encoder
    input  wire logic       fl_n,
    input  wire logic       bl_n,
    input  wire logic       fhl_n,
    input  wire logic       bhl_n,
    input  wire logic       org_n,
    input  wire logic       index_n,
    input  wire logic       alm_n,
    input  wire logic       epin,
    input  wire logic       epdir,
    // motor
    output logic            pout,
    output logic            dir,
    // status
    output logic            busy,
    output logic      [5:0] status     // status, coded as in the condition byte
);

  logic txd, de, hold, unused;
  logic uart_txd, wrq_n, irq_n, d_oe, exon_n, cd_n, cclr_n, aclr_n, zclmp_n, intlk_n;
  logic led_link, led_moving, led_switch;
  logic [7:0] d_o;
  logic [5:0] auxo_n;

  ppmc312_carrier #(
      .CLK_HZ  (CLK_HZ),
      .XTAL_HZ (XTAL_HZ),
      .TIMING  (TIMING),
      .SUM_MODE(SUM_MODE),
      .HOST    ("SERIAL")
  ) u_carrier (
      .clk,
      .rst_n,
      .uart_rxd (1'b1),
      .uart_txd,
      .rs485_rxd(uart_rxd),
      .rs485_txd(txd),
      .rs485_de (de),
      .hsp      (1'b1),
      .mod,
      .adr,
      .rs       ('1),
      .cs_n     (1'b1),
      .oe_n     (1'b1),
      .we_n     (1'b1),
      .d_i      ('1),
      .d_o,
      .d_oe,
      .wrq_n,
      .irq_n,
      .fl_n,
      .bl_n,
      .fhl_n,
      .bhl_n,
      .org_n,
      .index_n,
      .alm_n,
      .end_n    (1'b0),      // the drive always reports "in position"
      .epin,
      .epdir,
      .run      (1'b1),
      .evt0_n   (1'b1),
      .evt1_n   (1'b1),
      .extck    (1'b0),
      .auxi     ('1),
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
      .led_link,
      .led_moving,
      .led_switch
  );

  assign line = txd || !de;
  assign status = u_carrier.u_part.u_core.status_o;
  assign busy = !hold || de;
  assign unused = ^{uart_txd, wrq_n, irq_n, d_oe, exon_n, cd_n, cclr_n, aclr_n, zclmp_n, intlk_n, led_link,
                    led_moving, led_switch, d_o, auxo_n};

endmodule

`default_nettype wire
