// SPDX-License-Identifier: Apache-2.0
// stmc_carrier: board with the controller of the J105 STMC, without clock generator and pads. Contains
//         stmc, its external step clock, and one host interface: the UART bridge or the bus pins of stmc.
// Rules:  HOST = "UART": docs/uart_bridge.md; the alarm bit of operation PINS is MON. Only strap output 0 is
//         used, and only with a recorder. HOST = "BUS": STMC-BUS-01..22. Step clock: J105-06. Wiring:
//         docs/boards.md.
// Timing: same as stmc. With RECORD != 0, switches act 2 cycles later. No input needs an external
//         synchroniser.
`default_nettype none

module stmc_carrier #(
    parameter int unsigned CLK_HZ     = 24_000_000,  // clock frequency in Hz, 8e6 .. 200e6
    parameter int unsigned XTAL_HZ    = 16_000_000,
    parameter              TIMING     = "FAST",
    parameter              READ_MAP   = "FAMILY",    // or "SHEET"
    parameter bit          PHASE_IDLE = 1'b0,        // level of s until the first initialisation
    parameter int unsigned EXT_HZ     = 48_675,      // external step clock in Hz
    parameter              HOST       = "UART",      // or "BUS"
    parameter int unsigned BAUD       = 115_200,     // baud rate of the bridge after reset
    parameter int unsigned RECORD     = 0            // 4 .. 16: 2**RECORD records of the pins; 0: no recorder
) (
    input  wire logic       clk,
    input  wire logic       rst_n,
    // UART host
    input  wire logic       uart_rxd,    // from the PC
    output logic            uart_txd,    // to the PC
    // bus host; with HOST = "UART", d_oe = 0, because reads then remain inside the FPGA
    input  wire logic       cs_n,
    input  wire logic       a0,
    input  wire logic       rd_n,
    input  wire logic       wr_n,
    input  wire logic [7:0] d_i,
    output logic      [7:0] d_o,
    output logic            d_oe,        // direction of a bus transceiver, 1: FPGA to host
    output logic            int_n,
    // switches, active low
    input  wire logic       l1_n,
    input  wire logic       l2_n,
    input  wire logic       l3_n,
    input  wire logic       l4_n,
    input  wire logic       cnp_n,
    input  wire logic       mon,         // high: the motor may run
    // motor
    output logic      [5:1] s,
    output logic            hold,
    // LEDs, high: on
    output logic            led_link,    // a script is running or an answer is pending
    output logic            led_moving,
    output logic            led_switch   // a limit is active, or MON is low
);

  logic part_rst_n, part_cs_n, part_a0, part_rd_n, part_wr_n, ext_rst_n, pout_n, dir, unused_straps;
  logic ext_wave, ext_clk;
  logic part_oe;
  logic [7:0] part_d, straps;

  // in_…: input pins as stmc receives them. watch: all recorded levels; part_rst_n is bit 0.
  localparam int unsigned Watch = 36;
  logic in_l1_n, in_l2_n, in_l3_n, in_l4_n, in_cnp_n, in_mon;
  logic [Watch-1:0] watch;

  ppmc_board_inputs #(
      .Width(6),
      .Sync (RECORD != 0)
  ) u_inputs (
      .clk_i (clk),
      .rst_ni(rst_n),
      .d_i   ({mon, cnp_n, l4_n, l3_n, l2_n, l1_n}),
      .q_o   ({in_mon, in_cnp_n, in_l4_n, in_l3_n, in_l2_n, in_l1_n})
  );

  assign watch = {
    {hold, s, int_n, part_oe, d_o},
    {in_mon, in_cnp_n, in_l4_n, in_l3_n, in_l2_n, in_l1_n},
    {part_d, part_wr_n, part_rd_n, part_a0, part_cs_n, ext_clk, part_rst_n}
  };

  // A reset of only the device does not stop the step clock.
  ppmc_reset u_reset (
      .clk_i (clk),
      .rst_ni(rst_n),
      .rst_no(ext_rst_n)
  );

  // ppmc_square counts each half period of the wave as one cycle of a virtual crystal.
  ppmc_square #(
      .ClkHz   (CLK_HZ),
      .XtalHz  (2 * EXT_HZ),
      .HalfXtal(1)
  ) u_ext (
      .clk_i (clk),
      .rst_ni(ext_rst_n),
      .wave_o(ext_wave)
  );

  // With a recorder, strap output 0 can stop the step clock, whose edges would otherwise fill the memory.
  assign ext_clk = ext_wave && (straps[0] || RECORD == 0);

  stmc #(
      .CLK_HZ    (CLK_HZ),
      .XTAL_HZ   (XTAL_HZ),
      .TIMING    (TIMING),
      .READ_MAP  (READ_MAP),
      .PHASE_IDLE(PHASE_IDLE)
  ) u_part (
      .clk,
      .rst_n(part_rst_n),
      .ext_clk,
      .cs_n (part_cs_n),
      .a0   (part_a0),
      .rd_n (part_rd_n),
      .wr_n (part_wr_n),
      .d_i  (part_d),
      .d_o,
      .d_oe  (part_oe),
      .int_n,
      .l1_n (in_l1_n),
      .l2_n (in_l2_n),
      .l3_n (in_l3_n),
      .l4_n (in_l4_n),
      .cnp_n(in_cnp_n),
      .mon  (in_mon),
      .s,
      .hold
  );

  ppmc_board_steps u_steps (
      .clk_i  (clk),
      .rst_ni (part_rst_n),
      .s_i    (s),
      .pout_no(pout_n),
      .dir_o  (dir)
  );

  ppmc_board_host #(
      .ClkHz    (CLK_HZ),
      .XtalHz   (XTAL_HZ),
      .Datasheet(128'(TIMING) == "DATASHEET"),
      .Host     (HOST),
      .Baud     (BAUD),
      .Part     (105),
      .Watch    (Watch),
      .Record   (RECORD)
  ) u_host (
      .clk_i      (clk),
      .rst_ni     (rst_n),
      .rxd_i      (uart_rxd),
      .txd_o      (uart_txd),
      .cs_ni      (cs_n),
      .rd_ni      (rd_n),
      .wr_ni      (wr_n),
      .a_i        (a0),
      .d_i,
      .part_rst_no(part_rst_n),
      .part_cs_no (part_cs_n),
      .part_rd_no (part_rd_n),
      .part_wr_no (part_wr_n),
      .part_a_o   (part_a0),
      .part_d_o   (part_d),
      .part_d_i   (d_o),
      .int_ni     (int_n),
      .straps_o   (straps),
      .switches_ni({mon, cnp_n, l4_n, l3_n, l2_n, l1_n}),
      .hold_i     (hold),
      .pout_ni    (pout_n),
      .dir_i      (dir),
      .watch_i    (watch),
      .link_o     (led_link)
  );

  assign d_oe          = 128'(HOST) == "BUS" && part_oe;
  assign led_moving    = !hold;
  assign led_switch    = !(l1_n && l2_n && l3_n && l4_n && mon);
  assign unused_straps = ^straps;

endmodule

`default_nettype wire
