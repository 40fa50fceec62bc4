// SPDX-License-Identifier: Apache-2.0
// ppmc312_stage_builder, stub for the proofs of the whole part: it is busy for five cycles, and may write any
// word in each of them. It does not use the arithmetic.
`default_nettype none

module ppmc312_stage_builder
  import ppmc312_stage_pkg::*;
(
    input  wire logic           clk_i,
    input  wire logic           rst_ni,
    input  wire logic           start_i,
    input  wire curve_t         curve_i,
    output logic                busy_o,
    output logic                too_few_pulses_o,
    output table_write_t        table_write_o,
    output logic         [ 1:0] begins_o,
    input  wire logic    [ 6:0] first_acc_i,
    input  wire logic    [ 6:0] first_dec_i,
    output logic                op_start_o,
    output logic                op_mul_o,
    output logic         [ 5:0] op_steps_o,
    output logic         [23:0] op_lo_o,
    output logic         [39:0] word_o,
    input  wire logic           op_busy_i,
    input  wire logic    [39:0] hi_i,
    input  wire logic    [23:0] lo_i
);

  logic [2:0] left_q;
  logic bad, bad_q;  // any value; each register ensures that all blocks read the same value
  logic [1:0] begins, begins_q;
  table_write_t word, word_q;

`ifdef FV_COVERS
  assign {bad, begins, word} = '0;  // so that a cover needs no search
`endif

  assign busy_o                                              = left_q != '0;
  assign table_write_o                                       = word_q;
  assign begins_o                                            = begins_q & {2{word_q.we_rate}};
  assign too_few_pulses_o                                    = bad_q;
  assign {op_start_o, op_mul_o, op_steps_o, op_lo_o, word_o} = '0;

  always_ff @(posedge clk_i or negedge rst_ni)
    if (!rst_ni) {left_q, bad_q, begins_q, word_q} <= '0;
    else begin
      {begins_q, word_q} <= {begins, word};
      if (busy_o) left_q <= left_q - 1'b1;
      else if (start_i) {left_q, bad_q} <= {3'd5, bad};
    end

endmodule

`default_nettype wire
