// SPDX-License-Identifier: Apache-2.0
// ppmc_spi_fv: for any sck within its limits, proves that no access begins while another is in progress,
// that every read is complete in time, and that strobes occur only in the data of a frame.
`include "ppmc_fv.svh"
`default_nettype none

module ppmc_spi_fv (
    input wire logic       clk_i,
    input wire logic       sck_i,
    input wire logic       mosi_i,
    input wire logic       cs_ni,
    input wire logic [7:0] d_i,
    input wire logic       int_ni
);

  logic miso_o, miso_oe_o, active_o, cs_no, rd_no, wr_no;
  logic [1:0] a_o;
  logic [7:0] d_o;

  `FV_RESET

  ppmc_spi #(.AddrBits(2)) dut (.*);

  logic last_q;  // sck one cycle ago
  logic [1:0] same_q;  // cycles since the last change of sck, saturates at 3

  always_ff @(posedge clk_i)
    if (!rst_ni) {last_q, same_q} <= '0;
    else begin
      last_q <= sck_i;
      same_q <= (sck_i != last_q) ? 2'd0 : (same_q == '1) ? '1 : same_q + 1'b1;
    end

  // sck is low for more than 3 cycles and high for more than 1.
  `FV_ASSUME(sck_within_its_limits, sck_i == last_q || (last_q ? same_q >= 2'd1 : same_q == 2'd3))

  logic [4:0] bits_q;  // bits of this frame, saturates at 31
  always_ff @(posedge clk_i)
    if (!rst_ni || dut.cs_n) bits_q <= '0;
    else if (dut.rise && bits_q != '1) bits_q <= bits_q + 1'b1;

  `FV_ASSERT(never_late, !dut.req || dut.ready)
  `FV_ASSERT(access_behind_the_header_alone, !dut.req || bits_q >= 5'd16)
  `FV_ASSERT(header_is_two_bytes,
             dut.cs_n || bits_q >= 5'd16 || dut.state_q == ((bits_q >= 5'd8) ? 2'd1 : 2'd0))
  `FV_ASSERT(never_both, rd_no || wr_no)
  `FV_ASSERT(drives_in_a_frame_alone, !miso_oe_o || $past(!dut.cs_n))
  `FV_COVER(seen_read, !rd_no && a_o == 2'd2)
  `FV_COVER(seen_write, !wr_no && d_o == 8'hA5)

endmodule

`default_nettype wire
