// SPDX-License-Identifier: Apache-2.0
// ppmc_board_host: host interface of a board. It is either the UART bridge with its pulse counters, or the
//         bus pins of the old chip.
// Rules:  Host = "UART": docs/uart_bridge.md. Host = "BUS": the bus pins are connected directly to the
//         device, and all strap outputs are 1.
// Timing: see ppmc_uart_host. With "BUS", all paths are combinational.
`default_nettype none

module ppmc_board_host #(
    parameter int unsigned ClkHz     = 24_000_000,
    parameter int unsigned XtalHz    = 16_000_000,
    parameter bit          Datasheet = 1'b0,
    parameter              Host      = "UART",      // or "BUS"
    parameter int unsigned Baud      = 115_200,
    parameter int unsigned Part      = 104,         // number of the device in IDENT
    parameter int unsigned Axes      = 1,           // number of axes; axis 1 uses the low bits
    parameter int unsigned AddrBits  = 1,           // address lines of the device, 1 .. 4
    parameter bit          Counter   = 1'b1,        // 1: the pulses are counted
    parameter int unsigned Watch     = 1,           // number of recorded levels
    parameter int unsigned Record    = 0            // the recorder stores 2**Record records; 0: no recorder
) (
    input  wire logic                clk_i,
    input  wire logic                rst_ni,
    // UART host
    input  wire logic                rxd_i,
    output logic                     txd_o,
    // bus host
    input  wire logic                cs_ni,
    input  wire logic                rd_ni,
    input  wire logic                wr_ni,
    input  wire logic [AddrBits-1:0] a_i,
    input  wire logic [         7:0] d_i,
    // bus of the device
    output logic                     part_rst_no,
    output logic                     part_cs_no,
    output logic                     part_rd_no,
    output logic                     part_wr_no,
    output logic      [AddrBits-1:0] part_a_o,
    output logic      [         7:0] part_d_o,
    input  wire logic [         7:0] part_d_i,
    input  wire logic                int_ni,
    // board
    output logic      [         7:0] straps_o,
    input  wire logic [  Axes*6-1:0] switches_ni,  // six switches per axis, order as in ppmc_uart_host
    input  wire logic [    Axes-1:0] hold_i,
    input  wire logic [    Axes-1:0] pout_ni,
    input  wire logic [    Axes-1:0] dir_i,
    input  wire logic [   Watch-1:0] watch_i,      // all pins of the device, synchronous to clk_i
    output logic                     link_o        // UART: 1 during scripts and answers; BUS: !cs_ni
);

  if (128'(Host) != "UART" && 128'(Host) != "BUS") begin : g_check_host
    $fatal(1, "ppmc_board_host: HOST must be UART or BUS");
  end

  if (AddrBits < 1 || AddrBits > 4) begin : g_check_addr
    $fatal(1, "ppmc_board_host: AddrBits must be 1 .. 4");
  end

  if (128'(Host) == "UART") begin : g_uart
    logic [3:0] a;

    assign part_a_o = a[AddrBits-1:0];

    ppmc_uart_host #(
        .ClkHz    (ClkHz),
        .XtalHz   (XtalHz),
        .Baud     (Baud),
        .Part     (Part),
        .Datasheet(Datasheet),
        .Axes     (Axes),
        .Counter  (Counter),
        .Watch    (Watch),
        .Record   (Record)
    ) u_host (
        .clk_i,
        .rst_ni,
        .rxd_i,
        .txd_o,
        .cs_no   (part_cs_no),
        .rd_no   (part_rd_no),
        .wr_no   (part_wr_no),
        .a_o     (a),
        .d_o     (part_d_o),
        .d_i     (part_d_i),
        .int_ni,
        .part_rst_no,
        .straps_o,
        .switches_ni,
        .hold_i,
        .pout_ni,
        .dir_i,
        .watch_i,
        .active_o(link_o)
    );

    logic unused;
    assign unused = ^{cs_ni, rd_ni, wr_ni, a_i, d_i, a};
  end else begin : g_bus
    assign part_rst_no = rst_ni;
    assign part_cs_no  = cs_ni;
    assign part_rd_no  = rd_ni;
    assign part_wr_no  = wr_ni;
    assign part_a_o    = a_i;
    assign part_d_o    = d_i;
    assign straps_o    = '1;
    assign txd_o       = 1'b1;
    assign link_o      = !cs_ni;

    logic unused;
    assign unused = ^{clk_i, rxd_i, part_d_i, int_ni, switches_ni, hold_i, pout_ni, dir_i, watch_i};
  end

endmodule

`default_nettype wire
