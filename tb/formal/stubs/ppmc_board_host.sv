// SPDX-License-Identifier: Apache-2.0
// ppmc_board_host, stub for the proof of the block that instantiates it: its outputs are not driven, so the
// proof holds for any strobes and any answer to the PC.
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

endmodule

`default_nettype wire
