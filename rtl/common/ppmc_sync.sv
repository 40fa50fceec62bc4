// SPDX-License-Identifier: Apache-2.0
// ppmc_sync: two-stage synchroniser; every asynchronous pin uses it.
// Rules:  P104-PORT-02.
// Timing: a level first sampled at edge t appears on q1_o after edge t and on q2_o after edge t + 1.
`default_nettype none

module ppmc_sync #(
    parameter int unsigned             Width    = 1,
    parameter logic        [Width-1:0] ResetVal = '1  // inactive level, during reset
) (
    input  wire logic             clk_i,
    input  wire logic             rst_ni,
    input  wire logic [Width-1:0] d_i,     // pins, asynchronous
    output logic      [Width-1:0] q1_o,    // first stage, possibly metastable; only for a register input
    output logic      [Width-1:0] q2_o     // synchronised level
);

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) {q2_o, q1_o} <= {ResetVal, ResetVal};
    else {q2_o, q1_o} <= {q1_o, d_i};
  end

endmodule

`default_nettype wire
