// SPDX-License-Identifier: Apache-2.0
// ppmc_reset: reset generator of a core. Asserts the reset asynchronously and releases it synchronously.
// Rules:  P104-PORT-03.
// Timing: rst_no falls immediately when rst_ni falls. It rises at the second rising edge of clk_i at which
//         rst_ni is high.
`default_nettype none

module ppmc_reset (
    input  wire logic clk_i,
    input  wire logic rst_ni,  // reset, asynchronous
    output logic      rst_no   // reset of all flip-flops of the core
);

  logic meta_q;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) {rst_no, meta_q} <= 2'b00;
    else {rst_no, meta_q} <= {meta_q, 1'b1};
  end

endmodule

`default_nettype wire
