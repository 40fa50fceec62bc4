// SPDX-License-Identifier: Apache-2.0
// ppmc312_answer: writes one answer into the store of class 2, byte after byte.
// Rules:  section 10.1, P312-GEN-04 (logical order), P312-RSP-10.
// Timing: 3 + bytes clk from start_i to done_o, answer_i stands still meanwhile. The echo
//         takes the bytes of the instruction from where it came from, two clk after echo_addr_o.
`default_nettype none

module ppmc312_answer
  import ppmc312_pkg::*;
(
    input  wire logic                     clk_i,
    input  wire logic                     rst_ni,
    input  wire logic                     start_i,
    input  wire answer_t                  answer_i,
    input  wire logic    [           4:0] echo_bytes_i,  // code and parameters, at most 28
    output logic                          busy_o,
    output logic                          done_o,
    // where the instruction stands
    output logic         [BLOCK_BITS-1:0] echo_addr_o,
    input  wire logic    [           7:0] echo_data_i,
    // store of class 2
    output logic                          we_o,
    output logic         [BLOCK_BITS-1:0] addr_o,
    output logic         [           7:0] data_o,
    output logic         [  BLOCK_BITS:0] size_o
);

  logic [BLOCK_BITS:0] at_q, fixed, fixed_q;
  logic run_q;
  logic [8:0][7:0] shift_q;

  assign fixed = 6'd3 + 6'(answer_i.extra);
  assign busy_o = run_q;
  assign done_o = run_q && at_q == size_o;
  assign we_o = run_q && at_q != size_o;
  assign addr_o = at_q[BLOCK_BITS-1:0];
  // Two ahead of the byte that is written; code and parameters begin at byte 2 of the instruction.
  assign echo_addr_o = BLOCK_BITS'(at_q - fixed_q + 6'd4);

  always_comb begin
    unique case (at_q)
      6'd0:    data_o = answer_i.head;
      6'd1:    data_o = 8'(size_o) - 8'd2;
      6'd2:    data_o = answer_i.code;
      default: data_o = (at_q < fixed_q) ? shift_q[0] : echo_data_i;
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
    size_o  <= fixed + (answer_i.echo ? 6'(echo_bytes_i) : 6'd0);
    if (start_i) shift_q <= answer_i.data;
    else if (we_o && at_q >= 6'd3) shift_q <= {8'h00, shift_q[8:1]};
  end

endmodule

`default_nettype wire
