// SPDX-License-Identifier: Apache-2.0
// ppmc_char_host_fv: for any characters, proves that each complete request to the device causes exactly one
// strobe of 8 cycles with its address and data, that nothing else causes a strobe, and that only a write of
// the control byte changes the straps and the reset of the device.
`include "ppmc_fv.svh"
`default_nettype none

module ppmc_char_host_fv (
    input wire logic       clk_i,
    input wire logic       rxd_i,
    input wire logic [7:0] d_i,
    input wire logic [7:0] pins_i
);

  logic txd_o, cs_no, rd_no, wr_no, part_rst_no, active_o;
  logic [3:0] a_o;
  logic [6:0] straps_o;
  logic [7:0] d_o;

  `FV_RESET

  ppmc_char_host #(
      .ClkHz (4000),
      .XtalHz(1_000_000),
      .Baud  (100)
  ) dut (
      .*
  );

  // Characters are at least 16 cycles apart. In fact, the receiver needs at least 9 bit times of 40 cycles
  // for each character.
  logic [3:0] gap_q;
  `FV_ASSUME(chars_apart, !(dut.received || dut.error) || gap_q == '0)

  // Expected decoding of a request, according to docs/char_host.md.
  logic [7:0] first_q;
  logic second_q, complete, own, write;
  assign complete = dut.received && (dut.char[7] ? !dut.char[6] : second_q);
  assign own      = dut.char[7] ? dut.char[5] : first_q[5];
  assign write    = !dut.char[7];

  logic [1:0] device_q;  // [n]: a request to the device was completed n + 1 cycles ago
  logic own_write_q;
  logic write_q;
  logic [3:0] length_q;  // cycles of the strobe so far
  logic [7:0] char_q, control_q;

  always_ff @(posedge clk_i)
    if (!rst_ni) begin
      {second_q, gap_q, device_q, own_write_q, length_q} <= '0;
      control_q <= '1;
    end else begin
      gap_q <= (dut.received || dut.error) ? '1 : gap_q - 4'(gap_q != '0);
      if (dut.received || dut.error) second_q <= dut.received && dut.char[7] && dut.char[6];
      if (dut.received && dut.char[7]) first_q <= dut.char;
      if (complete) {write_q, char_q} <= {write, dut.char};
      device_q    <= {device_q[0], complete && !own};
      own_write_q <= complete && own && write;
      length_q    <= cs_no ? '0 : length_q + 1'b1;
      if (own_write_q) control_q <= {first_q[0], char_q[6:0]};
    end

  `FV_ASSERT(one_strobe, cs_no == (rd_no && wr_no) && (rd_no || wr_no))
  `FV_ASSERT(only_a_request_begins_a_strobe, (!cs_no && $past(cs_no)) == device_q[1])
  `FV_ASSERT(strobe_lasts_8_cycles, cs_no ? !$past(!cs_no) || $past(length_q) == 4'd7 : length_q <= 4'd7)
  `FV_ASSERT(kind_and_address, cs_no || (wr_no == !write_q && a_o == first_q[4:1]))
  `FV_ASSERT(written_byte, wr_no || d_o == {first_q[0], char_q[6:0]})
  `FV_ASSERT(stable_around_the_strobe, (cs_no && $past(cs_no)) || {a_o, d_o} == $past({a_o, d_o}))
  `FV_ASSERT(own_write_sets_control, straps_o == control_q[6:0])
  `FV_ASSERT(reset_follows_control, !$past(rst_ni) || part_rst_no == $past(control_q[7]))
  `FV_COVER(seen_read, !rd_no && a_o == 4'd9)
  `FV_COVER(seen_write, !wr_no && d_o == 8'hA5)
  `FV_COVER(seen_reset, !part_rst_no && straps_o == 7'h2A)

endmodule

`default_nettype wire
