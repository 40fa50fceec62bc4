// SPDX-License-Identifier: Apache-2.0
// ppmc_reset: reset of a core: asserted asynchronously, released synchronously.
// Rules:  P104-PORT-03.
// Timing: rst_no falls immediately with rst_ni. At the second rising edge of clk_i with rst_ni high, rst_no
//         rises.
`default_nettype none

module ppmc_reset (
    input  wire logic clk_i,
    input  wire logic rst_ni,  // asynchronous, active low
    output logic      rst_no   // reset for every flip-flop of the core
);

  logic meta_q;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) {rst_no, meta_q} <= 2'b00;
    else {rst_no, meta_q} <= {meta_q, 1'b1};
  end

endmodule

`default_nettype wire
