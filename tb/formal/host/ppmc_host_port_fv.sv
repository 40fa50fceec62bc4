// SPDX-License-Identifier: Apache-2.0
// ppmc_host_port_fv: the path from the pins to the mailbox and back. Proves that every complete write is
// accepted once and unchanged, and that a read consumes a byte only if one was available.
`include "ppmc_fv.svh"
`default_nettype none

module ppmc_host_port_fv (
    input wire logic        clk_i,
    input wire logic        cs_ni,
    input wire logic        rd_ni,
    input wire logic        wr_ni,
    input wire logic        a0_i,
    input wire logic [ 7:0] d_i,
    input wire logic [ 5:0] state_i,
    input wire logic        want_i,
    input wire logic        load_i,
    input wire logic        long_i,
    input wire logic [23:0] answer_i
);

  logic [7:0] d_o, byte_o;
  logic d_oe_o, ready_o, command_o, take_i, write;

  `FV_RESET

  ppmc_host_port dut (
      .style_i(1'b0),
      .*
  );

  assign take_i = want_i && ready_o;
  assign write  = !cs_ni && !wr_ni && rd_ni;

  logic w1_q, w2_q, w3_q, full_q;  // wN_q: write was high N cycles ago; full_q: a byte is pending
  // at1_q, at2_q: register and data 1 and 2 cycles ago; last_q: last write; held_q: pending byte
  logic [8:0] at1_q, at2_q, last_q, held_q;

  always_ff @(posedge clk_i)
    if (!rst_ni) {w1_q, w2_q, w3_q, full_q, at1_q, at2_q, last_q, held_q} <= '0;
    else begin
      {w3_q, w2_q, w1_q} <= {w2_q, w1_q, write};
      {at2_q, at1_q}     <= {at1_q, a0_i, d_i};
      if (w2_q) last_q <= at2_q;
      if (w3_q && !w2_q) {full_q, held_q} <= {1'b1, last_q};
      else if (take_i) full_q <= 1'b0;
    end

  `FV_ASSERT(p104_hsk_01_every_write_waits, dut.ibf == full_q)
  `FV_ASSERT(p104_hsk_02_as_written, !(ready_o && full_q) || {command_o, byte_o} == held_q)
  `FV_ASSERT(p104_hsk_03_taken_once, !take_i || full_q)
  `FV_ASSERT(p104_hsk_05_read_what_was_there, !dut.rd_done || dut.obf)
  `FV_COVER(seen_taken, take_i && !command_o && byte_o == 8'hA5)
  `FV_COVER(seen_read_away, dut.rd_done)

endmodule

`default_nettype wire
