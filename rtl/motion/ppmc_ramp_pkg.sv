// SPDX-License-Identifier: Apache-2.0
// ppmc_ramp_pkg: passes of the ramp builder over its bit-serial numbers.
`default_nettype none

package ppmc_ramp_pkg;

  // A design uses only some of the items of this package.
  // verilator lint_off UNUSEDPARAM

  typedef enum logic [2:0] {
    PassInit,  // n = PA, v = 0
    PassMulBit,  // v = 2v + bit * n: one multiplier bit, the highest first
    PassMulOne,  // v = 2v + n: multiplier bit 1
    PassMulEnd,  // n = n + v, v = 0: multiplied by the multiplier + 1
    PassDivideSquare,  // v = n / s / s, s = 2r + 1
    PassSubtract,  // v = v - u
    PassDivide,  // v = v / (a - b) / (a + b)
    PassOutput  // output v + 1; v is overwritten
  } pass_e;

  // verilator lint_on UNUSEDPARAM

endpackage

`default_nettype wire
