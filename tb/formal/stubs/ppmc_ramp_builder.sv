// SPDX-License-Identifier: Apache-2.0
// ppmc_ramp_builder, stub for the proofs of the blocks that instantiate it: it is busy for five cycles, and
// writes one word in the third cycle. ppmc_ramp_builder_fv proves that a build of the real builder
// ends.
`default_nettype none

module ppmc_ramp_builder #(
    parameter int unsigned RateBits = 8,
    parameter int unsigned StepBits = 14
) (
    input  wire logic                clk_i,
    input  wire logic                rst_ni,
    input  wire logic                start_i,
    input  wire logic [RateBits-1:0] slow_i,
    input  wire logic [RateBits-1:0] fast_i,
    input  wire logic [StepBits-1:0] steps_i,
    output logic                     busy_o,
    output logic                     we_o,
    output logic      [RateBits-1:0] addr_o,
    output logic      [StepBits-1:0] data_o
);

  logic [2:0] left_q;
  logic [RateBits-1:0] rate_q;

  assign busy_o = left_q != '0;
  assign we_o   = left_q == 3'd3;
  assign addr_o = rate_q;
  assign data_o = steps_i;

  always_ff @(posedge clk_i or negedge rst_ni)
    if (!rst_ni) left_q <= '0;
    else if (busy_o) left_q <= left_q - 1'b1;
    else if (start_i) left_q <= 3'd5;

  // The start-up rate remains stored after a build.
  always_ff @(posedge clk_i) if (busy_o) rate_q <= slow_i;

endmodule

`default_nettype wire
