// SPDX-License-Identifier: Apache-2.0
// ppmc_ramp_divide_fv: for numbers of any length and all divisors, proves that every bit of the quotient
// equals that of a long division.
`include "ppmc_fv.svh"
`default_nettype none

module ppmc_ramp_divide_fv (
    input wire logic       clk_i,
    input wire logic       run_i,
    input wire logic       bit_i,
    input wire logic [2:0] divisor_m1_i
);

  logic bit_o;

  `FV_RESET

  ppmc_ramp_divide #(
      .Width(3)
  ) dut (
      .run_i(run_i && rst_ni),
      .*
  );

  logic [3:0] divisor;
  logic [4:0] next;
  logic [3:0] rest_q;  // remainder of the previous bits, less than the divisor
  logic bit_q, valid_q, one_q;  // bit_q: bit of the quotient; valid_q: bit_q is valid; one_q: a bit was 1

  assign divisor = {1'b0, divisor_m1_i} + 4'd1;
  assign next    = {rest_q, bit_i};

  always_ff @(posedge clk_i)
    if (!rst_ni || !run_i) {rest_q, bit_q, valid_q, one_q} <= '0;
    else begin
      bit_q   <= next >= {1'b0, divisor};
      rest_q  <= 4'(next >= {1'b0, divisor} ? next - {1'b0, divisor} : next);
      valid_q <= 1'b1;
      one_q   <= one_q || bit_q;
    end

  `FV_ASSUME(divisor_stands, !valid_q || !run_i || divisor_m1_i == $past(divisor_m1_i))

  `FV_ASSERT(p104_rmp_02_each_bit, !valid_q || bit_o == bit_q)
  `FV_COVER(seen_rest_behind_a_one, valid_q && one_q && !bit_q && rest_q == 4'd6)

endmodule

`default_nettype wire
