// SPDX-License-Identifier: Apache-2.0
// ppmc_strobe_master_fv: proves that each request causes one strobe with the set-up time, length and gap of
// the bus, and that the access ends.
`include "ppmc_fv.svh"
`default_nettype none

module ppmc_strobe_master_fv (
    input wire logic       clk_i,
    input wire logic       req_i,
    input wire logic       we_i,
    input wire logic [1:0] addr_i,
    input wire logic [7:0] wdata_i,
    input wire logic [7:0] d_i
);

  logic ready_o, done_o, cs_no, rd_no, wr_no;
  logic [7:0] rdata_o, d_o;
  logic [1:0] a_o;

  `FV_RESET

  ppmc_strobe_master #(.AddrBits(2)) dut (.*);

  logic way_q, write_q;  // way_q: an access is in progress; write_q: the access is a write
  logic [1:0] addr_q;
  logic [7:0] data_q;
  // age_q: cycles since the request; low_q: cycles of the strobe; high_q: cycles of the gap. age_q and high_q
  // saturate at 15.
  logic [3:0] age_q, low_q, high_q;

  always_ff @(posedge clk_i)
    if (!rst_ni) {way_q, write_q, addr_q, data_q, age_q, low_q, high_q} <= '1;
    else begin
      low_q  <= cs_no ? '0 : low_q + 1'b1;
      high_q <= !cs_no ? '0 : (high_q == '1) ? '1 : high_q + 1'b1;
      age_q  <= (age_q == '1) ? '1 : age_q + 1'b1;
      if (req_i && ready_o) {way_q, write_q, addr_q, data_q, age_q} <= {1'b1, we_i, addr_i, wdata_i, 4'd0};
      else if (done_o) way_q <= 1'b0;
    end

  logic begun_q;
  always_ff @(posedge clk_i) begun_q <= rst_ni && (begun_q || (req_i && ready_o));

  `FV_ASSERT(never_both, rd_no || wr_no)
  `FV_ASSERT(strobe_in_select, cs_no == (rd_no && wr_no))
  `FV_ASSERT(ub_bus_01_as_asked,
             cs_no || (begun_q && way_q && wr_no != write_q && a_o == addr_q && d_o == data_q))
  `FV_ASSERT(address_stands_before_and_behind, !begun_q || ready_o || {a_o, d_o} == {addr_q, data_q})
  `FV_ASSERT(whole_strobe, !done_o || (cs_no && $past(!cs_no) && $past(low_q) == ($past(write_q)
             ? 4'd3 : 4'd5)))
  `FV_ASSERT(only_whole_strobes, !($past(!cs_no) && cs_no) || done_o)
  `FV_ASSERT(gap, !($past(cs_no) && !cs_no) || !begun_q || high_q >= 4'd4)
  `FV_ASSERT(ends_in_time, !(begun_q && way_q) || age_q <= 4'd8)
  `FV_ASSERT(read_is_what_was_shown, !(done_o && !write_q) || rdata_o == $past(d_i))

  logic second_q;  // 1: a write has ended before
  always_ff @(posedge clk_i) second_q <= rst_ni && (second_q || (done_o && write_q));

  `FV_COVER(seen_read_behind_write, done_o && !write_q && second_q)

endmodule

`default_nettype wire
