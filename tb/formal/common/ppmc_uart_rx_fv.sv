// SPDX-License-Identifier: Apache-2.0
// ppmc_uart_rx_fv: for any waveform of the line, proves that the receiver does not hang, and that it has one
// outcome (byte or error) per character.
`include "ppmc_fv.svh"
`default_nettype none

module ppmc_uart_rx_fv (
    input wire logic clk_i,
    input wire logic rxd_i
);

  localparam int unsigned Width = 4;
  localparam int unsigned Bit = 8;  // cycles per bit
  localparam int unsigned Character = 10 * Bit;

  logic [7:0] byte_o;
  logic valid_o, error_o, break_o;

  `FV_RESET

  ppmc_uart_rx #(
      .Width(Width)
  ) dut (
      .step_i(Width'(2 ** Width / Bit)),
      .wrap_i(Width'(0)),
      .*
  );

  // high_q: cycles with a high line; quiet_q: cycles without an outcome; both saturate at 127
  logic [6:0] high_q, quiet_q;
  logic wait_q;  // 1: an error has occurred, and the line has not been high since then

  always_ff @(posedge clk_i)
    if (!rst_ni) begin
      high_q <= '0;
      {wait_q, quiet_q} <= '1;
    end else begin
      high_q  <= !rxd_i ? '0 : (high_q == '1) ? '1 : high_q + 1'b1;
      quiet_q <= (valid_o || error_o) ? '0 : (quiet_q == '1) ? '1 : quiet_q + 1'b1;
      wait_q  <= (error_o || wait_q) && !dut.line;
    end

  // For the induction: phase and bit number are functions of the time since the receiver found the start
  // bit. After a fault on the line, the phase at the start bit is arbitrary.
  logic [6:0] age_q;
  logic [7:0] phases;
  logic [3:0] first_q, first;  // first: phase at the start bit; first_q: register that stores first
  logic busy;

  assign busy   = dut.state_q == 1 || dut.state_q == 2;
  assign phases = 8'(first) + {age_q, 1'b0};
  assign first  = (age_q == '0) ? dut.phase_q : first_q;

  always_ff @(posedge clk_i) first_q <= first;
  always_ff @(posedge clk_i) age_q <= (rst_ni && busy) ? age_q + 1'b1 : '0;

  `FV_ASSERT(lemma_phase, !busy || dut.phase_q == phases[3:0])
  `FV_ASSERT(lemma_start, !busy || (dut.state_q == 1) == (phases[7:4] == '0))
  `FV_ASSERT(lemma_age, !busy || age_q <= 7'(Character))
  `FV_ASSERT(lemma_bits, dut.state_q != 2 || 5'(dut.bits_left_q) + 5'(phases[7:4]) == 5'd9)
  `FV_ASSERT(lemma_high, high_q <= 7'd3 || !busy || high_q <= age_q + 7'd3)
  `FV_ASSERT(lemma_waits, dut.state_q != 3 || high_q <= 7'd3)
  `FV_ASSERT(lemma_synchroniser, (high_q < 7'd1 || dut.unused_meta) && (high_q < 7'd2 || dut.line))
  `FV_ASSERT(lemma_fault, !(error_o || wait_q) || dut.state_q == 3)
  `FV_ASSERT(lemma_zeros, dut.state_q != 2 || dut.has_one_q || (byte_o >> dut.bits_left_q) == '0)
  `FV_ASSERT(lemma_quiet, !busy || quiet_q >= age_q)

  `FV_ASSERT(ready_after_silence, high_q < 7'(Character + 12) || dut.state_q == 0)
  `FV_ASSERT(one_outcome_a_character, !(valid_o || error_o) || quiet_q >= 7'(9 * Bit))
  `FV_ASSERT(good_ends_high, !valid_o || high_q >= 7'd3 || $past(rxd_i, 3))
  `FV_ASSERT(break_is_an_error_of_zeros, !(error_o && break_o) || byte_o == '0)
  `FV_ASSERT(no_character_in_a_break, !wait_q || !valid_o)
  `FV_COVER(seen_byte, valid_o && byte_o == 8'hA5)
  `FV_COVER(seen_break, error_o && break_o)

endmodule

`default_nettype wire
