// SPDX-License-Identifier: Apache-2.0
// ppmc2104_carrier: PPMC-2104 board without clock generator and pads. Contains ppmc2104 and one host
//         interface: the UART bridge or the bus pins of the old chip.
// Rules:  HOST = "UART": docs/uart_bridge.md, with the strap outputs {axis 1 selected for PINS, -, -,
//         errint_n, run, csel}; HOST = "BUS": P2104-PORT-01. Wiring: docs/boards.md.
// Timing: same as ppmc2104. With RECORD != 0, inputs other than the bus act 2 cycles later. No input needs an
//         external synchroniser.
`default_nettype none

module ppmc2104_carrier #(
    parameter int unsigned CLK_HZ   = 24_000_000,  // clock frequency in Hz, 8e6 .. 200e6
    parameter int unsigned XTAL_HZ  = 16_000_000,
    parameter              TIMING   = "FAST",
    parameter bit          PHASE_ON = 1'b0,        // level of s1, s2 of an energised winding
    parameter              HOST     = "UART",      // or "BUS"
    parameter int unsigned BAUD     = 115_200,     // baud rate of the bridge after reset
    parameter int unsigned RECORD   = 0            // 4 .. 16: 2**RECORD records of the pins; 0: no recorder
) (
    input  wire logic       clk,
    input  wire logic       rst_n,
    // UART host
    input  wire logic       uart_rxd,    // from the PC
    output logic            uart_txd,    // to the PC
    // bus host; with HOST = "UART", d_oe = 0, because reads then remain inside the FPGA
    input  wire logic       cs_n,
    input  wire logic       a0,
    input  wire logic       busc,
    input  wire logic       ds_wrs_n,
    input  wire logic       rw_rds_n,
    input  wire logic [7:0] d_i,
    output logic      [7:0] d_o,
    output logic            d_oe,        // direction of a bus transceiver, 1: FPGA to host
    output logic            int_n,
    // with HOST = "UART", strap outputs of the bridge can also set errint_n, run and csel to 0
    input  wire logic       errint_n,
    input  wire logic [2:1] run,
    input  wire logic [2:1] csel,
    input  wire logic [2:1] extck,
    // switches, active low
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
    // LEDs, high: on
    output logic            led_link,    // a script is running or an answer is pending
    output logic            led_moving,
    output logic            led_switch   // a limit or an alarm is active
);

  logic part_rst_n, part_cs_n, part_a0, part_busc, part_ds_wrs_n, part_rw_rds_n, part_errint_n;
  logic [2:1] part_run, part_csel;
  logic [5:1] s1_n, s2_n;
  logic [7:0] part_d, straps;
  logic part_oe, unused_straps;

  // in_…: input pins as ppmc2104 receives them. watch: all recorded levels; part_rst_n is bit 0.
  localparam int unsigned Watch = 63;
  logic in_errint_n;
  logic [2:1] in_csel, in_run, in_extck, in_fl_n, in_bl_n, in_fhl_n, in_bhl_n, in_org_n, in_alm_n;
  logic [1:0] in_auxi;
  logic [Watch-1:0] watch;

  ppmc_board_inputs #(
      .Width(21),
      .Sync (RECORD != 0)
  ) u_inputs (
      .clk_i(clk),
      .rst_ni(rst_n),
      .d_i({auxi, alm_n, org_n, bhl_n, fhl_n, bl_n, fl_n, csel, extck, run, errint_n}),
      .q_o({
        {in_auxi, in_alm_n, in_org_n, in_bhl_n, in_fhl_n, in_bl_n, in_fl_n, in_csel, in_extck, in_run},
        in_errint_n
      })
  );

  assign watch = {
    {auxo, s2_n, s1_n, hold, dir, pout_n, int_n, part_oe, d_o},
    {in_auxi, in_alm_n, in_org_n, in_bhl_n, in_fhl_n, in_bl_n, in_fl_n, part_csel, in_extck, part_run},
    {part_errint_n, part_d, part_rw_rds_n, part_ds_wrs_n, part_busc, part_a0, part_cs_n, part_rst_n}
  };

  ppmc2104 #(
      .CLK_HZ (CLK_HZ),
      .XTAL_HZ(XTAL_HZ),
      .TIMING (TIMING)
  ) u_part (
      .clk,
      .rst_n   (part_rst_n),
      .cs_n    (part_cs_n),
      .a0      (part_a0),
      .busc    (part_busc),
      .ds_wrs_n(part_ds_wrs_n),
      .rw_rds_n(part_rw_rds_n),
      .d_i     (part_d),
      .d_o,
      .d_oe    (part_oe),
      .int_n,
      .errint_n(part_errint_n),
      .pout_n,
      .dir,
      .hold,
      .s1_n,
      .s2_n,
      .run     (part_run),
      .extck   (in_extck),
      .csel    (part_csel),
      .fl_n    (in_fl_n),
      .bl_n    (in_bl_n),
      .fhl_n   (in_fhl_n),
      .bhl_n   (in_bhl_n),
      .org_n   (in_org_n),
      .alm_n   (in_alm_n),
      .auxi    (in_auxi),
      .auxo,
      .clk_o
  );

  ppmc_board_host #(
      .ClkHz    (CLK_HZ),
      .XtalHz   (XTAL_HZ),
      .Datasheet(128'(TIMING) == "DATASHEET"),
      .Host     (HOST),
      .Baud     (BAUD),
      .Part     (2104),
      .Axes     (2),
      .Watch    (Watch),
      .Record   (RECORD)
  ) u_host (
      .clk_i(clk),
      .rst_ni(rst_n),
      .rxd_i(uart_rxd),
      .txd_o(uart_txd),
      .cs_ni(cs_n),
      .rd_ni(rw_rds_n),
      .wr_ni(ds_wrs_n),
      .a_i(a0),
      .d_i,
      .part_rst_no(part_rst_n),
      .part_cs_no(part_cs_n),
      .part_rd_no(part_rw_rds_n),
      .part_wr_no(part_ds_wrs_n),
      .part_a_o(part_a0),
      .part_d_o(part_d),
      .part_d_i(d_o),
      .int_ni(int_n),
      .straps_o(straps),
      .switches_ni({
        {alm_n[2], org_n[2], bhl_n[2], fhl_n[2], bl_n[2], fl_n[2]},
        {alm_n[1], org_n[1], bhl_n[1], fhl_n[1], bl_n[1], fl_n[1]}
      }),
      .hold_i(hold),
      .pout_ni(pout_n),
      .dir_i(dir),
      .watch_i(watch),
      .link_o(led_link)
  );

  assign part_busc     = 128'(HOST) == "BUS" && busc;  // the bridge drives separate read and write strobes
  assign part_csel     = in_csel & straps[1:0];
  assign part_run      = in_run & straps[3:2];
  assign part_errint_n = in_errint_n && straps[4];
  assign d_oe          = 128'(HOST) == "BUS" && part_oe;
  assign s1            = PHASE_ON ? ~s1_n : s1_n;
  assign s2            = PHASE_ON ? ~s2_n : s2_n;
  assign led_moving    = hold != '1;
  assign led_switch    = (fl_n & bl_n & fhl_n & bhl_n & alm_n) != '1;
  assign unused_straps = ^straps[7:5];

endmodule

`default_nettype wire
