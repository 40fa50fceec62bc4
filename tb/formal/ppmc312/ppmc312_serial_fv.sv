// SPDX-License-Identifier: Apache-2.0
// ppmc312_serial_fv: proves the connections of the blocks of the station: a block that the core reads is
// not changed, and each reply has a frame. Characters are any bytes, at least 9 cycles apart, and a bit has
// 2 cycles.
`include "ppmc_fv.svh"
`default_nettype none

module ppmc312_serial_fv
  import ppmc312_pkg::*;
  import ppmc312_link_pkg::*;
  import ppmc312_serial_pkg::*;
(
    input wire logic               clk_i,
    input wire logic               ready_i,
    input wire logic               enable_i,
    input wire logic         [3:0] adr_i,
    input wire logic               rxd_i,
    input wire host_result_t       host_result_i,
    input wire logic         [7:0] rd_data_i,
    input wire status_e            status_i,
    input wire poll_result_t       poll_result_i
);

  logic txd_o, snd_o, report_take_o;
  host_block_t host_block_o;
  block_write_t block_write_o;
  logic [4:0] rd_addr_o;

  `FV_RESET

  ppmc312_serial #(
      .ClkHz (1),
      .XtalHz(96)
  ) dut (
      .rate_i(2'd3),
      .*
  );

  logic [3:0] gap_q;  // cycles since the last character, at most 8
  logic char;
  assign char = dut.valid || dut.error;
  always_ff @(posedge clk_i)
    if (!rst_ni || char) gap_q <= '0;
    else if (gap_q != 4'd8) gap_q <= gap_q + 4'd1;

  `FV_ASSUME(apart, !char || gap_q == 4'd8)
  `FV_ASSUME(off_is_silent, enable_i || !char)
  `FV_ASSUME(static_pins, {enable_i, adr_i} == $past({enable_i, adr_i}))
  `FV_ASSUME(stays_ready, ready_i || !$past(rst_ni && ready_i))
  `FV_ASSUME(executes_a_valid_block, !host_result_i.valid || host_block_o.valid)

  // verilog_format: off
  `FV_ASSUME(
      result_of_a_host_block,
      !$past(host_result_i.valid) || host_result_i.code[7:4] != 4'hf
          || host_result_i.code[3:0] inside {4'd0, 4'd1, 4'd2, 4'd5, 4'd6, 4'd7})
  // verilog_format: on

  logic frame, owed_q, executed_q, valid_q, snd_q;
  logic [5:0] size_q;
  assign frame = dut.poll || dut.run || dut.fault || dut.unknown_code;

  always_ff @(posedge clk_i) begin
    valid_q <= rst_ni && host_block_o.valid;
    size_q  <= host_block_o.size;
    snd_q   <= rst_ni && snd_o;
    if (!rst_ni) {owed_q, executed_q} <= '0;
    else begin
      if (frame) {owed_q, executed_q} <= 2'b10;
      else if (dut.sent) owed_q <= 1'b0;
      if (host_result_i.valid) executed_q <= 1'b1;
    end
  end

  `FV_ASSERT(p312_gen_04_block_stands, !(host_block_o.valid && block_write_o.we))
  `FV_ASSERT(p312_gen_04_size_stands, !(host_block_o.valid && valid_q) || host_block_o.size == size_q)
  `FV_ASSERT(p312_gen_04_valid_until_executed, !valid_q || host_block_o.valid || $past(host_result_i.valid))
  `FV_ASSERT(runs_once, !host_block_o.valid || (owed_q && !executed_q))
  `FV_ASSERT(p312_ser_19_reply_has_a_frame, !snd_o || owed_q)
  `FV_ASSERT(p312_ser_19_one_frame, !(frame && owed_q))
  `FV_ASSERT(p312_ser_30_takes_after_a_poll, report_take_o == $past(rst_ni && dut.poll))
  `FV_ASSERT(p312_bad_17_silent, enable_i || (!snd_o && txd_o && !host_block_o.valid && !report_take_o))
  `FV_ASSERT(p312_prt_02_waits, ready_i || (!snd_o && !host_block_o.valid))

  `FV_COVER(seen_block, host_block_o.valid)
  `FV_COVER(seen_reply, snd_q && !snd_o)

endmodule

`default_nettype wire
