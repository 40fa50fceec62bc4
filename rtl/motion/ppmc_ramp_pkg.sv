// SPDX-License-Identifier: Apache-2.0
// ppmc_ramp_pkg: passes that the ramp builder makes over its bit-serial numbers.
// How:    ppmc_ramp_serial defines n, u and v; ppmc_ramp_builder defines PA, r, a and b.
`default_nettype none

package ppmc_ramp_pkg;

  // A design uses only some of the items of this package.
  // verilator lint_off UNUSEDPARAM

  typedef enum logic [2:0] {
    PassInit,  // n = PA, v = 0
    PassMulBit,  // v = 2v + bit * n, per multiplier bit, highest bit first
    PassMulOne,  // v = 2v + n, for a multiplier bit of 1
    PassMulEnd,  // n = n + v, v = 0; completes n = n * (multiplier + 1)
    PassDivideSquare,  // v = n / s / s, s = 2r + 1
    PassSubtract,  // v = v - u
    PassDivide,  // v = v / (a - b) / (a + b)
    PassOutput  // outputs v + 1 and overwrites v
  } pass_e;

  // verilator lint_on UNUSEDPARAM

endpackage

`default_nettype wire
