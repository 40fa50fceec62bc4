// SPDX-License-Identifier: Apache-2.0
// board_ulx3s_ppmc312: PPMC-312 on a ULX3S (ECP5 LFE5U-25F or -85F, CABGA381), clk 50 MHz from its 25 MHz oscillator.
// Rules:  pins, lamps, wiring: docs/boards.md; constraints/ulx3s-ppmc312.lpf.
// Timing: the part's inputs are synchronised inside it.
`default_nettype none

module board_ulx3s_ppmc312 #(
    parameter int unsigned XTAL_HZ = 16_000_000,
    parameter string       TIMING  = "FAST",
    parameter string       HOST    = "UART",      // or "BUS"
    parameter int unsigned BAUD    = 115_200
) (
    input  wire logic       clk_25m,
    input  wire logic       btn_f1,      // 1: reset
    // host: USB-UART
    input  wire logic       uart_rxd,
    output logic            uart_txd,
    // host: bus of the old chip
    input  wire logic [2:0] rs,
    input  wire logic       cs_n,
    input  wire logic       oe_n,
    input  wire logic       we_n,
    inout  wire logic [7:0] d,
    output logic            d_oe,        // direction of a bus transceiver, 1: FPGA to host
    output logic            wrq_n,
    output logic            irq_n,
    input  wire logic       host_rst_n,
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
    // lamps and the boot pin of the ESP32
    output logic      [3:0] led,
    output logic            wifi_gpio0
);

  localparam int unsigned ClkHz = 50_000_000;

  logic clk, lock, line, line_de, unused;
  logic [7:0] part_d;

  ppmc_clock_ulx3s #(
      .Divisor(600_000_000 / ClkHz)
  ) u_clock (
      .clk_25m_i(clk_25m),
      .clk_o    (clk),
      .lock_o   (lock)
  );

  ppmc312_station #(
      .CLK_HZ (ClkHz),
      .XTAL_HZ(XTAL_HZ),
      .TIMING (TIMING),
      .HOST   (HOST),
      .BAUD   (BAUD)
  ) u_station (
      .clk,
      .lock,
      .req_n(host_rst_n && !btn_f1),
      .uart_rxd,
      .uart_txd,
      .rs485_rxd(1'b1),
      .rs485_txd(line),
      .rs485_de(line_de),
      .hsp(1'b1),
      .mod('1),
      .adr('1),
      .rs,
      .cs_n,
      .oe_n,
      .we_n,
      .d_i(d),
      .d_o(part_d),
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
      .lamps(led)
  );

  assign d = d_oe ? part_d : 'z;

  assign unused = ^{line, line_de};

  // Low would put the ESP32 into its boot loader at its next reset.
  assign wifi_gpio0 = 1'b1;

endmodule

`default_nettype wire
