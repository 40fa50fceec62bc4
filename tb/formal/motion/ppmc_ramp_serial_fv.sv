// SPDX-License-Identifier: Apache-2.0
// ppmc_ramp_serial_fv: proves that a pass over w words takes w + 2 cycles, and that no word is read while it
// is written.
`include "ppmc_fv.svh"
`default_nettype none

module ppmc_ramp_serial_fv
  import ppmc_ramp_pkg::*;
(
    input wire logic       clk_i,
    input wire logic       start_i,
    input wire logic [2:0] code_i,
    input wire logic       mul_i,
    input wire logic       keep_i,
    input wire logic       init_i,
    input wire logic [3:0] first_i,
    input wire logic [3:0] second_i
);

  localparam int unsigned Share = 3 + 2 * 3;
  localparam int unsigned Bits = Share + 2 * 4;

  pass_e next_i, pass_i;
  logic bit_o, use_o, last_o;

  assign next_i = pass_e'(code_i);

  `FV_RESET

  ppmc_ramp_serial #(
      .StepBits(3),
      .RateBits(3)
  ) dut (
      .*
  );

  logic run_q, again_q;  // run_q: a pass is running; again_q: a pass has ended before
  logic [4:0] age_q, words;  // age_q: cycles of the pass; words: number of words of the pass

  always_comb begin
    unique case (pass_i)
      PassDivideSquare: words = 5'(Bits + 2);
      PassDivide:  words = 5'(Share + 2);
      PassSubtract:   words = 5'(Share + 2);
      PassOutput:   words = 5'd3;
      default:    words = 5'(Bits);
    endcase
  end

  always_ff @(posedge clk_i)
    if (!rst_ni) {run_q, again_q, age_q, pass_i} <= '0;
    else begin
      age_q   <= age_q + 1'b1;
      again_q <= again_q || (run_q && last_o);
      if (start_i) {run_q, age_q, pass_i} <= {1'b1, 5'd0, next_i};
      else if (last_o) run_q <= 1'b0;
    end

  `FV_ASSUME(one_at_a_time, !(start_i && run_q && !last_o))

  `FV_ASSERT(p104_rmp_04_length, !(run_q && last_o) || age_q == words + 5'd1)
  `FV_ASSERT(ends, !run_q || age_q <= words + 5'd1)
  `FV_ASSERT(nothing_between_passes, run_q || !last_o)
  `FV_ASSERT(a_bit_with_each_word, use_o == (run_q && age_q >= 5'd2))
  `FV_ASSERT(no_word_read_and_written, !(dut.use_q && dut.run_q && dut.read_addr_q == dut.use_addr))
  `FV_COVER(seen_division_behind_another_pass, run_q && last_o && again_q && pass_i == PassDivideSquare)

endmodule

`default_nettype wire
