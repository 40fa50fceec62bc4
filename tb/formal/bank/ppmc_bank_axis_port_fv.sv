// SPDX-License-Identifier: Apache-2.0
// ppmc_bank_axis_port_fv: the axis port, driven by the strobe master of the bridges. Proves that the bank
// receives no strobe for an axis that does not exist, and no strobe for register 3, which selects the axis.
// Proves that the address is stable while a strobe is low.
`include "ppmc_fv.svh"
`default_nettype none

module ppmc_bank_axis_port_fv (
    input wire logic       clk_i,
    input wire logic       req_i,
    input wire logic       we_i,
    input wire logic [3:0] addr_i,
    input wire logic [7:0] wdata_i,
    input wire logic [7:0] bank_d_i
);

  logic ready_o, done_o, cs_ni, rd_no, wr_ni, cs_no;
  logic [7:0] rdata_o, master_d, port_d, axis_o;
  logic [3:0] a_i;
  logic [9:0] a_o;

  `FV_RESET

  ppmc_strobe_master #(
      .AddrBits(4)
  ) u_master (
      .cs_no(cs_ni),
      .wr_no(wr_ni),
      .a_o  (a_i),
      .d_o  (master_d),
      .d_i  (port_d),
      .*
  );

  ppmc_bank_axis_port dut (
      .d_i(master_d),
      .d_o(port_d),
      .*
  );

  // wdata_q: byte of the last access, which may still be in progress; axis_select_q: last byte written to
  // register 3
  logic [7:0] axis_select_q, wdata_q;
  logic select_write_q;
  always_ff @(posedge clk_i)
    if (!rst_ni) {axis_select_q, wdata_q, select_write_q} <= '0;
    else begin
      if (req_i && ready_o) {select_write_q, wdata_q} <= {we_i && addr_i == 4'h3, wdata_i};
      if (done_o && select_write_q) axis_select_q <= wdata_q;
    end

  `FV_ASSERT(address_stable, !($past(rst_ni && !cs_no) && !cs_no) || a_o == $past(a_o))
  `FV_ASSERT(address_stable_before, cs_no || $past(a_o) == a_o)
  `FV_ASSERT(no_strobe_for_missing_axes, cs_no || axis_o[7:6] == '0)
  `FV_ASSERT(no_strobe_for_axis_select, cs_no || a_o[3:0] != 4'h3)
  `FV_ASSERT(axis_select_as_written, !ready_o || axis_o == axis_select_q)
  `FV_ASSERT(strobe_reaches_selected_axis, cs_no || a_o == {axis_select_q[5:0], a_i})
  `FV_COVER(seen_axis_five, !cs_no && a_o == 10'h051)

endmodule

`default_nettype wire
