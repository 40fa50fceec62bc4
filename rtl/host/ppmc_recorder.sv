// SPDX-License-Identifier: Apache-2.0
// ppmc_recorder: logic analyser that records every change of the watched levels, and the time since the
//         previous record.
// Rules:  docs/uart_bridge.md, UB-REC.
// Timing: a record is {levels, time}, lowest bit first. The levels are sampled by flip-flops. The time is
//         the number of cycles since the sample of the previous record; it has TimeBits bits. A record is
//         also written when the time reaches its maximum without a change. Changes in successive cycles are
//         all recorded. The bytes of the records are read in order. data_o is valid 4 cycles after begin_i,
//         rewind_i or next_i.
`include "ppmc_assert.svh"
`default_nettype none

module ppmc_recorder
  import ppmc_recorder_pkg::*;
#(
    parameter int unsigned Width = 48,  // number of levels
    parameter int unsigned AddrBits = 10  // 2**AddrBits records, AddrBits = 4 .. 16; see ppmc_recorder_ram
) (
    input wire logic clk_i,
    input wire logic rst_ni,
    input wire logic [Width-1:0] watch_i,  // levels, synchronous to clk_i
    // strobes
    input wire logic begin_i,  // clear and start; the first record is the current state
    input wire logic end_i,  // write the last record, even without a change
    input wire logic rewind_i,  // continue with the first byte of the first record
    input wire logic next_i,  // continue with the next byte
    output logic [7:0] data_o,  // byte of the records; 0 while recording
    output logic [63:0] info_o  // data of op RECORDED; first byte in bits 7:0
);

  localparam int unsigned Bytes = record_bytes(Width);
  localparam int unsigned TimeBits = 8 * Bytes - Width;
  localparam int unsigned Lane = 16;  // levels that are compared together
  localparam int unsigned Lanes = (Width + Lane - 1) / Lane;

  logic running_q, first_q, full_q, rest_q, we, write_req;
  logic [Width-1:0] levels_q;
  logic [Lanes-1:0] changed_q;
  logic [TimeBits-1:0] time_q;
  logic [AddrBits:0] count_q;

  // ---------------------------------------------------------------- levels

  logic [Lanes*Lane-1:0] differ;
  assign differ = (Lanes * Lane)'(watch_i ^ levels_q);

  always_ff @(posedge clk_i) begin
    levels_q <= watch_i;
    for (int unsigned n = 0; n < Lanes; n++) changed_q[n] <= |differ[Lane*n+:Lane];
  end

  // ---------------------------------------------------------------- records

  assign write_req = running_q && (first_q || end_i || changed_q != '0 || rest_q);
  assign we        = write_req && !count_q[AddrBits];

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      running_q <= 1'b0;
      full_q    <= 1'b0;
      count_q   <= '0;
    end else begin
      if (begin_i) count_q <= '0;
      else if (we) count_q <= count_q + 1'b1;
      if (begin_i) {running_q, full_q} <= 2'b10;
      else if (write_req) {running_q, full_q} <= {we && !end_i, !we};
    end
  end

  always_ff @(posedge clk_i) begin
    first_q <= begin_i;
    time_q  <= begin_i ? '0 : we ? TimeBits'(1) : time_q + 1'b1;
    rest_q  <= !begin_i && !we && time_q == ~TimeBits'(1);  // 1 when time_q reaches its maximum
  end

  // ---------------------------------------------------------------- bytes

  localparam int unsigned ByteBits = $clog2(Bytes);
  localparam int unsigned Pairs = (Bytes + 1) / 2;
  logic [AddrBits-1:0] read_addr_q;
  logic [ByteBits-1:0] byte_q, pair;
  logic [8*Bytes-1:0] record;

  ppmc_recorder_ram #(
      .Width   (8 * Bytes),
      .AddrBits(AddrBits)
  ) u_ram (
      .clk_i,
      .we_i   (we),
      .addr_i (running_q ? count_q[AddrBits-1:0] : read_addr_q),
      .wdata_i({levels_q, time_q}),
      .rdata_o(record)
  );

  // Two multiplexer stages, because a block RAM of an ECP5 already needs half a cycle at 100 MHz.
  logic [16*Pairs-1:0] padded;
  logic [ 8*Pairs-1:0] byte_of_pair_q;
  assign padded = (16 * Pairs)'(record);
  assign pair   = byte_q >> 1;

  always_ff @(posedge clk_i) begin
    for (int unsigned n = 0; n < Pairs; n++) byte_of_pair_q[8*n+:8] <= padded[16*n+8*byte_q[0]+:8];
    data_o <= byte_of_pair_q[8*pair+:8] & {8{!running_q}};
    if (begin_i || rewind_i) {read_addr_q, byte_q} <= '0;
    else if (next_i) begin
      byte_q <= byte_q == ByteBits'(Bytes - 1) ? '0 : byte_q + 1'b1;
      read_addr_q <= read_addr_q + AddrBits'(byte_q == ByteBits'(Bytes - 1));
    end
  end

  assign info_o = {32'(count_q), 6'd0, full_q, running_q, 8'(AddrBits), 8'(TimeBits), 8'(Bytes)};

`ifndef SYNTHESIS
  `PPMC_ASSERT(ub_rec_full_is_the_end, !(full_q && running_q))
`endif

endmodule

`default_nettype wire
