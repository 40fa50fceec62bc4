// SPDX-License-Identifier: Apache-2.0
// ppmc_ramp_divide: divides a number that comes bit by bit, the highest first; the quotient goes out the same
// way.
// Rules:  P104-RMP-02.
// Timing: bit_o stands a clk after its bit_i. run_i = 0 for a clk begins a new number.
// How:    without restoring: after a trial that went below zero the next one adds. Each sign is a quotient
//         bit all the same.
`default_nettype none

module ppmc_ramp_divide #(
    parameter int unsigned Width = 9  // bits of less_i
) (
    input  wire logic             clk_i,
    input  wire logic             run_i,   // bit_i counts
    input  wire logic             bit_i,   // of the number
    input  wire logic [Width-1:0] less_i,  // divisor - 1; steady while run_i
    output logic                  bit_o    // of the quotient
);

  logic [Width:0] rem_q;  // remainder, -divisor .. divisor - 1
  logic [Width:0] trial;
  logic below, unused_carry;

  assign below = rem_q[Width];
  assign bit_o = !below;

  // Behind the sum a bit that makes the carry.
  assign {trial, unused_carry} =
      {rem_q[Width-1:0], bit_i, below} + {{1'b0, less_i} ^ {(Width + 1) {!below}}, below};

  always_ff @(posedge clk_i) begin
    if (!run_i) rem_q <= '0;
    else rem_q <= trial;
  end

endmodule

`default_nettype wire
