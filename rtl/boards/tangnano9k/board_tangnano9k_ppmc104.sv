// SPDX-License-Identifier: Apache-2.0
// board_tangnano9k: PPMC-104 on a Tang Nano 9K (GW1NR-LV9QN88PC6/I5), clk 54 MHz from its 27 MHz oscillator.
// Rules:  pins, lamps, wiring: docs/boards.md; constraints/tangnano9k.cst.
//         Two of the AUXI pins are given up: the header has 37 pins with 3.3 V.
// Timing: the part's inputs are synchronised inside it.
`default_nettype none

module board_tangnano9k #(
    parameter int unsigned XTAL_HZ    = 16_000_000,
    parameter string       TIMING     = "FAST",
    parameter bit          PHASE_IDLE = 1'b0,        // 0: for drivers that are on with H, 1: on with L
    parameter string       HOST       = "UART",      // or "BUS"
    parameter int unsigned BAUD       = 115_200
) (
    input  wire logic       clk_27m,
    input  wire logic       btn_n,       // 0: reset
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
    input  wire logic [1:0] auxi,
    output logic      [3:0] auxo,
    output logic            aux_n,
    // motor
    output logic      [5:1] s,
    output logic            hold,
    output logic            pout_n,
    output logic            dir,
    // lamps, 0 = on
    output logic      [3:0] led_n
);

  localparam int unsigned ClkHz = 54_000_000;

  logic clk, lock;
  logic [3:0] lamps;
  logic [7:0] part_d;

  ppmc_clock_tangnano u_clock (
      .clk_27m_i(clk_27m),
      .clk_o    (clk),
      .lock_o   (lock)
  );

  ppmc104_station #(
      .CLK_HZ    (ClkHz),
      .XTAL_HZ   (XTAL_HZ),
      .TIMING    (TIMING),
      .PHASE_IDLE(PHASE_IDLE),
      .HOST      (HOST),
      .BAUD      (BAUD)
  ) u_station (
      .clk,
      .lock,
      .req_n(host_rst_n && btn_n),
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
      .auxi ({2'b00, auxi}),
      .auxo,
      .aux_n,
      .s,
      .hold,
      .pout_n,
      .dir,
      .lamps
  );

  assign d = d_oe ? part_d : 'z;

  assign led_n = ~lamps;

endmodule

`default_nettype wire
