// SPDX-License-Identifier: Apache-2.0
// ppmc312_response_writer: writes a response byte by byte into the queue of class 2.
// Rules:  docs/ppmc312/README.md, 6.1; P312-GEN-04 (logical order), P312-RSP-10.
// Timing: done_o follows start_i by 3 cycles plus one cycle per byte. For an echo, echo_data_i is valid two
//         cycles after echo_addr_o.
// Assumes: response_i is stable from start_i to done_o.
`default_nettype none

module ppmc312_response_writer
  import ppmc312_pkg::*;
  import ppmc312_link_pkg::*;
  import ppmc312_instr_pkg::*;
(
    input wire logic clk_i,  // clock
    input wire logic rst_ni,  // reset, asynchronous
    input wire logic start_i,  // strobe: write response_i
    input wire response_t response_i,  // stable from start_i to done_o
    input wire logic [BLOCK_BITS:0] blk_size_i,  // bytes that the host has written, 0 .. 32
    output logic busy_o,  // from the cycle after start_i to the cycle of done_o
    output logic done_o,  // strobe: the response is written
    // sources of the last bytes
    input wire logic [31:0] value_i,  // TailPos: position
    input wire logic [5:0][7:0] sums_i,  // TailSums: sums of the acceleration and deceleration pulses
    input wire logic [2:0] codes_i,  // TailCodes: number of codes
    output logic peek_o,  // TailCodes; 1: a code is requested
    output logic [1:0] peek_at_o,  // TailCodes: entry of this code
    input wire logic [7:0] code_i,  // code of the entry that peek_at_o selected two cycles earlier
    // bytes of the instruction
    output logic [BLOCK_BITS-1:0] echo_addr_o,  // byte number, 0 = header
    input wire logic [7:0] echo_data_i,  // byte at echo_addr_o, two cycles later
    // queue of class 2
    output response_write_t response_write_o,  // byte of the response
    output logic [BLOCK_BITS:0] size_o  // bytes of the response, 3 .. 32; with done_o
);

  logic [BLOCK_BITS:0] at_q;
  logic [BLOCK_BITS:0] beyond_q;  // index of the current byte in the echo; negative before the echo
  logic run_q;
  logic [BLOCK_BITS:0] len_q;  // length byte: bytes of the response minus two
  logic [3:0] rest;  // bytes after the current byte, except the echo
  logic [7:0] tail;
  logic in_tail;

  assign size_o = {5'(ppmc_pkg::inc(32'(len_q[5:1]))), len_q[0]};
  assign busy_o = run_q;
  assign done_o = run_q && at_q == size_o;
  assign response_write_o.we = run_q && at_q != size_o;
  assign response_write_o.addr = at_q[BLOCK_BITS-1:0];
  // The address is two bytes ahead of the byte that is being written. Code and parameters begin at byte 2
  // of the instruction.
  assign echo_addr_o = {3'(ppmc_pkg::inc(32'(beyond_q[4:2]))), beyond_q[1:0]};  // beyond_q + 4
  assign rest = ~beyond_q[3:0];
  assign peek_o = run_q && response_i.tail == TailCodes;
  assign peek_at_o = 2'd1 - rest[1:0];

  always_comb begin
    unique case (response_i.tail)
      TailPos: begin
        in_tail = rest < 4'd4;
        tail    = value_i[8*rest[1:0]+:8];
      end
      TailCodes: begin
        in_tail = rest < 4'd4;
        tail    = (3'd3 - {1'b0, rest[1:0]} < codes_i) ? code_i : 8'h00;
      end
      TailSums: begin
        in_tail = rest < 4'd6;
        tail    = sums_i[rest[2:0]];
      end
      default: begin
        in_tail = 1'b0;
        tail    = 8'h00;
      end
    endcase
  end

  always_comb begin
    unique case (at_q)
      6'd0:    response_write_o.data = response_i.head;
      6'd1:    response_write_o.data = 8'(len_q);
      6'd2:    response_write_o.data = response_i.code;
      6'd3:    response_write_o.data = response_i.data[0];
      6'd4:    response_write_o.data = response_i.data[1];
      default: response_write_o.data = response_i.data[2];
    endcase
    if (in_tail) response_write_o.data = tail;
    if (!beyond_q[BLOCK_BITS]) response_write_o.data = echo_data_i;
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      run_q <= 1'b0;
      at_q  <= '0;
    end else if (start_i) begin
      run_q <= 1'b1;
      at_q  <= '0;
    end else if (run_q) begin
      if (at_q == size_o) run_q <= 1'b0;
      else at_q <= 6'(ppmc_pkg::inc(32'(at_q)));
    end
  end

  // The length must be valid when the first byte is written.
  always_ff @(posedge clk_i) begin
    // An echo follows the code and one byte. It contains the instruction without header and length, at most
    // 28 bytes.
    if (!response_i.echo) len_q <= 6'(ppmc_pkg::inc(32'(response_i.extra)));
    else if (blk_size_i[5:1] == '0) len_q <= 6'd2;
    else len_q <= (blk_size_i[5] || blk_size_i[4:0] == '1) ? 6'd30 : blk_size_i;
    if (start_i)
      beyond_q <= ~{5'(ppmc_pkg::inc(32'(response_i.extra[3:1]))), response_i.extra[0]};  // -(extra + 3)
    else beyond_q <= 6'(ppmc_pkg::inc(32'(beyond_q)));
  end

endmodule

`default_nettype wire
