// SPDX-License-Identifier: Apache-2.0
// ppmc_ramp_serial, stub for the proof of ppmc_ramp_builder: each pass takes two cycles, and all sums are
// 0. ppmc_ramp_serial_fv proves the length of a real pass.
`default_nettype none

module ppmc_ramp_serial
  import ppmc_ramp_pkg::*;
#(
    parameter  int unsigned StepBits = 14,
    parameter  int unsigned RateBits = 8,
    localparam int unsigned Width    = RateBits + 1
) (
    input  wire logic              clk_i,
    input  wire logic              rst_ni,
    input  wire logic              start_i,
    input  wire pass_e             next_i,
    input  wire pass_e             pass_i,
    input  wire logic              mul_i,
    input  wire logic              keep_i,
    input  wire logic              init_i,
    input  wire logic  [Width-1:0] first_i,
    input  wire logic  [Width-1:0] second_i,
    output logic                   bit_o,
    output logic                   use_o,
    output logic                   last_o
);

  logic run_q;

  assign bit_o = 1'b0;
  assign use_o = last_o;

  always_ff @(posedge clk_i or negedge rst_ni)
    if (!rst_ni) {last_o, run_q} <= '0;
    else {last_o, run_q} <= {run_q, start_i};

endmodule

`default_nettype wire
