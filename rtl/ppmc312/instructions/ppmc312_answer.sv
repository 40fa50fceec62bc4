// SPDX-License-Identifier: Apache-2.0
// ppmc312_answer: writes one answer into the store of class 2, byte after byte.
// Rules:  section 10.1, P312-GEN-04 (logical order), P312-RSP-10.
// Timing: 3 + bytes clk from start_i to done_o, answer_i stands still meanwhile. The echo
//         takes the bytes of the instruction from where it came from, two clk after echo_addr_o.
`default_nettype none

module ppmc312_answer
  import ppmc312_pkg::*;
  import ppmc312_link_pkg::*;
  import ppmc312_instr_pkg::*;
(
    input  wire logic                     clk_i,        // clock
    input  wire logic                     rst_ni,       // reset, asynchronous
    input  wire logic                     start_i,      // strobe
    input  wire answer_t                  answer_i,     // steady from start_i to done_o
    input  wire logic    [  BLOCK_BITS:0] blk_size_i,   // bytes of the instruction as written, 0 .. 32
    output logic                          busy_o,       // from the clk after start_i to that of done_o
    output logic                          done_o,       // strobe: it is written
    // where the instruction stands
    output logic         [BLOCK_BITS-1:0] echo_addr_o,  // 0 = header
    input  wire logic    [           7:0] echo_data_i,  // that byte, two clk later
    // store of class 2
    output answer_byte_t                  byte_o,       // a byte of the answer
    output logic         [  BLOCK_BITS:0] size_o        // bytes of the answer, 3 .. 32; with done_o
);

  logic [BLOCK_BITS:0] at_q, fixed, fixed_q;
  logic run_q;
  logic [BLOCK_BITS:0] own;  // code and parameters of the instruction
  logic [4:0] echo;  // of these, at most 28
  logic [8:0][7:0] shift_q;

  assign fixed = 6'd3 + 6'(answer_i.extra);
  assign busy_o = run_q;
  assign done_o = run_q && at_q == size_o;
  assign byte_o.we = run_q && at_q != size_o;
  assign byte_o.addr = at_q[BLOCK_BITS-1:0];
  assign own = (blk_size_i < 6'd3) ? 6'd0 : blk_size_i - 6'd2;
  assign echo = (own > 6'd28) ? 5'd28 : own[4:0];
  // Two ahead of the byte that is written; code and parameters begin at byte 2 of the instruction.
  assign echo_addr_o = BLOCK_BITS'(at_q - fixed_q + 6'd4);

  always_comb begin
    unique case (at_q)
      6'd0:    byte_o.data = answer_i.head;
      6'd1:    byte_o.data = 8'(size_o) - 8'd2;
      6'd2:    byte_o.data = answer_i.code;
      default: byte_o.data = (at_q < fixed_q) ? shift_q[0] : echo_data_i;
    endcase
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
      else at_q <= at_q + 1'b1;
    end
  end

  // The sizes stand with the first byte.
  always_ff @(posedge clk_i) begin
    fixed_q <= fixed;
    size_o  <= fixed + (answer_i.echo ? 6'(echo) : 6'd0);
    if (start_i) shift_q <= answer_i.data;
    else if (byte_o.we && at_q >= 6'd3) shift_q <= {8'h00, shift_q[8:1]};
  end

endmodule

`default_nettype wire
