// SPDX-License-Identifier: Apache-2.0
// board_de10nano: PPMC-104 on a Terasic DE10-Nano (Cyclone V 5CSEBA6U23I7), clk 50 MHz, its oscillator.
// Rules:  pins, lamps, wiring: docs/boards.md; constraints/de10nano.qsf, de10nano.sdc.
//         For Quartus; linted, but not built or run by this project.
// Timing: the part's inputs are synchronised inside it.
`default_nettype none

module board_de10nano #(
    parameter int unsigned XTAL_HZ    = 16_000_000,
    parameter string       TIMING     = "FAST",
    parameter bit          PHASE_IDLE = 1'b0,        // 0: for drivers that are on with H, 1: on with L
    parameter string       HOST       = "UART",      // or "BUS"
    parameter int unsigned BAUD       = 115_200
) (
    input  wire logic       clk,         // 50 MHz
    input  wire logic       key_n,       // 0: reset
    // host: USB-UART
    input  wire logic       uart_rxd,
    output logic            uart_txd,
    // host: bus of the old chip
    input  wire logic       a0,
    input  wire logic       cs_n,
    input  wire logic       rd_n,
    input  wire logic       wr_n,
    inout  wire logic [7:0] d,
    output logic            d_oe,        // direction of a bus transceiver, 1: FPGA to host
    output logic            int_n,
    input  wire logic       host_rst_n,
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
    // lamps
    output logic      [3:0] led
);

  localparam int unsigned ClkHz = 50_000_000;

  logic [7:0] part_d;

  ppmc104_station #(
      .CLK_HZ    (ClkHz),
      .XTAL_HZ   (XTAL_HZ),
      .TIMING    (TIMING),
      .PHASE_IDLE(PHASE_IDLE),
      .HOST      (HOST),
      .BAUD      (BAUD)
  ) u_station (
      .clk,
      .lock (1'b1),
      .req_n(host_rst_n && key_n),
      .uart_rxd,
      .uart_txd,
      .a0,
      .cs_n,
      .rd_n,
      .wr_n,
      .d_i  (d),
      .d_o  (part_d),
      .d_oe,
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
      .lamps(led)
  );

  assign d = d_oe ? part_d : 'z;

endmodule

`default_nettype wire
