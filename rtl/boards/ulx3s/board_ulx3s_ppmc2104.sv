// SPDX-License-Identifier: Apache-2.0
// board_ulx3s_ppmc2104: PPMC-2104 on a ULX3S (ECP5 LFE5U-25F or -85F, CABGA381), clk 100 MHz from its 25 MHz
//         oscillator.
// Rules:  pins, lamps, wiring: docs/boards.md; constraints/ulx3s-ppmc2104.lpf.
// Timing: the part's inputs are synchronised inside it.
`default_nettype none

module board_ulx3s_ppmc2104 #(
    parameter int unsigned XTAL_HZ  = 16_000_000,
    parameter string       TIMING   = "FAST",
    parameter bit          PHASE_ON = 1'b1,        // level of s1, s2 that switches a winding on
    parameter string       HOST     = "UART",      // or "BUS"
    parameter int unsigned BAUD     = 115_200
) (
    input  wire logic       clk_25m,
    input  wire logic       btn_f1,      // 1: reset
    // host: USB-UART
    input  wire logic       uart_rxd,
    output logic            uart_txd,
    // host: bus of the old chip
    input  wire logic       cs_n,
    input  wire logic       a0,
    input  wire logic       busc,
    input  wire logic       ds_wrs_n,
    input  wire logic       rw_rds_n,
    inout  wire logic [7:0] d,
    output logic            d_oe,        // direction of a bus transceiver, 1: FPGA to host
    output logic            int_n,
    input  wire logic       host_rst_n,
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

  ppmc2104_station #(
      .CLK_HZ  (ClkHz),
      .XTAL_HZ (XTAL_HZ),
      .TIMING  (TIMING),
      .PHASE_ON(PHASE_ON),
      .HOST    (HOST),
      .BAUD    (BAUD)
  ) u_station (
      .clk,
      .lock,
      .req_n(host_rst_n && !btn_f1),
      .uart_rxd,
      .uart_txd,
      .cs_n,
      .a0,
      .busc,
      .ds_wrs_n,
      .rw_rds_n,
      .d_i  (d),
      .d_o  (part_d),
      .d_oe,
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
      .s1,
      .s2,
      .hold,
      .pout_n,
      .dir,
      .lamps(led)
  );

  assign d = d_oe ? part_d : 'z;

  // Low would put the ESP32 into its boot loader at its next reset.
  assign wifi_gpio0 = 1'b1;

endmodule

`default_nettype wire
