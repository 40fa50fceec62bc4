// SPDX-License-Identifier: Apache-2.0
// ppmc_bank_tables, a stand-in for the proofs of those who hold one: a builder that is booked or free at any
// time, any threshold. Its outputs are driven by nobody.
`default_nettype none

module ppmc_bank_tables #(
    parameter int unsigned AxisBits = 5,
    parameter int unsigned StepBits = 14
) (
    input  wire logic                clk_i,
    input  wire logic                rst_ni,
    // build
    input  wire logic                book_i,       // build a table, from these
    input  wire logic [AxisBits-1:0] book_axis_i,  // for this axis
    input  wire logic [         7:0] slow_i,       // start-up rate
    input  wire logic [         7:0] fast_i,       // high-speed rate
    input  wire logic [StepBits-1:0] steps_i,      // acceleration pulses PA
    output logic                     booked_o,     // the builder is at work
    output logic      [AxisBits-1:0] for_o,        // for this axis
    // look up
    input  wire logic [AxisBits-1:0] axis_i,       // axis
    input  wire logic [         7:0] rate_i,       // r
    output logic      [StepBits-1:0] threshold_o   // first index with a rate below r
);

endmodule

`default_nettype wire
