// SPDX-License-Identifier: Apache-2.0
// ppmc_bridge_answer: collects the data of an answer in its buffer: single bytes, IDENT, VERSION, RECORDED, COUNT.
// Rules:  UB ops IDENT, VERSION, RECORDED and COUNT, UB-ANS-02 (256 bytes), UB-ANS-05 (room).
// Timing: put_i stores a byte at once. A block takes one clk a byte; COUNT begins anew when the counter has moved
//         meanwhile. The room flags are right two clk after the last byte.
// Needs:  each counter changes by one at a time and not twice within 4 clk; for COUNT to end not within 8.
`default_nettype none

module ppmc_bridge_answer
  import ppmc_bridge_pkg::*;
#(
    parameter int unsigned Axes = 1,
    parameter logic [127:0] Ident = '0,  // first byte in the low bits
    parameter logic [127:0] Build = '0  // answer of VERSION
) (
    input  wire logic                 clk_i,
    input  wire logic                 rst_ni,
    input  wire logic                 clear_i,    // a new answer
    input  wire logic                 put_i,      // one byte more
    input  wire logic   [        7:0] data_i,     // with put_i
    input  wire logic                 ident_i,    // begin a block of 16 bytes, one clk
    input  wire block_e               block_i,    // which; stands while busy_o
    input  wire logic   [       63:0] info_i,     // answer of RECORDED, zeros follow
    input  wire logic                 count_i,    // begin a block of COUNT, one clk
    input  wire logic                 second_i,   // COUNT of axis 2; stands while busy_o
    input  wire logic   [Axes*32-1:0] counter_i,  // pulse counters, axis 1 in the low bits
    output logic                      busy_o,     // a block is on its way
    output logic                      full_o,     // no room for one more byte
    output logic                      full4_o,    // no room for 4
    output logic                      full16_o,   // no room for 16
    output logic        [        8:0] length_o,   // bytes so far
    // buffer
    output logic                      we_o,       // write into the buffer
    output logic        [        7:0] waddr_o,    // where
    output logic        [        7:0] wdata_o     // what
);

  logic counting_q, parity_q, again;
  logic [31:0] counter;
  logic [ 3:0] left_q;

  if (Axes == 1) begin : g_one
    logic unused;
    assign unused  = second_i;
    assign counter = counter_i;
  end else begin : g_two
    assign counter = second_i ? counter_i[63:32] : counter_i[31:0];
  end

  assign again   = busy_o && counting_q && left_q == '0 && counter[0] != parity_q;
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
    else if (left_q == '0 && !again) busy_o <= 1'b0;
  end

  always_ff @(posedge clk_i) begin
    full_o   <= length_o[8];
    full4_o  <= length_o > 9'd252;
    full16_o <= length_o > 9'd240;
    if (clear_i) length_o <= '0;
    else if (we_o) length_o <= length_o + {{7{again}}, 2'b01};  // three back or one on
    if (ident_i || count_i) begin
      counting_q <= count_i;
      left_q     <= count_i ? 4'd3 : 4'd15;
    end else begin
      left_q <= again ? 4'd3 : left_q - 1'b1;
    end
    if (left_q[0] && left_q[1]) parity_q <= counter[0];
  end

endmodule

`default_nettype wire
