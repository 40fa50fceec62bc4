// SPDX-License-Identifier: Apache-2.0
// ppmc_bank_axis_port: connects the four address lines of the UART bridge to the 16 registers of one axis
//         of a bank. Register 0x3 selects the axis.
// Rules:  register map: docs/bank/carrier.md; strobes are forwarded as BANK-WIN-04 requires.
// Timing: all outputs except axis_o are combinational. axis_o changes only during a write strobe at register
//         0x3. It is stable again at least G - 1 cycles before the next strobe, where G is GapCycles of
//         ppmc_strobe_master. The bank receives no strobe for register 0x3 and for axes 64 .. 255.
`include "ppmc_assert.svh"
`default_nettype none

module ppmc_bank_axis_port (
    input  wire logic       clk_i,
    input  wire logic       rst_ni,    // reset of the bank; selects axis 0
    // host, synchronous to clk_i; its strobes and write data are also connected directly to the bank
    input  wire logic       cs_ni,     // chip select
    input  wire logic       wr_ni,     // write strobe
    input  wire logic [3:0] a_i,       // register
    input  wire logic [7:0] d_i,       // write data
    output logic      [7:0] d_o,       // read data
    // bank
    output logic            cs_no,     // chip select
    output logic      [9:0] a_o,       // axis and register
    input  wire logic [7:0] bank_d_i,  // read data of the bank
    output logic      [7:0] axis_o     // selected axis
);

  localparam logic [3:0] AxisSelect = 4'h3;

  logic is_select, no_axis;

  assign is_select = a_i == AxisSelect;
  assign no_axis = axis_o[7:6] != '0;  // the window has no axis above 63
  assign cs_no = cs_ni || is_select || no_axis;
  assign a_o = {axis_o[5:0], a_i};
  assign d_o = is_select ? axis_o : no_axis ? '1 : bank_d_i;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) axis_o <= '0;
    else if (is_select && !cs_ni && !wr_ni) axis_o <= d_i;
  end

`ifndef SYNTHESIS
  `PPMC_ASSERT(bank_win_04_address_stable, cs_no || $past(a_o) == a_o)
`endif

endmodule

`default_nettype wire
