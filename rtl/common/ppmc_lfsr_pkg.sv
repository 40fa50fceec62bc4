// SPDX-License-Identifier: Apache-2.0
// ppmc_lfsr_pkg: counters that are shift registers with feedback (Galois LFSRs of maximal length), for
//         blocks that only compare the count with a few values. A binary counter needs a gate or a carry
//         cell for each bit; an LFSR needs only one to three XOR gates.
// How:    the state after n steps is x**n modulo a primitive polynomial, and x**0 = 1. The states repeat
//         after 2**bits - 1 steps. The state 0 would never change, but no step leads to it.
`default_nettype none

package ppmc_lfsr_pkg;

  // A design uses only some of the items of this package.
  // verilator lint_off UNUSEDPARAM

  // Primitive polynomials of the degrees 31 .. 2, without their highest power. Bit 0 is x**0.
  localparam logic [31:2][7:0] TAPS = {
    8'h09,  // 31
    8'h53,
    8'h05,
    8'h09,  // 28
    8'h27,
    8'h47,
    8'h09,
    8'h87,  // 24
    8'h21,
    8'h03,
    8'h05,
    8'h09,  // 20
    8'h27,
    8'h81,
    8'h09,
    8'h2D,  // 16
    8'h03,
    8'h2B,
    8'h1B,
    8'h53,  // 12
    8'h05,
    8'h09,
    8'h11,
    8'h1D,  // 8
    8'h03,
    8'h03,
    8'h05,
    8'h03,  // 4
    8'h03,
    8'h03
  };

  // Bits of a counter that must distinguish 0 .. `top`, which is at most 2**31 - 2.
  function automatic int unsigned width(int unsigned top);
    return (top < 2) ? 2 : 32'($clog2(64'(top) + 64'd2));
  endfunction

  // State after one more step.
  function automatic logic [30:0] step(logic [30:0] state, int unsigned bits);
    logic [30:0] mask;
    mask = 31'((32'd1 << bits) - 32'd1);
    return ({state[29:0], 1'b0} & mask) ^ (state[bits-1] ? 31'(TAPS[bits]) : '0);
  endfunction

  // State after n steps, which is x**n, with n below 2**bits. Call this function only during elaboration. The
  // loop uses the bits of n from the highest down. For each bit, it squares `power` and, if the bit is 1,
  // multiplies it by x. The function has few statements, because tools evaluate functions slowly.
  function automatic logic [30:0] after(int unsigned n, int unsigned bits);
    // whole: polynomial; power: x**m, where m consists of the bits of n used so far; square: square of
    // power
    logic [31:0] whole, power, square;
    whole = (32'd1 << bits) | 32'(TAPS[bits]);
    power = 32'd1;
    for (int i = int'(bits) - 1; i >= 0; i--) begin
      square = '0;
      for (int j = int'(bits) - 1; j >= 0; j--)
      square = (square << 1) ^ (square[bits-1] ? whole : '0) ^ (power[j] ? power : '0);
      power = n[i] ? (square << 1) ^ (square[bits-1] ? whole : '0) : square;
    end
    return power[30:0];
  endfunction

  // verilator lint_on UNUSEDPARAM

endpackage

`default_nettype wire
