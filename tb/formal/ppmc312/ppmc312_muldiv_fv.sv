// SPDX-License-Identifier: Apache-2.0
// ppmc312_muldiv_fv: compares each step with the operators * and +. The operand has 5 bits, the multiplier or
// quotient 3 bits. After k steps, the registers contain the product of the operand and k bits of the
// multiplier, or quotient and remainder of the upper bits and k lower bits of the dividend.
`include "ppmc_fv.svh"
`default_nettype none

module ppmc312_muldiv_fv (
    input wire logic       clk_i,
    input wire logic       start_i,
    input wire logic       mul_i,
    input wire logic       keep_i,
    input wire logic [1:0] steps_i,
    input wire logic [2:0] lo_i,
    input wire logic [4:0] operand_i
);

  localparam int unsigned Hi = 5, Lo = 3;

  logic busy_o;
  logic [Hi-1:0] hi_o;
  logic [Lo-1:0] lo_o;

  `FV_RESET

  ppmc312_muldiv #(
      .HiBits(Hi),
      .LoBits(Lo)
  ) dut (
      .steps_i({4'd0, steps_i}),
      .*
  );

  logic mul_q, since_q, valid_q;  // since_q: cycle after a start; valid_q: an operation has been started
  logic corrected_q;  // the additional cycle of a division has passed
  logic [1:0] k_q, steps_q;  // k_q: number of steps that have been made
  logic [Hi-1:0] h_q, x_q, x;  // summand or upper part of the dividend; operand
  logic [Lo-1:0] lo_q;

  assign x = since_q ? operand_i : x_q;

  always_ff @(posedge clk_i) begin
    since_q <= rst_ni && start_i;
    if (!rst_ni) {valid_q, k_q, corrected_q} <= '0;
    else if (start_i) {valid_q, k_q, corrected_q} <= {1'b1, 3'd0};
    else if (valid_q) begin
      if (k_q != steps_q) k_q <= k_q + 2'd1;
      corrected_q <= k_q == steps_q;
    end
    if (start_i) begin
      {mul_q, steps_q} <= {mul_i, steps_i};
      {h_q, lo_q} <= keep_i ? {hi_o, lo_o} : {operand_i, lo_i};
    end
    x_q <= x;
  end

  `FV_ASSUME(starts_when_ready, !start_i || !busy_o)
  `FV_ASSUME(number_of_steps, steps_i != '0)
  `FV_ASSUME(loads_first, !(start_i && keep_i) || valid_q)
  `FV_ASSUME(operand_stands, !busy_o || since_q || operand_i == x_q)
  `FV_ASSUME(dividend_below_divisor, !(since_q && !mul_q) || (h_q < operand_i && !operand_i[Hi-1]))

  logic [Hi+Lo-1:0] product, dividend;
  logic [Hi-1:0] remainder;
  logic [Lo-1:0] mask, quotient;
  logic negative, done;
  assign mask      = ~(3'b111 << k_q);
  assign product   = (Hi + Lo)'(h_q) + (Hi + Lo)'(x) * (Hi + Lo)'(lo_q & mask);
  assign dividend  = ((Hi + Lo)'(h_q) << k_q) | (Hi + Lo)'(lo_q >> (2'd3 - k_q));
  assign quotient  = lo_o & mask;
  assign negative  = hi_o[Hi-1];
  assign remainder = hi_o + (negative ? x : '0);
  assign done      = valid_q && !busy_o;

  `FV_ASSERT(busy_time, busy_o == (valid_q && (k_q != steps_q || !(mul_q || corrected_q))))
  // verilog_format: off
  `FV_ASSERT(
      product_exact,
      !(valid_q && mul_q) || {hi_o, lo_o} == ((product << (2'd3 - k_q)) | (Hi + Lo)'(lo_q >> k_q)))
  `FV_ASSERT(
      quotient_exact,
      !(valid_q && !mul_q) || dividend == (Hi + Lo)'(x) * (Hi + Lo)'(quotient) + (Hi + Lo)'(remainder))
  // verilog_format: on
  `FV_ASSERT(remainder_in_range, !(valid_q && !mul_q) || remainder < x)
  `FV_ASSERT(remainder_corrected, !(done && !mul_q) || !negative)

  // verilog_format: off
  `FV_ASSERT(
      lemma_steps,
      !valid_q || (k_q <= steps_q && dut.left_q == 6'(steps_q - k_q) && dut.busy_q == (k_q != steps_q)
          && dut.mul_q == mul_q))
  // verilog_format: on
  `FV_ASSERT(lemma_begin, !since_q || (valid_q && k_q == '0 && !corrected_q))
  `FV_ASSERT(lemma_correct, !valid_q || dut.correct_q == (!mul_q && k_q == steps_q && !corrected_q))
  `FV_ASSERT(lemma_bits, !(valid_q && !mul_q) || (lo_o >> k_q) == (Lo'(lo_q << k_q) >> k_q))
  // verilog_format: off
  `FV_ASSERT(
      lemma_mul,
      !(valid_q && mul_q) || !dut.busy_q
          || {dut.shift_q, dut.subtract_q, dut.use_operand_q} == {2'b00, lo_q[k_q]})
  `FV_ASSERT(
      lemma_div,
      !(valid_q && !mul_q && busy_o) || {dut.shift_q, dut.subtract_q, dut.use_operand_q} == (dut.busy_q
          ? {1'b1, !negative, 1'b1} : {2'b00, negative}))
  // verilog_format: on
  `FV_ASSERT(lemma_divisor, !(valid_q && !mul_q) || since_q || (h_q < x && !x[Hi-1]))
  `FV_COVER(seen_quotient, done && !mul_q && lo_o == 3'd5 && hi_o == 5'd13 && steps_q == 2'd3)
  `FV_COVER(seen_product, done && mul_q && hi_o == 5'd19 && steps_q == 2'd3)

endmodule

`default_nettype wire
