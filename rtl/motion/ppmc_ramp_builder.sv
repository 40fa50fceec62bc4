// SPDX-License-Identifier: Apache-2.0
// ppmc_ramp_builder: fills the ramp table. For each rate r from fast_i + 1 to slow_i, the entry thr(r) is
//         the first step with a rate below r. The entry for fast_i, where the acceleration ends, is PA.
// Rules:  P104-RMP-01..05, P104-INI-07, P104-HSK-04 (at most 40 000 cycles for every valid initialisation).
// Timing: busy_o rises at the edge that ends the cycle of start_i. It falls when the table is complete. If
//         fast_i = slow_i, the table contains only PA, and busy_o is short. From the end of a build until
//         the next build, addr_o = slow_i.
// Assumes: slow_i, fast_i and steps_i are stable from the cycle after start_i until busy_o falls.
// How:    with s = 2r + 1, a = RL + 1, b = RH + 1, E = PA*b*b:
//             thr(r) - 1 = floor((E*(2a)*(2a)/(s*s) - E) / ((a - b)*(a + b))).
`include "ppmc_assert.svh"
`default_nettype none

module ppmc_ramp_builder
  import ppmc_ramp_pkg::*;
#(
    parameter int unsigned RateBits = 8,
    parameter int unsigned StepBits = 14  // 3 .. 16
) (
    input  wire logic                clk_i,
    input  wire logic                rst_ni,
    input  wire logic                start_i,  // strobe: start a build
    input  wire logic [RateBits-1:0] slow_i,   // start-up rate RL
    input  wire logic [RateBits-1:0] fast_i,   // high-speed rate RH, at most slow_i
    input  wire logic [StepBits-1:0] steps_i,  // PA, at least 1
    output logic                     busy_o,   // 1: a build is in progress
    output logic                     we_o,     // write port of the table: write enable
    output logic      [RateBits-1:0] addr_o,   // write port: address r
    output logic      [StepBits-1:0] data_o    // write port: data thr(r); PA for fast_i
);

  localparam int unsigned MulBits = ppmc_pkg::cnt_width(RateBits - 1);

  (* fsm_encoding = "none" *)
  pass_e pass_q;  // current pass
  pass_e pass;  // next pass
  logic first_q, begin_q;  // first and second cycle of a build
  logic factor_2a_q;  // 1: the factor is 2a, 0: b
  logic second_mul_q;  // 1: second multiplication by the factor
  logic [MulBits-1:0] mul_q;  // index of the multiplier bit; starts at the highest bit
  logic [RateBits-1:0] rate_q;  // rate r
  logic found_q;  // 1: bits_q is a threshold
  logic [StepBits-1:0] bits_q;  // PA, or a threshold that is received bit by bit
  logic next, last, done, use_bit, mul_bit, sum, product;
  logic [RateBits:0] first, second;

  assign done    = rate_q == slow_i;
  assign next    = begin_q ? !done : last && !(pass_q == PassOutput && done);
  assign mul_bit = factor_2a_q ? slow_i[mul_q] : fast_i[mul_q];
  assign product = pass_q == PassMulEnd && factor_2a_q && second_mul_q;  // last product
  assign we_o    = begin_q || found_q;
  assign addr_o  = rate_q;
  assign data_o  = bits_q;

  // Divisors minus 1, for the pairs (s, s) and (a - b, a + b).
  always_comb begin
    first  = {rate_q, 1'b0};
    second = {rate_q, 1'b0};
    if (pass_q == PassDivide) begin
      first  = {1'b0, slow_i + ~fast_i};
      second = {1'b0, slow_i} + {1'b0, fast_i} + 1'b1;
    end
  end

  ppmc_ramp_serial #(
      .StepBits(StepBits),
      .RateBits(RateBits)
  ) u_serial (
      .clk_i,
      .rst_ni,
      .start_i (next),
      .next_i  (pass),
      .pass_i  (pass_q),
      .mul_i   (mul_bit),
      .keep_i  (!factor_2a_q),
      .init_i  (bits_q[0]),
      .first_i (first),
      .second_i(second),
      .bit_o   (sum),
      .use_o   (use_bit),
      .last_o  (last)
  );

  // Each entry thr(r) requires four divisions by short numbers. The first two divide by s, then E is
  // subtracted. The other two divide by a - b and by a + b, then 1 is added. A quotient may be rounded down
  // before the next division, or before an integer is subtracted: this does not change the result. All
  // operations are bit-serial (ppmc_ramp_serial). This block selects the next pass. Once per build, the
  // numerator n (see ppmc_ramp_serial) is multiplied by b, b, 2a and 2a, with one pass per multiplier bit.
  // Then four passes follow for each r.
  always_comb begin
    unique case (pass_q)
      PassInit:   pass = PassMulBit;
      PassMulBit: begin
        pass = PassMulBit;
        if (mul_q == '0) pass = factor_2a_q ? PassMulOne : PassMulEnd;
      end
      PassMulOne: pass = PassMulEnd;
      PassDivideSquare: pass = PassSubtract;
      PassSubtract:   pass = PassDivide;
      PassDivide:  pass = PassOutput;
      PassOutput:   pass = PassDivideSquare;
      default:    pass = product ? PassDivideSquare : PassMulBit;  // PassMulEnd
    endcase
    if (begin_q) pass = PassInit;
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      busy_o   <= 1'b0;
      first_q  <= 1'b0;
      begin_q  <= 1'b0;
      found_q  <= 1'b0;
      pass_q   <= PassInit;
      factor_2a_q <= 1'b0;
      second_mul_q  <= 1'b0;
      mul_q    <= MulBits'(RateBits - 1);
    end else begin
      first_q <= start_i && !busy_o;
      begin_q <= first_q;
      found_q <= last && pass_q == PassOutput;
      if (!busy_o) busy_o <= start_i;
      else if (done && we_o) busy_o <= 1'b0;

      if (next) pass_q <= pass;
      if (last && pass_q == PassMulEnd)
        {factor_2a_q, second_mul_q} <= {factor_2a_q ^ second_mul_q, !second_mul_q};
      if (last && pass_q == PassMulBit) mul_q <= (mul_q == '0) ? MulBits'(RateBits - 1) : mul_q - 1'b1;
    end
  end

  // No reset: every build begins with a load.
  always_ff @(posedge clk_i) begin
    if (first_q) rate_q <= fast_i;
    else if ((found_q && !done) || (last && product)) rate_q <= RateBits'(ppmc_pkg::inc(32'(rate_q)));
    if (first_q) bits_q <= steps_i;
    else if (use_bit) bits_q <= {sum, bits_q[StepBits-1:1]};
  end

`ifndef SYNTHESIS
  `PPMC_ASSERT(p104_rmp_02_range, !we_o || ((data_o != '0 || begin_q) && data_o <= steps_i))
`endif

endmodule

`default_nettype wire
