// SPDX-License-Identifier: Apache-2.0
// ppmc_lfsr_pkg: counts that nobody reads, who only has to know when they are at one of a few values: a shift
//         register with feedback (Galois) of maximal length. Where a counter has a gate or a carry cell a bit,
//         this has one to three XOR in all.
// How:    the state after n steps is x**n modulo a primitive polynomial, from x**0 = 1 on; it comes back after
//         2**bits - 1 steps. A state of 0 would stand still: it is never reached.
`default_nettype none

package ppmc_lfsr_pkg;

  // A design uses only some of these constants.
  // verilator lint_off UNUSEDPARAM

  // Primitive polynomials of degree 31 .. 2 without their highest power, x**0 in the low bit.
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

  // Bits of a count that must tell 0 .. `top` apart; top at most 2**31 - 2.
  function automatic int unsigned width(int unsigned top);
    return (top < 2) ? 2 : 32'($clog2(64'(top) + 64'd2));
  endfunction

  // One step.
  function automatic logic [30:0] step(logic [30:0] state, int unsigned bits);
    logic [30:0] mask;
    mask = 31'((32'd1 << bits) - 32'd1);
    return ({state[29:0], 1'b0} & mask) ^ (state[bits-1] ? 31'(TAPS[bits]) : '0);
  endfunction

  // State after n steps, n below 2**bits; for elaboration alone. From the highest bit of n down: square, and step for
  // a 1. Few statements, because tools carry such functions out slowly.
  function automatic logic [30:0] after(int unsigned n, int unsigned bits);
    logic [31:0] whole, power, square;  // the polynomial; x to the bits of n so far; its square
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
