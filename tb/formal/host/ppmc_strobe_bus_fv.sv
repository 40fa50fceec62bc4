// SPDX-License-Identifier: Apache-2.0
// ppmc_strobe_bus_fv: for both bus styles, proves that each write strobe of the host causes one write of
// the byte that is valid at its end, that a complete read of a byte is reported once, and that the
// bus is driven only during reads.
`include "ppmc_fv.svh"
`default_nettype none

module ppmc_strobe_bus_fv (
    input wire logic       clk_i,
    input wire logic       style_i,
    input wire logic       cs_ni,
    input wire logic       rd_ni,
    input wire logic       wr_ni,
    input wire logic       a0_i,
    input wire logic [7:0] d_i,
    input wire logic [7:0] status_i,
    input wire logic [7:0] data_i,
    input wire logic       data_valid_i,
    input wire logic       data_new_i
);

  logic [7:0] d_o, wr_data_o;
  logic d_oe_o, wr_o, wr_a0_o, wr_busy_o, rd_busy_o, rd_done_o;

  `FV_RESET

  ppmc_strobe_bus dut (.*);

  `FV_ASSUME(static_style, style_i == $past(style_i))

  // Decoded sample of the pins.
  logic read, write;
  assign read  = !cs_ni && (style_i ? !wr_ni && rd_ni : !rd_ni && wr_ni);
  assign write = !cs_ni && !wr_ni && (style_i ? !rd_ni : rd_ni);

  logic w1_q, w2_q, w3_q, r1_q, r2_q;  // wN_q, rN_q: a write (w) or a read (r) was sampled N cycles ago
  logic [8:0] byte1_q, byte2_q, byte3_q;  // register and data of the writes

  always_ff @(posedge clk_i)
    if (!rst_ni) {w1_q, w2_q, w3_q, r1_q, r2_q, byte1_q, byte2_q, byte3_q} <= '0;
    else begin
      {w3_q, w2_q, w1_q} <= {w2_q, w1_q, write};
      {r2_q, r1_q}       <= {r1_q, read};
      byte1_q            <= {a0_i, d_i};
      byte2_q            <= byte1_q;
      if (w2_q) byte3_q <= byte2_q;
    end

  `FV_ASSERT(p104_bus_04_each_write_once, wr_o == (w3_q && !w2_q))
  `FV_ASSERT(p104_bus_04_last_sample, !wr_o || {wr_a0_o, wr_data_o} == byte3_q)
  `FV_ASSERT(p104_sta_02_busy_until_written, wr_busy_o == (w1_q || w2_q || w3_q))
  `FV_ASSERT(p104_bus_02_drives_in_reads_alone, d_oe_o == r1_q)
  `FV_ASSERT(p104_bus_05_stands_still, !(d_oe_o && r2_q && $past(r2_q && rst_ni)) || d_o == $past(d_o))
  `FV_ASSERT(p104_hsk_05_done_behind_a_read_alone, !rd_done_o || (!r2_q && $past(r2_q)))
  `FV_ASSERT(p104_hsk_05_done_once, !(rd_done_o && $past(rst_ni && rd_done_o)))

  logic wrote_q;
  always_ff @(posedge clk_i) wrote_q <= rst_ni && (wrote_q || wr_o);

  `FV_COVER(seen_read_and_write, rd_done_o && wrote_q)

endmodule

`default_nettype wire
