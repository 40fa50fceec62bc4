// SPDX-License-Identifier: Apache-2.0
// ppmc_bank_axis_port_fv: the view, driven by the strobe master of the bridges. Proves that no strobe reaches the
// bank for axes that do not exist or for the axis choice, and that the address is stable while a strobe is
// low.
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
  logic [7:0] rdata_o, master_d, view_d, axis_o;
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
      .d_i  (view_d),
      .*
  );

  ppmc_bank_axis_port dut (
      .d_i(master_d),
      .d_o(view_d),
      .*
  );

  // latest_q: byte of the last access, which may still be in progress; choice_q: last byte written to
  // register 3
  logic [7:0] choice_q, latest_q;
  logic write_q;
  always_ff @(posedge clk_i)
    if (!rst_ni) {choice_q, latest_q, write_q} <= '0;
    else begin
      if (req_i && ready_o) {write_q, latest_q} <= {we_i && addr_i == 4'h3, wdata_i};
      if (done_o && write_q) choice_q <= latest_q;
    end

  `FV_ASSERT(address_stands, !($past(rst_ni && !cs_no) && !cs_no) || a_o == $past(a_o))
  `FV_ASSERT(address_stands_before, cs_no || $past(a_o) == a_o)
  `FV_ASSERT(no_strobe_for_axes_beyond, cs_no || axis_o[7:6] == '0)
  `FV_ASSERT(no_strobe_for_the_choice, cs_no || a_o[3:0] != 4'h3)
  `FV_ASSERT(chosen_as_written, !ready_o || axis_o == choice_q)
  `FV_ASSERT(goes_to_the_chosen_axis, cs_no || a_o == {choice_q[5:0], a_i})
  `FV_COVER(seen_axis_five, !cs_no && a_o == 10'h051)

endmodule

`default_nettype wire
