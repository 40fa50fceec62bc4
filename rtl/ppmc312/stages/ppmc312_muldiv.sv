// SPDX-License-Identifier: Apache-2.0
// ppmc312_muldiv: multiplies and divides step by step with one adder; the pair {hi, lo} holds what goes in and out.
// Rules:  P312-TBL-02/04, P312-MOT-11 (exact integer products and quotients).
// Timing: busy_o is high for steps_i clk after start_i, then the result stands.
// How:    multiply: hi_i + operand * (low bits of lo_i), shifted right; after n steps the result has its low n
//         bits on top of lo. Divide: {hi, lo} by the operand, shifted left; after n steps hi is
//         the remainder and the low n bits of lo the quotient, for which hi_i < operand must hold.
`default_nettype none

module ppmc312_muldiv #(
    parameter int unsigned HiBits = 40,  // operand, sums, remainders
    parameter int unsigned LoBits = 24   // multiplier, quotient
) (
    input  wire logic              clk_i,      // clock
    input  wire logic              rst_ni,     // reset, asynchronous
    input  wire logic              start_i,    // strobe
    input  wire logic              mul_i,      // 1 multiply, 0 divide
    input  wire logic              zero_i,     // 0 instead of hi_i
    input  wire logic              keep_i,     // go on with {hi_o, lo_o} instead of both
    input  wire logic [       5:0] steps_i,    // 1 .. LoBits
    input  wire logic [HiBits-1:0] hi_i,       // summand; upper part of the dividend
    input  wire logic [LoBits-1:0] lo_i,       // multiplier; lower part of the dividend
    input  wire logic [HiBits-1:0] operand_i,  // steady while busy
    output logic                   busy_o,     // the result does not stand yet
    output logic      [HiBits-1:0] hi_o,       // product; remainder
    output logic      [LoBits-1:0] lo_o        // low bits of the product on top; quotient
);

  logic [5:0] left_q;
  logic mul_q;
  logic [HiBits-1:0] x, y;
  logic [HiBits:0] sum;

  assign busy_o = left_q != '0;

  always_comb begin
    x   = mul_q ? hi_o : {hi_o[HiBits-2:0], lo_o[LoBits-1]};
    y   = mul_q ? (lo_o[0] ? operand_i : '0) : ~operand_i;
    sum = {1'b0, x} + {1'b0, y} + (HiBits + 1)'(!mul_q);
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) left_q <= '0;
    else if (start_i) left_q <= steps_i;
    else if (busy_o) left_q <= left_q - 1'b1;
  end

  // No reset: every use begins with a load.
  always_ff @(posedge clk_i) begin
    if (start_i) mul_q <= mul_i;
    if (start_i && !keep_i) begin
      hi_o <= zero_i ? '0 : hi_i;
      lo_o <= lo_i;
    end else if (busy_o) begin
      if (mul_q) {hi_o, lo_o} <= {sum, lo_o[LoBits-1:1]};
      else begin
        hi_o <= sum[HiBits] ? sum[HiBits-1:0] : x;
        lo_o <= {lo_o[LoBits-2:0], sum[HiBits]};
      end
    end
  end

endmodule

`default_nettype wire
