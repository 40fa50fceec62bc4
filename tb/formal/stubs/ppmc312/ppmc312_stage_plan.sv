// SPDX-License-Identifier: Apache-2.0
// ppmc312_stage_plan, stub for the proofs of the whole part: it is busy for three cycles, and then
// outputs any plan, which is stable until the next start. It does not use the arithmetic.
`default_nettype none

module ppmc312_stage_plan
  import ppmc312_stage_pkg::*;
(
    input  wire logic        clk_i,
    input  wire logic        rst_ni,
    input  wire logic        start_i,
    input  wire logic        ramp_i,
    input  wire logic        endless_i,
    input  wire logic [15:0] rate_i,
    input  wire logic [31:0] count_i,
    input  wire logic [ 6:0] first_acc_i,
    input  wire logic [ 6:0] first_dec_i,
    output logic             busy_o,
    output logic             both_o,
    output logic      [ 6:0] addr_o,
    input  wire logic [15:0] table_rate_i,
    input  wire logic [23:0] table_acc_i,
    input  wire logic [23:0] table_dec_i,
    output target_t          target_o,
    output logic             starts_with_accel_o,
    output logic      [ 7:0] kind_o,
    output logic      [23:0] dec_pulses_o,
    output ramp_pos_t        decel_start_o,
    output logic             op_start_o,
    output logic             op_mul_o,
    output logic      [23:0] op_lo_o,
    output logic      [24:0] operand_o,
    input  wire logic        op_busy_i,
    input  wire logic [23:0] lo_i
);

  typedef struct packed {
    target_t     target;
    logic        accel;
    logic [7:0]  kind;
    logic [23:0] dec_pulses;
    ramp_pos_t   decel_start;
  } plan_t;

  logic [1:0] left_q;
  logic both_q;
  plan_t any, plan_q;  // any: not driven; the register ensures that all blocks read the same value

`ifdef FV_COVERS
  // A constant rate of 4, so that a cover needs no search.
  assign any = '{target: '{rate: 16'd4, default: '0}, decel_start: '0, default: '0};
`endif

  assign busy_o = left_q != '0;
  assign both_o = both_q;
  assign {target_o, starts_with_accel_o, kind_o, dec_pulses_o, decel_start_o} = plan_q;
  assign {addr_o, op_start_o, op_mul_o, op_lo_o, operand_o} = '0;

  always_ff @(posedge clk_i or negedge rst_ni)
    if (!rst_ni) {left_q, both_q, plan_q} <= '0;
    else if (busy_o) begin
      left_q <= left_q - 1'b1;
      plan_q <= any;
    end else if (start_i) {left_q, both_q} <= {2'd3, ramp_i};

endmodule

`default_nettype wire
