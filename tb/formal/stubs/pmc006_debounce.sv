// SPDX-License-Identifier: Apache-2.0
// pmc006_debounce, stub for proofs that hold for any times of the key events. pmc006_debounce_fv proves the
// times of the real filter.
`default_nettype none

module pmc006_debounce #(
    parameter int unsigned LowTicks     = 1001,
    parameter int unsigned HighTicks    = 1001,
    parameter bit          ArmedAtReset = 1'b0
) (
    input  wire logic clk_i,
    input  wire logic rst_ni,
    input  wire logic us_i,
    input  wire logic pin_i,
    output logic      hit_o,
    output logic      rearm_o
);
  logic [1:0] any;  // not driven; the register ensures that all blocks read the same value
  always_ff @(posedge clk_i) {hit_o, rearm_o} <= any;

endmodule

`default_nettype wire
