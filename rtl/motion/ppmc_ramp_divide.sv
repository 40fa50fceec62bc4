// SPDX-License-Identifier: Apache-2.0
// ppmc_ramp_divide: bit-serial divider. The highest bit of dividend and quotient is first.
// Rules:  P104-RMP-02.
// Timing: a quotient bit follows its dividend bit by one cycle. run_i = 0 for one cycle ends a number.
// How:    non-restoring division: after a trial with a negative remainder, the next trial adds the divisor.
//         The sign of each trial is a quotient bit.
`default_nettype none

module ppmc_ramp_divide #(
    parameter int unsigned Width = 9  // bits of divisor_m1_i
) (
    input  wire logic             clk_i,
    input  wire logic             run_i,         // 1: bit_i is valid
    input  wire logic             bit_i,         // dividend bit
    input  wire logic [Width-1:0] divisor_m1_i,  // divisor - 1; stable while run_i = 1
    output logic                  bit_o          // quotient bit
);

  logic [Width:0] rem_q;  // remainder, -divisor .. divisor - 1
  logic [Width:0] trial;
  logic below, unused_carry;

  assign below = rem_q[Width];
  assign bit_o = !below;

  // The additional bit below the sum generates the carry-in.
  assign {trial, unused_carry} =
      {rem_q[Width-1:0], bit_i, below} + {{1'b0, divisor_m1_i} ^ {(Width + 1) {!below}}, below};

  always_ff @(posedge clk_i) begin
    if (!run_i) rem_q <= '0;
    else rem_q <= trial;
  end

endmodule

`default_nettype wire
