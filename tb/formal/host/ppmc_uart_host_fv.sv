// SPDX-License-Identifier: Apache-2.0
// ppmc_uart_host_fv: the host with two axes. Proves that operation PINS returns the switches of the axis
// that strap output 7 selects, and that each counter counts the pulses of its axis.
`include "ppmc_fv.svh"
`default_nettype none

module ppmc_uart_host_fv (
    input wire logic        clk_i,
    input wire logic        rxd_i,
    input wire logic [ 7:0] d_i,
    input wire logic        int_ni,
    input wire logic [11:0] switches_ni,
    input wire logic [ 1:0] hold_i,
    input wire logic [ 1:0] pout_ni,
    input wire logic [ 1:0] dir_i
);

  logic txd_o, cs_no, rd_no, wr_no, part_rst_no, active_o;
  logic [3:0] a_o;
  logic [7:0] d_o, straps_o;

  `FV_RESET

  ppmc_uart_host #(
      .ClkHz (6000),
      .XtalHz(1_000_000),
      .Baud  (1200),
      .Axes  (2)
  ) dut (
      .watch_i(1'b0),
      .*
  );

  logic [11:0] first_q, seen_q;  // first_q: switches one cycle ago; seen_q: two cycles ago
  logic [1:0] before_nq;  // pulse outputs one cycle ago
  logic [1:0][31:0] pulses_q, counts;  // pulses of each axis (CW minus CCW) since its counter was cleared
  logic [7:0] pins;

  assign counts = dut.count;
  assign pins   = dut.u_bridge.pins_i;

  always_ff @(posedge clk_i)
    if (!dut.rst_host_n) {before_nq, first_q, seen_q, pulses_q} <= {26'h3FFFFFF, 64'd0};
    else begin
      {seen_q, first_q} <= {first_q, switches_ni};
      before_nq <= pout_ni;
      for (int n = 0; n < 2; n++)
      if (dut.zero[n]) pulses_q[n] <= '0;
      else if (before_nq[n] && !pout_ni[n]) pulses_q[n] <= pulses_q[n] + (dir_i[n] ? '1 : 32'd1);
    end

  `FV_ASSERT(pins_of_axis_1, !dut.rst_host_n || !straps_o[7] || pins == {seen_q[5:0], hold_i[0], int_ni})
  `FV_ASSERT(pins_of_axis_2, !dut.rst_host_n || straps_o[7] || pins == {seen_q[11:6], hold_i[1], int_ni})
  `FV_ASSERT(counts_of_axis_1, !dut.rst_host_n || counts[0] == pulses_q[0])
  `FV_ASSERT(counts_of_axis_2, !dut.rst_host_n || counts[1] == pulses_q[1])
  `FV_COVER(seen_both_ways, dut.rst_host_n && counts[1] == 32'd2 && counts[0] == '1)

endmodule

`default_nettype wire
