// SPDX-License-Identifier: Apache-2.0
// ppmc312_muldiv: sequential multiplier and divider with one adder. The registers {hi, lo} hold operands
//         and results.
// Rules:  P312-TBL-02/04, P312-MOT-11 (exact integer products and quotients).
// Timing: busy_o is high for steps_i cycles after start_i; for a division, it is high for one more cycle.
//         The result is valid after the fall of busy_o.
// Assumes: for a division, h < operand < 2**(HiBits - 1), where h is the value of operand_i in the cycle of
//         start_i.
// How:    multiplication: h + operand * (low bits of lo_i), shifted right. After n steps, the low n bits of
//         the result are the top bits of lo.
//         Division: {hi, lo} / operand, shifted left. After n steps, hi is the remainder and the low n
//         bits of lo are the quotient. The division is non-restoring: if the remainder is below 0, the
//         next step or the additional cycle adds the operand.
`default_nettype none

module ppmc312_muldiv #(
    parameter int unsigned HiBits = 40,  // bits of operand, sums, remainders
    parameter int unsigned LoBits = 24   // bits of multiplier, quotient
) (
    input wire logic clk_i,  // clock
    input wire logic rst_ni,  // reset, asynchronous
    input wire logic start_i,  // strobe: start an operation
    input wire logic mul_i,  // 1: multiply, 0: divide
    input wire logic keep_i,  // 1: continue with {hi, lo} instead of h and lo_i
    input wire logic [5:0] steps_i,  // number of steps, 1 .. LoBits
    input wire logic [LoBits-1:0] lo_i,  // multiplication: multiplier; division: low part of the dividend
    // In the cycle of start_i, operand_i is h: the summand, or the upper part of the dividend. From the next
    // cycle on, it is the operand, and is stable while busy_o = 1.
    input wire logic [HiBits-1:0] operand_i,  // h, then the operand
    output logic busy_o,  // 1: the result is not valid yet
    output logic [HiBits-1:0] hi_o,  // multiplication: product; division: remainder
    output logic [LoBits-1:0] lo_o  // product: its low bits at the top; division: quotient at the bottom
);

  logic [5:0] left_q;
  logic mul_q, load, last;
  logic busy_q, shift_q;  // busy_q: left_q is not 0; shift_q: a division is in progress
  logic correct_q;  // 1: add the operand if the remainder is below 0
  logic use_operand_q, subtract_q, use_operand, subtract;
  logic [HiBits-1:0] hi_q, x, y;
  logic [HiBits:0] sum;
  logic under;

  assign busy_o = busy_q || correct_q;
  assign load = start_i && !keep_i;
  assign last = left_q == 6'd1;
  assign under = sum[HiBits-1];
  assign hi_o = hi_q;

  // A load also uses the adder, which adds h to 0.
  assign use_operand = use_operand_q || load;
  assign subtract = subtract_q && !load;

  always_comb begin
    x   = load ? '0 : shift_q ? {hi_q[HiBits-2:0], lo_o[LoBits-1]} : hi_q;
    y   = (use_operand ? operand_i : '0) ^ {HiBits{subtract}};
    sum = {1'b0, x} + {1'b0, y} + (HiBits + 1)'(subtract);
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      left_q <= '0;
      busy_q <= 1'b0;
      correct_q <= 1'b0;
    end else begin
      correct_q <= busy_q && last && !mul_q;
      if (start_i) begin
        left_q <= steps_i;
        busy_q <= 1'b1;
      end else if (busy_q) begin
        left_q <= 6'(ppmc_pkg::dec(32'(left_q)));
        busy_q <= !last;
      end
    end
  end

  // No reset: a load precedes every use.
  always_ff @(posedge clk_i) begin
    if (start_i) begin
      mul_q <= mul_i;
      shift_q <= !mul_i;
      use_operand_q <= !mul_i || (keep_i ? lo_o[0] : lo_i[0]);
      subtract_q <= !mul_i;
    end else if (busy_q) begin
      shift_q <= !mul_q && !last;
      use_operand_q <= mul_q ? lo_o[1] && !last : under || !last;
      subtract_q <= !mul_q && !under && !last;
    end
    if (load || busy_o) hi_q <= (mul_q && !load) ? sum[HiBits:1] : sum[HiBits-1:0];
    if (load) lo_o <= lo_i;
    else if (busy_q) begin
      lo_o <= mul_q ? {sum[0], lo_o[LoBits-1:1]} : {lo_o[LoBits-2:0], !under};
    end
  end

endmodule

`default_nettype wire
