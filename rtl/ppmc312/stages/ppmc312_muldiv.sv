// SPDX-License-Identifier: Apache-2.0
// ppmc312_muldiv: sequential multiplier and divider with one adder; the pair {hi, lo} holds operands and
//         results.
// Rules:  P312-TBL-02/04, P312-MOT-11 (exact integer products and quotients).
// Timing: busy_o is high for steps_i cycles after start_i, for a division one cycle more; then the result is
//         valid.
// Assumes: for a division, h < operand < 2**(HiBits - 1); h is operand_i in the cycle of start_i.
// How:    multiply: h + operand * (low bits of lo_i), shifted right; after n steps the low n bits of the
//         result are on top of lo. Divide: {hi, lo} by the operand, shifted left; after n steps hi is the
//         remainder and the low n bits of lo are the quotient. The division is non-restoring: the next step,
//         or the additional cycle, adds the operand to a remainder below 0.
`default_nettype none

module ppmc312_muldiv #(
    parameter int unsigned HiBits = 40,  // bits of operand, sums, remainders
    parameter int unsigned LoBits = 24   // bits of multiplier, quotient
) (
    input wire logic clk_i,  // clock
    input wire logic rst_ni,  // reset, asynchronous
    input wire logic start_i,  // strobe
    input wire logic mul_i,  // 1: multiply, 0: divide
    input wire logic keep_i,  // 1: continue with the product instead of h and lo_i
    input wire logic [5:0] steps_i,  // number of steps, 1 .. LoBits
    input wire logic [LoBits-1:0] lo_i,  // multiplier; lower part of the dividend
    // With start_i: h, the summand or the upper part of the dividend. Then the operand, stable while
    // busy_o = 1.
    input wire logic [HiBits-1:0] operand_i,  // h, then the operand
    output logic busy_o,  // 1: the result is not valid yet
    output logic [HiBits-1:0] hi_o,  // product; remainder
    output logic [LoBits-1:0] lo_o  // top bits: low bits of the product; low bits: quotient
);

  logic [5:0] left_q;
  logic mul_q, load, last;
  logic busy_q, shift_q;  // busy_q: left_q is not 0; shift_q: a division is in progress
  logic correct_q;  // adds the operand to a remainder below 0
  logic
      use_operand_q,
      subtract_q,
      use_operand,
      subtract;  // take…: the operand is used; less…: the operand is subtracted
  logic [HiBits-1:0] hi_q, x, y;
  logic [HiBits:0] sum;
  logic under;

  assign busy_o = busy_q || correct_q;
  assign load = start_i && !keep_i;
  assign last = left_q == 6'd1;
  assign under = sum[HiBits-1];
  assign hi_o = hi_q;

  // A load also uses the adder: h is added to 0.
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

  // No reset: every use begins with a load.
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
