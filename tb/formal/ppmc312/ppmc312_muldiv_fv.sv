// SPDX-License-Identifier: Apache-2.0
// ppmc312_muldiv_fv: compares results and durations with the operators * and +, with 6 and 3 bits.
`include "ppmc_fv.svh"
`default_nettype none

module ppmc312_muldiv_fv (
    input wire logic       clk_i,
    input wire logic       start_i,
    input wire logic       mul_i,
    input wire logic       keep_i,
    input wire logic [1:0] steps_i,
    input wire logic [2:0] lo_i,
    input wire logic [5:0] operand_i
);

  localparam int unsigned Hi = 6, Lo = 3;

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
  logic [2:0] age_q;  // cycles since the start, at most 7
  logic [1:0] steps_q;
  logic [Hi-1:0] h_q, x_q, x;  // first summand or upper part of the dividend; operand
  logic [Lo-1:0] lo_q;

  assign x = since_q ? operand_i : x_q;

  always_ff @(posedge clk_i) begin
    since_q <= rst_ni && start_i;
    if (!rst_ni) {valid_q, age_q} <= '0;
    else if (start_i) {valid_q, age_q} <= {1'b1, 3'd0};
    else if (age_q != '1) age_q <= age_q + 3'd1;
    if (start_i) {mul_q, steps_q, h_q, lo_q} <= {mul_i, steps_i, keep_i ? hi_o : operand_i, keep_i ? lo_o : lo_i};
    x_q <= x;
  end

  `FV_ASSUME(starts_when_ready, !start_i || !busy_o)
  `FV_ASSUME(number_of_steps, steps_i != '0)
  `FV_ASSUME(loads_first, !(start_i && keep_i) || valid_q)
  `FV_ASSUME(operand_stands, !busy_o || since_q || operand_i == x_q)
  `FV_ASSUME(dividend_below_divisor, !(since_q && !mul_q) || (h_q < operand_i && !operand_i[Hi-1]))
  // The registers of this block have one sign bit, and a sum must fit.
  `FV_ASSUME(sums_fit, !(since_q && mul_q) || 7'(h_q) + 7'(operand_i) < 7'd64)

  logic [Hi+Lo-1:0] product;  // summand + operand * low bits of the multiplier
  logic [Lo-1:0] low, dividend_low;
  assign low = lo_q & ~(3'b111 << steps_q);
  assign product = (Hi + Lo)'(h_q) + (Hi + Lo)'(x_q) * (Hi + Lo)'(low);
  // the high steps_q bits of lo_q are the low part of the dividend
  assign dividend_low = lo_q >> (2'd3 - steps_q);

  logic done;
  assign done = valid_q && !busy_o && !since_q;

  `FV_ASSERT(busy_time, busy_o == (valid_q && age_q < 3'(steps_q) + 3'(!mul_q)))
  `FV_ASSERT(product_high, !(done && mul_q) || hi_o == Hi'(product >> steps_q))
  `FV_ASSERT(product_low,
             !(done && mul_q) || (lo_o >> (2'd3 - steps_q)) == (Lo'(product) & ~(3'b111 << steps_q)))
  `FV_ASSERT(quotient,
             !(done && !mul_q) || ({3'd0, h_q} << steps_q) + 9'(dividend_low) ==
             9'(lo_o & ~(3'b111 << steps_q)) * 9'(x_q) + 9'(hi_o))
  `FV_ASSERT(remainder, !(done && !mul_q) || hi_o < x_q)
  `FV_COVER(seen_quotient, done && !mul_q && lo_o == 3'd5 && hi_o != '0)
  `FV_COVER(seen_product, done && mul_q && hi_o == 6'd9)

endmodule

`default_nettype wire
