// SPDX-License-Identifier: Apache-2.0
// ppmc_ramp_pkg: the passes that the ramp builder makes over its bit-serial numbers.
`default_nettype none

package ppmc_ramp_pkg;

  typedef enum logic [2:0] {
    PassInit,    // n = PA, d = 1, v = e = 0
    PassMulBit,  // v = 2v + bit*n, e = 2e + bit*d: one multiplier bit, the highest first
    PassMulEnd,  // n = n + v, d = d + e: multiplied by (rate + 1)
    PassSave,    // u = n, g = d, d = 1: B*PA and B are ready
    PassFinal,   // n = A*B*PA and d = A become the numbers of r = 0
    PassStep,    // from r to r + 1
    PassRead     // nothing is written: den is read out
  } pass_e;

endpackage

`default_nettype wire
