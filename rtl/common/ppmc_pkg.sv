// SPDX-License-Identifier: Apache-2.0
// ppmc_pkg: functions that all cores share. They convert times, calculate widths of counters, and process
//         short numbers.
// Rules:  P104-GEN-02, P104-GEN-03 (times are specified in crystal cycles; only this package converts them
//         to clock cycles).
`default_nettype none

package ppmc_pkg;

  // A design uses only some of the items of this package.
  // verilator lint_off UNUSEDPARAM

  // Clock cycles that last as long as `xtal_cycles` crystal cycles, rounded up; CYC(n) in the rules.
  function automatic int unsigned cyc(int unsigned xtal_cycles, int unsigned clk_hz, int unsigned xtal_hz);
    longint unsigned product;
    product = 64'(xtal_cycles) * 64'(clk_hz);
    return 32'((product + 64'(xtal_hz) - 64'd1) / 64'(xtal_hz));
  endfunction

  // Clock cycles that last as long as `xtal_cycles` crystal cycles, rounded to the nearest integer (half
  // up).
  function automatic int unsigned cyc_round(int unsigned xtal_cycles, int unsigned clk_hz,
                                            int unsigned xtal_hz);
    longint unsigned product;
    product = 64'(xtal_cycles) * 64'(clk_hz);
    return 32'((64'd2 * product + 64'(xtal_hz)) / (64'd2 * 64'(xtal_hz)));
  endfunction

  // Number of bits of a counter with the values 0 .. `top`; at least 1.
  function automatic int unsigned cnt_width(int unsigned top);
    return (top < 2) ? 1 : 32'($clog2(64'(top) + 64'd1));
  endfunction

  // x + 1, x - 1 and x < y of short numbers, built from gates instead of a carry chain. On an ECP5, the two
  // ends of a carry chain cost as much as five of its bits.
  function automatic logic [31:0] inc(logic [31:0] x);
    logic carry;
    carry = 1'b1;
    for (int unsigned i = 0; i < 32; i++) begin
      inc[i] = x[i] ^ carry;
      carry  = carry && x[i];
    end
  endfunction

  function automatic logic [31:0] dec(logic [31:0] x);
    return ~inc(~x);
  endfunction

  function automatic logic less(logic [31:0] x, logic [31:0] y);
    less = 1'b0;
    for (int unsigned i = 0; i < 32; i++) less = (x[i] == y[i]) ? less : y[i];
  endfunction

  // Greatest common divisor. Dividing by it keeps phase accumulators narrow.
  function automatic longint unsigned gcd(longint unsigned a, longint unsigned b);
    longint unsigned x, y, t;
    x = a;
    y = b;
    while (y != 0) begin
      t = x % y;
      x = y;
      y = t;
    end
    return x;
  endfunction

  // verilator lint_on UNUSEDPARAM

endpackage

`default_nettype wire
