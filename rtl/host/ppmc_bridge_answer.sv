// SPDX-License-Identifier: Apache-2.0
// ppmc_bridge_answer: stores the data of an answer in the answer buffer. The data are single bytes, and
//         blocks for IDENT, VERSION, RECORDED and COUNT.
// Rules:  docs/uart_bridge.md: operations IDENT, VERSION, RECORDED and COUNT; UB-ANS-02 (256 bytes),
//         UB-ANS-05 (free space).
// Timing: put_i stores a byte at the next edge. A block takes one cycle per byte. The block of COUNT is
//         restarted if its counter has changed while the block was stored. The full flags are valid two
//         cycles after the last byte.
// Assumes: each counter changes by one at a time, and at most once in 4 cycles. The block of COUNT is certain
//         to end only if the counter changes at most once in 8 cycles.
`default_nettype none

module ppmc_bridge_answer
  import ppmc_bridge_pkg::*;
#(
    parameter int unsigned Axes = 1,
    parameter logic [127:0] Ident = '0,  // data of operation IDENT; first byte in bits 7:0
    parameter logic [127:0] Build = '0  // data of operation VERSION
) (
    input  wire logic                 clk_i,
    input  wire logic                 rst_ni,
    input  wire logic                 clear_i,    // strobe: begin a new answer
    input  wire logic                 put_i,      // strobe: store one byte
    input  wire logic   [        7:0] data_i,     // byte; valid with put_i
    input  wire logic                 ident_i,    // strobe: begin a block of 16 bytes
    input  wire block_e               block_i,    // block to be stored; stable while busy_o = 1
    input  wire logic   [       63:0] info_i,     // data of RECORDED, 8 bytes; zeros follow them
    input  wire logic                 count_i,    // strobe: begin a block of 4 bytes for COUNT
    input  wire logic                 second_i,   // 1: COUNT of axis 2; stable while busy_o = 1
    input  wire logic   [Axes*32-1:0] counter_i,  // pulse counters; axis 1 is in bits 31:0
    output logic                      busy_o,     // 1: a block is being stored
    output logic                      full_o,     // 1: no space for another byte
    output logic                      full4_o,    // 1: no space for 4 bytes
    output logic                      full16_o,   // 1: no space for 16 bytes
    output logic        [        8:0] length_o,   // number of stored bytes
    // buffer
    output logic                      we_o,       // write enable of the buffer
    output logic        [        7:0] waddr_o,    // write address
    output logic        [        7:0] wdata_o     // write data
);

  logic counting_q, parity_q, recount;
  logic [31:0] counter;
  logic [ 3:0] left_q;

  if (Axes == 1) begin : g_one
    logic unused;
    assign unused  = second_i;
    assign counter = counter_i;
  end else begin : g_two
    assign counter = second_i ? counter_i[63:32] : counter_i[31:0];
  end

  assign recount   = busy_o && counting_q && left_q == '0 && counter[0] != parity_q;
  assign we_o    = put_i || busy_o;
  assign waddr_o = length_o[7:0];

  always_comb begin
    if (!busy_o) wdata_o = data_i;
    else if (counting_q) wdata_o = counter[{~left_q[1:0], 3'b000}+:8];
    else begin
      unique case (block_i)
        BlockVersion: wdata_o = Build[{~left_q, 3'b000}+:8];
        BlockRecorded: wdata_o = info_i[{~left_q[2:0], 3'b000}+:8] & {8{left_q[3]}};
        default: wdata_o = Ident[{~left_q, 3'b000}+:8];
      endcase
    end
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) busy_o <= 1'b0;
    else if (ident_i || count_i) busy_o <= 1'b1;
    else if (left_q == '0 && !recount) busy_o <= 1'b0;
  end

  always_ff @(posedge clk_i) begin
    full_o   <= length_o[8];
    full4_o  <= length_o > 9'd252;
    full16_o <= length_o > 9'd240;
    if (clear_i) length_o <= '0;
    else if (we_o) length_o <= length_o + {{7{recount}}, 2'b01};  // +1 per byte; -3 when COUNT is restarted
    if (ident_i || count_i) begin
      counting_q <= count_i;
      left_q     <= count_i ? 4'd3 : 4'd15;
    end else begin
      left_q <= recount ? 4'd3 : left_q - 1'b1;
    end
    if (left_q[0] && left_q[1]) parity_q <= counter[0];
  end

endmodule

`default_nettype wire
