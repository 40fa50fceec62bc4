// SPDX-License-Identifier: Apache-2.0
// board_ulx3s_stmc: STMC on a ULX3S (ECP5 LFE5U-25F or -85F, CABGA381), clk 100 MHz from its 25 MHz oscillator.
// Rules:  pins, lamps, wiring: docs/boards.md; constraints/ulx3s-stmc.lpf.
// Timing: the part's inputs are synchronised inside it.
`default_nettype none

module board_ulx3s_stmc #(
    parameter int unsigned XTAL_HZ    = 16_000_000,
    parameter string       TIMING     = "FAST",
    parameter string       READ_MAP   = "SHEET",     // or "FAMILY"
    parameter bit          PHASE_IDLE = 1'b0,        // 0: for drivers that are on with H, 1: on with L
    parameter string       HOST       = "UART",      // or "BUS"
    parameter int unsigned BAUD       = 115_200
) (
    input  wire logic       clk_25m,
    input  wire logic       btn_f1,      // 1: reset
    // host: USB-UART
    input  wire logic       uart_rxd,
    output logic            uart_txd,
    // host: bus
    input  wire logic       cs_n,
    input  wire logic       a0,
    input  wire logic       rd_n,
    input  wire logic       wr_n,
    inout  wire logic [7:0] d,
    output logic            d_oe,        // direction of a bus transceiver, 1: FPGA to host
    output logic            int_n,
    input  wire logic       host_rst_n,
    // switches, 0 = active
    input  wire logic       l1_n,
    input  wire logic       l2_n,
    input  wire logic       l3_n,
    input  wire logic       l4_n,
    input  wire logic       cnp_n,
    input  wire logic       mon,         // 1 = the motor may run
    // motor
    output logic      [5:1] s,
    output logic            hold,
    // lamps and the boot pin of the ESP32
    output logic      [3:0] led,
    output logic            wifi_gpio0
);

  localparam int unsigned ClkHz = 100_000_000;

  logic clk, lock;
  logic [7:0] part_d;

  ppmc_clock_ulx3s u_clock (
      .clk_25m_i(clk_25m),
      .clk_o    (clk),
      .lock_o   (lock)
  );

  stmc_station #(
      .CLK_HZ    (ClkHz),
      .XTAL_HZ   (XTAL_HZ),
      .TIMING    (TIMING),
      .READ_MAP  (READ_MAP),
      .PHASE_IDLE(PHASE_IDLE),
      .HOST      (HOST),
      .BAUD      (BAUD)
  ) u_station (
      .clk,
      .lock,
      .req_n(host_rst_n && !btn_f1),
      .uart_rxd,
      .uart_txd,
      .cs_n,
      .a0,
      .rd_n,
      .wr_n,
      .d_i  (d),
      .d_o  (part_d),
      .d_oe,
      .int_n,
      .l1_n,
      .l2_n,
      .l3_n,
      .l4_n,
      .cnp_n,
      .mon,
      .s,
      .hold,
      .lamps(led)
  );

  assign d = d_oe ? part_d : 'z;

  // Low would put the ESP32 into its boot loader at its next reset.
  assign wifi_gpio0 = 1'b1;

endmodule

`default_nettype wire
