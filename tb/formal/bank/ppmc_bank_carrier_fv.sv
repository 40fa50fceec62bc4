// SPDX-License-Identifier: Apache-2.0
// ppmc_bank_carrier_fv: a carrier with UART host and four axes, an unconstrained bank and an unconstrained
// host. Proves that the bank receives the bus strobes as ppmc_bank_axis_port passes them on, that
// operation PINS reads the switches of the selected axis, and that the LEDs indicate motion and
// switches.
`include "ppmc_fv.svh"
`default_nettype none

module ppmc_bank_carrier_fv (
    input wire logic       clk_i,
    input wire logic       uart_rxd,
    input wire logic       spi_cs_n,
    input wire logic       sck,
    input wire logic       mosi,
    input wire logic [3:0] l1_n,
    input wire logic [3:0] l2_n,
    input wire logic [3:0] l3_n,
    input wire logic [3:0] l4_n,
    input wire logic [3:0] cnp_n,
    input wire logic [3:0] alm_n
);

  logic uart_txd, miso_o, miso_oe, int_n, led_link, led_moving, led_switch;
  logic [19:0] s;
  logic [3:0] hold, pout_n, dir;

  `FV_RESET

  ppmc_bank_carrier #(
      .CLK_HZ(8_000_000),
      .AXES  (4)
  ) dut (
      .clk  (clk_i),
      .rst_n(rst_ni),
      .*
  );

  // Number of the axis that the host has selected with register 3.
  logic [7:0] axis_q;
  logic is_select, select_write;
  logic [1:0] pins_axis;

  assign is_select    = dut.g_uart.host_a == 4'h3;
  assign select_write = is_select && !dut.g_uart.host_cs_n && !dut.part_wr_n;
  assign pins_axis    = axis_q[1:0];

  always_ff @(posedge clk_i or negedge dut.part_rst_n)
    if (!dut.part_rst_n) axis_q <= '0;
    else if (select_write) axis_q <= dut.to_part;

  logic was_reset_q;  // 1: the host has reset the bank; ppmc_uart_host begins with this reset
  always_ff @(posedge clk_i) was_reset_q <= rst_ni && (was_reset_q || !dut.part_rst_n);

  logic accessed_q;
  always_ff @(posedge clk_i)
    accessed_q <= rst_ni && was_reset_q && (accessed_q || (!dut.part_cs_n && axis_q == 8'd2));

  `FV_ASSERT(bank_win_04_selected_axis,
             !was_reset_q || dut.part_cs_n || dut.part_a == {axis_q[5:0], dut.g_uart.host_a})
  `FV_ASSERT(no_strobe_without_host,
             !was_reset_q || dut.part_cs_n || (!dut.g_uart.host_cs_n && !is_select && axis_q[7:6] == '0))
  `FV_ASSERT(
      reads_bank_or_axis_select,
      !was_reset_q || dut.g_uart.to_host == (is_select ? axis_q : axis_q[7:6] != '0 ? 8'hFF : dut.from_part))
  logic pins_of_selected_axis_holds;
  assign pins_of_selected_axis_holds =
      !was_reset_q ||
      dut.g_uart.u_host.switches_ni == {
        alm_n[pins_axis], cnp_n[pins_axis], l4_n[pins_axis], l3_n[pins_axis], l2_n[pins_axis], l1_n[pins_axis]
      } &&
      dut.g_uart.u_host.hold_i == hold[pins_axis];
  `FV_ASSERT(pins_of_selected_axis, pins_of_selected_axis_holds)
  logic switches_reach_the_bank_holds;
  assign switches_reach_the_bank_holds =
      dut.u_part.alm_n == alm_n && dut.u_part.cnp_n == cnp_n &&
      {dut.u_part.l4_n, dut.u_part.l3_n, dut.u_part.l2_n, dut.u_part.l1_n} == {l4_n, l3_n, l2_n, l1_n};
  `FV_ASSERT(switches_reach_the_bank, switches_reach_the_bank_holds)
  `FV_ASSERT(leds, led_moving == (hold != '1) && led_switch == ({l1_n, l2_n, l3_n, l4_n, alm_n} != '1))
  `FV_ASSERT(spi_idle, !miso_oe && !miso_o)
  `FV_COVER(seen_axis, accessed_q && dut.part_cs_n)

endmodule

`default_nettype wire
