// SPDX-License-Identifier: Apache-2.0
// ppmc_bank_view: a bank behind the four address lines of the UART bridge: the 16 registers of one axis, of which
//         register 0x3 chooses the axis.
// Rules:  register map in docs/bank/carrier.md; passes strobes on as BANK-WIN-04 wants them.
// Timing: combinational but for the choice, which changes inside the write strobe at register 0x3, and stands from
//         GapClk - 1 clk before the next strobe. The bank sees no strobe at 0x3, and none at axes 64 .. 255.
`include "ppmc_assert.svh"
`default_nettype none

module ppmc_bank_view (
    input  wire logic       clk_i,
    input  wire logic       rst_ni,    // the bank's: axis 0 afterwards
    // host, in step with clk_i; rd_n, wr_n and the data it writes go to the bank as they are
    input  wire logic       cs_ni,     // addressed
    input  wire logic       wr_ni,     // write strobe
    input  wire logic [3:0] a_i,       // register
    input  wire logic [7:0] d_i,       // what it writes
    output logic      [7:0] d_o,       // what it reads
    // bank
    output logic            cs_no,     // addressed
    output logic      [9:0] a_o,       // axis and register
    input  wire logic [7:0] bank_d_i,  // what it shows
    output logic      [7:0] axis_o     // which one is chosen
);

  localparam logic [3:0] Choice = 4'h3;

  logic own, none;

  assign own   = a_i == Choice;
  assign none  = axis_o[7:6] != '0;  // the window ends at 63
  assign cs_no = cs_ni || own || none;
  assign a_o   = {axis_o[5:0], a_i};
  assign d_o   = own ? axis_o : none ? '1 : bank_d_i;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) axis_o <= '0;
    else if (own && !cs_ni && !wr_ni) axis_o <= d_i;
  end

`ifndef SYNTHESIS
  `PPMC_ASSERT(bank_win_04_stands, cs_no || $past(a_o) == a_o)
`endif

endmodule

`default_nettype wire
