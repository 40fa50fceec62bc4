// SPDX-License-Identifier: Apache-2.0
// ppmc_bank_tables, stub for the proofs of the blocks that instantiate it: its outputs are not driven.
// Therefore the proofs hold for any threshold, and for a builder that may be busy or idle at any time.
`default_nettype none

module ppmc_bank_tables #(
    parameter int unsigned AxisBits = 5,
    parameter int unsigned StepBits = 14
) (
    input  wire logic                clk_i,
    input  wire logic                rst_ni,
    // build
    input  wire logic                build_start_i,  // strobe: build a table
    input  wire logic [AxisBits-1:0] build_axis_i,   // axis of the table to build
    input  wire logic [         7:0] slow_i,         // start-up rate
    input  wire logic [         7:0] fast_i,         // high-speed rate
    input  wire logic [StepBits-1:0] steps_i,        // acceleration pulses PA
    output logic                     build_busy_o,   // 1: a build is in progress
    output logic      [AxisBits-1:0] build_axis_o,   // axis of the current build
    // look up
    input  wire logic [AxisBits-1:0] axis_i,         // axis of the look-up
    input  wire logic [         7:0] rate_i,         // rate r
    output logic      [StepBits-1:0] threshold_o     // first ramp index whose rate is below r
);

endmodule

`default_nettype wire
