// SPDX-License-Identifier: Apache-2.0
// board_tangnano20k_ppmc312: PPMC-312 on a Tang Nano 20K (GW2AR-LV18QN88C8/I7), clk 54 MHz from its 27 MHz oscillator.
// Rules:  pins, lamps, wiring: docs/boards.md; constraints/tangnano20k-ppmc312.cst. UART host only; two general inputs
//         and two general outputs: the header has no more pins.
// Timing: the part's inputs are synchronised inside it.
`default_nettype none

module board_tangnano20k_ppmc312 #(
    parameter int unsigned XTAL_HZ = 16_000_000,
    parameter string       TIMING  = "FAST",
    parameter int unsigned BAUD    = 115_200
) (
    input  wire logic       clk_27m,
    input  wire logic       btn,       // 1: reset
    // host: USB-UART
    input  wire logic       uart_rxd,
    output logic            uart_txd,
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
    input  wire logic [1:0] auxi,
    // motor and drive
    output logic            pout,
    output logic            dir,
    output logic            exon_n,
    output logic            cd_n,
    output logic            cclr_n,
    output logic            aclr_n,
    output logic            zclmp_n,
    output logic            intlk_n,
    output logic      [1:0] auxo_n,
    // lamps, 0 = on
    output logic      [3:0] led_n
);

  localparam int unsigned ClkHz = 54_000_000;

  logic clk, lock, unused;
  logic [3:0] lamps;
  logic [5:0] outputs_n;
  logic [7:0] part_d;
  logic line, line_de, part_oe, wrq_n, irq_n;

  ppmc_clock_tangnano #(
      .Device("GW2A-18C"),
      .OutDiv(16)
  ) u_clock (
      .clk_27m_i(clk_27m),
      .clk_o    (clk),
      .lock_o   (lock)
  );

  ppmc312_station #(
      .CLK_HZ (ClkHz),
      .XTAL_HZ(XTAL_HZ),
      .TIMING (TIMING),
      .HOST   ("UART"),
      .BAUD   (BAUD)
  ) u_station (
      .clk,
      .lock,
      .req_n    (!btn),
      .uart_rxd,
      .uart_txd,
      .rs485_rxd(1'b1),
      .rs485_txd(line),
      .rs485_de (line_de),
      .hsp      (1'b1),
      .mod      ('1),
      .adr      ('1),
      .rs       ('0),
      .cs_n     (1'b1),
      .oe_n     (1'b1),
      .we_n     (1'b1),
      .d_i      ('0),
      .d_o      (part_d),
      .d_oe     (part_oe),
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
      .auxi     ({6'h3F, auxi}),
      .pout,
      .dir,
      .exon_n,
      .cd_n,
      .cclr_n,
      .aclr_n,
      .zclmp_n,
      .intlk_n,
      .auxo_n   (outputs_n),
      .lamps
  );

  assign auxo_n = outputs_n[1:0];
  assign led_n  = ~lamps;

  assign unused = ^{line, line_de, part_d, part_oe, wrq_n, irq_n, outputs_n[5:2]};

endmodule

`default_nettype wire
