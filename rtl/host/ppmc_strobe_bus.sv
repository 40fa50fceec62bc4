// SPDX-License-Identifier: Apache-2.0
// ppmc_strobe_bus: 8-bit host port with chip select, address line and two strobes, which it synchronises to
//         the clock of the core.
// Rules:  P104-BUS-01..07, P104-HSK-05 (read side), P104-PORT-02; P2104-BUS-01..10.
// Timing: write: when the end of a write strobe is first sampled at edge 0, wr_o is high in the cycle before
//         edge 2.
//         Read: when the start of a read strobe is sampled at edge 0, d_oe_o and d_o respond at edge 0,
//         because they use the strobes before the synchroniser. d_o is loaded again at edge 1, and is then
//         stable until the next read.
// Note:   bus style 0: read strobe rd_ni and write strobe wr_ni. Style 1: data strobe wr_ni, direction
//         rd_ni (1: read).
`include "ppmc_assert.svh"
`default_nettype none

module ppmc_strobe_bus (
    input  wire logic       clk_i,
    input  wire logic       rst_ni,
    input  wire logic       style_i,       // bus style, constant
    // pins
    input  wire logic       cs_ni,         // chip select
    input  wire logic       rd_ni,         // read strobe, or direction
    input  wire logic       wr_ni,         // write strobe, or data strobe
    input  wire logic       a0_i,          // 0: data, 1: status or command
    input  wire logic [7:0] d_i,           // data written by the host
    output logic      [7:0] d_o,           // data read by the host
    output logic            d_oe_o,        // 1: drive d_o, because the host reads
    // write side
    output logic            wr_o,          // strobe: a write is complete
    output logic            wr_a0_o,       // with wr_o; 1: command, 0: data
    output logic      [7:0] wr_data_o,     // written byte; valid with wr_o
    output logic            wr_busy_o,     // 1: a write is in progress; the status must indicate IBF = 1
    // read side
    input  wire logic [7:0] status_i,      // status byte for the host
    input  wire logic [7:0] data_i,        // data byte for the host
    input  wire logic       data_valid_i,  // 1: data_i has not been read yet
    input  wire logic       data_new_i,    // 1: data_i changes at the next edge
    output logic            rd_busy_o,     // 1: data_i is being read; the status must not report data_i
    output logic            rd_done_o      // strobe: data_i has been read
);

  typedef struct packed {
    logic cs_n;
    logic rd_n;
    logic wr_n;
  } strobes_t;

  function automatic logic is_read(strobes_t p, logic style);
    return !p.cs_n && (style ? !p.wr_n && p.rd_n : !p.rd_n && p.wr_n);
  endfunction

  function automatic logic is_write(strobes_t p, logic style);
    return !p.cs_n && !p.wr_n && (p.rd_n ^ style);
  endfunction

  strobes_t raw, s1, s2;
  logic a01, rd_raw, rd1, rd2, wr1, wr2;
  logic [7:0] d1;

  assign raw = {cs_ni, rd_ni, wr_ni};

  ppmc_sync #(
      .Width(3)
  ) u_sync (
      .clk_i,
      .rst_ni,
      .d_i (raw),
      .q1_o(s1),
      .q2_o(s2)
  );

  always_ff @(posedge clk_i) {a01, d1} <= {a0_i, d_i};

  always_comb begin
    rd_raw = is_read(raw, style_i);
    rd1    = is_read(s1, style_i);
    rd2    = is_read(s2, style_i);
    wr1    = is_write(s1, style_i);
    wr2    = is_write(s2, style_i);
  end

  // Write: the core receives the address and data of the last sample in which the strobe is active. a01 and
  // d1 are samples of the pins. While wr1 is high, they are copied to wr_a0_o and wr_data_o. At the end of
  // the strobe, wr1 may be metastable, so it is uncertain whether one more copy is made. This has no effect,
  // because address and data have been stable since the previous sample (P104-BUS-04).
  logic wr_s3_q;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      wr_s3_q   <= 1'b0;
      wr_a0_o   <= 1'b0;
      wr_data_o <= '0;
    end else begin
      wr_s3_q <= wr2;
      if (wr1) {wr_a0_o, wr_data_o} <= {a01, d1};
    end
  end

  assign wr_o      = wr_s3_q && !wr2;
  assign wr_busy_o = wr1 || wr2 || wr_s3_q;

  // Read: the byte counts as read if it was valid when d_o was loaded last, and if no new byte arrives
  // during the read. A strobe of only one sample does not load the data again. Therefore, a byte that
  // arrives at edge 0 of such a strobe is not output, and does not count as read.
  logic reading_q, new_q, new_s2_q;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      d_oe_o    <= 1'b0;
      d_o       <= '0;
      reading_q <= 1'b0;
      new_q     <= 1'b0;
      new_s2_q  <= 1'b0;
    end else begin
      d_oe_o <= rd_raw;
      new_q <= data_new_i;
      new_s2_q <= new_q;
      if (rd_raw && !(rd1 && rd2)) d_o <= a0_i ? status_i : data_i;
      if (data_new_i) reading_q <= 1'b0;
      else if (rd1 && !rd2) reading_q <= !a01 && data_valid_i && !rd_done_o;
      else reading_q <= rd_busy_o && rd2;
    end
  end

  assign rd_busy_o = reading_q && (rd1 || !new_s2_q);
  assign rd_done_o = rd_busy_o && !rd2;

`ifndef SYNTHESIS
  `PPMC_ASSERT(p104_bus_02, !(rd1 && wr1))
  `PPMC_ASSERT(p104_bus_06_once, !(wr_o && $past(wr_o)))
`endif

endmodule

`default_nettype wire
