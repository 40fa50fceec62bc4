// SPDX-License-Identifier: Apache-2.0
// ppmc_uart_host: host interface of a board for a PC. Contains the UART bridge and the pulse counters, and
//         returns the levels of the switches.
// Rules:  docs/uart_bridge.md. PINS returns the levels of one axis: {alarm, origin, slow CCW, slow CW, CCW
//         limit, CW limit, hold, int_n}. With two axes, strap output 7 selects the axis (1: axis 1).
// Timing: this block synchronises switches_ni and rxd_i. The outputs of the device are synchronous to
//         clk_i.
`default_nettype none

module ppmc_uart_host #(
    parameter int unsigned ClkHz     = 24_000_000,
    parameter int unsigned XtalHz    = 16_000_000,
    parameter int unsigned Baud      = 115_200,
    parameter int unsigned Part      = 104,
    parameter bit          Datasheet = 1'b0,
    parameter int unsigned Axes      = 1,           // number of axes, 1 or 2; axis 1 uses the low bits
    parameter bit          Counter   = 1'b1,        // 1: the pulses are counted
    parameter int unsigned Watch     = 1,           // number of recorded levels
    parameter int unsigned Record    = 0            // 2**Record records; 0: no recorder
) (
    input  wire logic              clk_i,
    input  wire logic              rst_ni,       // reset, asynchronous
    input  wire logic              rxd_i,        // line from the PC, asynchronous
    output logic                   txd_o,        // line to the PC
    // bus of the device
    output logic                   cs_no,        // chip select
    output logic                   rd_no,        // read strobe
    output logic                   wr_no,        // write strobe
    output logic      [       3:0] a_o,          // register; a device may use only the low bits
    output logic      [       7:0] d_o,          // write data
    input  wire logic [       7:0] d_i,          // read data
    input  wire logic              int_ni,       // interrupt, active low
    output logic                   part_rst_no,  // reset of the device, active low
    // board
    output logic      [       7:0] straps_o,     // strap outputs, set by operation STRAPS
    input  wire logic [Axes*6-1:0] switches_ni,  // switches for operation PINS
    input  wire logic [  Axes-1:0] hold_i,       // HOLD for operation PINS; high: standstill
    input  wire logic [  Axes-1:0] pout_ni,      // pulses to be counted
    input  wire logic [  Axes-1:0] dir_i,        // direction of the pulses on pout_ni
    input  wire logic [ Watch-1:0] watch_i,      // levels for the recorder, synchronous to clk_i
    output logic                   active_o      // 1: a script is running, or its answer is being sent
);

  logic [Axes*6-1:0] switches, unused_meta;
  logic [Axes*32-1:0] count;
  logic [Axes-1:0] zero;
  logic [6:0] pins;
  logic rst_host_n;

  ppmc_reset u_reset (
      .clk_i,
      .rst_ni,
      .rst_no(rst_host_n)
  );

  ppmc_sync #(
      .Width(Axes * 6)
  ) u_sync (
      .clk_i,
      .rst_ni(rst_host_n),
      .d_i   (switches_ni),
      .q1_o  (unused_meta),
      .q2_o  (switches)
  );

  if (Axes == 1) begin : g_one
    assign pins = {switches, hold_i};
  end else begin : g_two
    assign pins = straps_o[7] ? {switches[5:0], hold_i[0]} : {switches[11:6], hold_i[1]};
  end

  ppmc_uart_bridge #(
      .ClkHz    (ClkHz),
      .XtalHz   (XtalHz),
      .Baud     (Baud),
      .Part     (Part),
      .Axes     (Axes),
      .Counter  (Counter),
      .Datasheet(Datasheet),
      .Watch    (Watch),
      .Record   (Record)
  ) u_bridge (
      .clk_i,
      .rst_ni      (rst_host_n),
      .rxd_i,
      .txd_o,
      .cs_no,
      .rd_no,
      .wr_no,
      .a_o,
      .d_o,
      .d_i,
      .int_ni,
      .part_rst_no,
      .straps_o,
      .pins_i      ({pins, int_ni}),
      .watch_i,
      .count_i     (count),
      .count_zero_o(zero),
      .active_o
  );

  if (Counter) begin : g_counters
    for (genvar n = 0; n < Axes; n++) begin : g_axis
      ppmc_pulse_counter u_counter (
          .clk_i,
          .rst_ni (rst_host_n),
          .clear_i(zero[n]),
          .pout_ni(pout_ni[n]),
          .dir_i  (dir_i[n]),
          .count_o(count[32*n+:32])
      );
    end
  end else begin : g_no_counters
    assign count = '0;

    logic unused;
    assign unused = ^{zero, pout_ni, dir_i};
  end

endmodule

`default_nettype wire
