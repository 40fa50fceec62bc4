// SPDX-License-Identifier: Apache-2.0
// MULT18X18D: simulation model of the multiplier of the ECP5, as far as yosys uses it for a product: 18 x 18
//         bits, no register. The model library of yosys has only its ports. The model has no parameters, so
//         an instance that sets one, for example for a register, ends the elaboration with an error.
// Timing: combinational.
`default_nettype none

module MULT18X18D (
    input  wire logic A17, A16, A15, A14, A13, A12, A11, A10, A9, A8, A7, A6, A5, A4, A3, A2, A1, A0,
    input  wire logic B17, B16, B15, B14, B13, B12, B11, B10, B9, B8, B7, B6, B5, B4, B3, B2, B1, B0,
    input  wire logic C17, C16, C15, C14, C13, C12, C11, C10, C9, C8, C7, C6, C5, C4, C3, C2, C1, C0,
    input  wire logic SIGNEDA, SIGNEDB, SOURCEA, SOURCEB,
    output logic      P35, P34, P33, P32, P31, P30, P29, P28, P27, P26, P25, P24, P23, P22, P21, P20,
                      P19, P18, P17, P16, P15, P14, P13, P12, P11, P10, P9, P8, P7, P6, P5, P4, P3, P2,
                      P1, P0
);

  logic signed [18:0] a, b;
  logic signed [37:0] product;

  // The extra upper bit is the sign, or 0 for an unsigned factor.
  assign a = {SIGNEDA && A17, A17, A16, A15, A14, A13, A12, A11, A10, A9, A8, A7, A6, A5, A4, A3, A2,
      A1, A0};
  assign b = {SIGNEDB && B17, B17, B16, B15, B14, B13, B12, B11, B10, B9, B8, B7, B6, B5, B4, B3, B2,
      B1, B0};
  assign product = a * b;
  assign {P35, P34, P33, P32, P31, P30, P29, P28, P27, P26, P25, P24, P23, P22, P21, P20, P19, P18,
      P17, P16, P15, P14, P13, P12, P11, P10, P9, P8, P7, P6, P5, P4, P3, P2, P1, P0} = product[35:0];

  logic unused;
  assign unused = ^{SOURCEA, SOURCEB, product[37:36], C17, C16, C15, C14, C13, C12, C11, C10, C9, C8,
      C7, C6, C5, C4, C3, C2, C1, C0};

endmodule

`default_nettype wire
