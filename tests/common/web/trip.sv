// SPDX-License-Identifier: Apache-2.0
// A fault inside the PPMC-104, whose message the page must show: the simulation stops when l1_n is low.
module trip (
    input wire logic clk,
    input wire logic l1_n
);
  always_ff @(posedge clk) if (!l1_n) $fatal(1, "l1_n is low");
endmodule

bind ppmc104 trip i_trip (
    .clk,
    .l1_n
);
