// SPDX-License-Identifier: Apache-2.0
// ppmc_ramp_builder: fills the ramp table: for every rate r from fast + 1 to slow the first step with a rate
// below r.
// Rules:  P104-RMP-01..05, P104-INI-07, P104-HSK-04 (at most 40 000 clk for every legal initialisation).
// Timing: busy_o rises at the edge that ends the cycle of start_i and falls when the table is complete.
//         slow_i, fast_i, steps_i must stand still meanwhile. fast_i = slow_i: no table is needed, busy_o is
//         short.
// How:    numerator and denominator come bit by bit from ppmc_ramp_serial; the quotient by repeated
//         subtraction of a divisor that moves right, so that the remainder needs an enable but no
//         multiplexer.
`include "ppmc_assert.svh"
`default_nettype none

module ppmc_ramp_builder
  import ppmc_ramp_pkg::*;
#(
    parameter int unsigned RateBits = 8,
    parameter int unsigned StepBits = 14
) (
    input  wire logic                clk_i,
    input  wire logic                rst_ni,
    input  wire logic                start_i,  // build
    input  wire logic [RateBits-1:0] slow_i,   // start-up rate RL
    input  wire logic [RateBits-1:0] fast_i,   // high-speed rate RH, at most slow_i
    input  wire logic [StepBits-1:0] steps_i,  // PA, at least 1
    output logic                     busy_o,   // it is being built
    output logic                     we_o,     // write port of the table
    output logic      [RateBits-1:0] addr_o,   // r
    output logic      [StepBits-1:0] data_o    // thr(r)
);

  localparam int unsigned Bits = StepBits + 2 * (RateBits + 1) + 16;
  localparam int unsigned MulBits = ppmc_pkg::cnt_width(RateBits - 1);
  localparam int unsigned DivBits = ppmc_pkg::cnt_width(StepBits - 1);

  typedef enum logic [2:0] {
    StIdle,
    StStart,   // a pass begins
    StPass,    // and runs
    StNum,     // the numerator goes into the remainder
    StDivide,
    StWrite
  } state_e;

  state_e                state_q;
  pass_e                 pass_q;
  logic                  second_q;  // second multiplication by the same factor
  logic                  low_q;  // multiplying by slow_i + 1
  logic                  above_q;  // rate_q is above fast_i
  logic   [ MulBits-1:0] mul_q;  // multiplier bit
  logic   [ DivBits-1:0] div_q;  // quotient bits to come
  logic   [RateBits-1:0] rate_q;
  logic valid, num, den, last, mul_bit, below;

  assign busy_o  = state_q != StIdle;
  assign mul_bit = low_q ? slow_i[mul_q] : fast_i[mul_q];

  ppmc_ramp_serial #(
      .Bits    (Bits),
      .StepBits(StepBits)
  ) u_serial (
      .clk_i,
      .rst_ni,
      .start_i(state_q == StStart),
      .pass_i (pass_q),
      .mul_i  (mul_bit),
      .steps_i,
      .valid_o(valid),
      .num_o  (num),
      .den_o  (den),
      .last_o (last)
  );

  // Which pass comes next.
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      state_q  <= StIdle;
      pass_q   <= PassInit;
      second_q <= 1'b0;
      low_q    <= 1'b0;
      above_q  <= 1'b0;
      mul_q    <= '0;
      div_q    <= '0;
      rate_q   <= '0;
    end else begin
      unique case (state_q)
        StIdle: begin
          pass_q   <= PassInit;
          second_q <= 1'b0;
          low_q    <= 1'b0;
          above_q  <= 1'b0;
          rate_q   <= '0;
          mul_q    <= MulBits'(RateBits - 1);
          if (start_i) state_q <= StStart;
        end
        StStart: state_q <= (slow_i == fast_i) ? StIdle : StPass;
        StPass:
        if (last) begin
          state_q <= StStart;
          unique case (pass_q)
            PassInit, PassSave: pass_q <= PassMulBit;
            PassMulBit: begin
              mul_q <= mul_q - 1'b1;  // wraps to the top for the next factor
              if (mul_q == '0) begin
                mul_q  <= MulBits'(RateBits - 1);
                pass_q <= PassMulEnd;
              end
            end
            PassMulEnd: begin
              second_q <= !second_q;
              if (!second_q) pass_q <= PassMulBit;
              else pass_q <= low_q ? PassFinal : PassSave;
              if (second_q) low_q <= 1'b1;
            end
            PassRead: begin
              div_q   <= DivBits'(StepBits - 1);
              state_q <= StDivide;
            end
            default: begin  // PassFinal, PassStep: the numbers of rate_q are ready
              if (above_q) begin
                pass_q  <= PassRead;
                state_q <= StNum;
              end else begin
                pass_q  <= PassStep;
                above_q <= rate_q == fast_i;
                rate_q  <= rate_q + 1'b1;
              end
            end
          endcase
        end
        StNum:   state_q <= StStart;
        StDivide: begin
          div_q <= div_q - 1'b1;
          if (div_q == '0) state_q <= StWrite;
        end
        StWrite: begin
          pass_q  <= PassStep;
          rate_q  <= rate_q + 1'b1;
          state_q <= (rate_q == slow_i) ? StIdle : StStart;
        end
        default: state_q <= StIdle;
      endcase
    end
  end

  // Divider. No reset: every use begins with a full load.
  logic [Bits-1:0] rem_q, inv_q;  // remainder, divisor with all bits inverted
  logic [Bits:0] diff;
  logic [StepBits-1:0] quot_q;

  assign diff  = {1'b0, rem_q} + {1'b0, inv_q} + (Bits + 1)'(1);
  assign below = !diff[Bits];

  always_ff @(posedge clk_i) begin
    if (state_q == StPass && pass_q != PassRead) rem_q <= '0;
    else if (state_q == StNum || (state_q == StDivide && !below)) rem_q <= diff[Bits-1:0];

    if (valid || state_q == StDivide) begin
      inv_q <= {!(valid && ((pass_q == PassRead) ? den : num)), inv_q[Bits-1:1]};
    end
    if (state_q == StDivide) quot_q <= {quot_q[StepBits-2:0], !below};
  end

  assign we_o   = state_q == StWrite;
  assign addr_o = rate_q;
  assign data_o = quot_q;

`ifndef SYNTHESIS
  `PPMC_ASSERT(p104_rmp_02_range, !we_o || (data_o != '0 && data_o <= steps_i))
`endif

endmodule

`default_nettype wire
