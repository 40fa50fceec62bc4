// SPDX-License-Identifier: Apache-2.0
// ppmc_uart_tx_fv: with 16/3 cycles per bit, proves that ppmc_uart_rx receives every accepted byte
// unchanged, once and in time.
`include "ppmc_fv.svh"
`default_nettype none

module ppmc_uart_tx_fv (
    input wire logic       clk_i,
    input wire logic [7:0] byte_i,
    input wire logic       valid_i
);

  localparam int unsigned Width = 4;
  localparam logic [Width-1:0] Step = 4'd3;

  logic ready_o, txd_o, rx_valid, rx_error, unused_break;
  logic [7:0] rx_byte;

  `FV_RESET

  ppmc_uart_tx #(
      .Width(Width)
  ) dut (
      .step_i(Step),
      .*
  );

  ppmc_uart_rx #(
      .Width(Width)
  ) u_rx (
      .clk_i,
      .rst_ni,
      .step_i (Step),
      .wrap_i (Width'(0)),
      .rxd_i  (txd_o),
      .byte_o (rx_byte),
      .valid_o(rx_valid),
      .error_o(rx_error),
      .break_o(unused_break)
  );

  logic way_q;  // 1: a byte is being transmitted
  logic [7:0] byte_q;
  logic [6:0] age_q;  // cycles since the byte was accepted
  logic again_q;  // 1: at least one byte was received before
  logic up_q;  // 1: the receiver has sampled the idle line

  always_ff @(posedge clk_i)
    if (!rst_ni) {way_q, age_q, byte_q, up_q, again_q} <= '0;
    else begin
      up_q  <= 1'b1;
      age_q <= age_q == '1 ? '1 : age_q + 1'b1;
      if (valid_i && ready_o) {way_q, byte_q, age_q} <= {1'b1, byte_i, 7'd0};
      else if (rx_valid) {way_q, again_q} <= 2'b01;
    end

  // Lemmas for the induction: shift registers and phases are functions of the byte and its age. sent:
  // sixteenths of a bit that the transmitter has sent; seen: sixteenths that the receiver has sampled. Bits
  // 7:4 of sent and seen count whole bits.
  logic [7:0] sent, seen;
  logic [8:0] rest;  // bits that are still to be sent
  logic line, rx_idle;
  logic [2:0] young_q;  // cycles since reset, saturates at 7

  assign sent    = 8'(age_q) * 8'd3;
  assign seen    = 8'd2 + 8'(age_q) * 8'd3;
  assign rest    = ~(~{1'b1, byte_q} >> sent[7:4]);
  assign line    = (sent[7:4] == '0) ? 1'b0 : (sent[7:4] > 4'd8) ? 1'b1 : byte_q[3'(sent[7:4]-4'd1)];
  assign rx_idle = u_rx.state_q == 0;

  always_ff @(posedge clk_i) young_q <= !rst_ni ? '0 : (young_q == '1) ? '1 : young_q + 1'b1;

  `FV_ASSERT(lemma_age, !way_q || age_q <= 7'd53)
  logic lemma_sends_holds;
  assign lemma_sends_holds =
      way_q ? !ready_o && dut.phase_q == sent[3:0] && 5'(dut.bits_left_q) + 5'(sent[7:4]) == 5'd9 &&
      dut.bits_q == rest && txd_o == line : ready_o && txd_o;
  `FV_ASSERT(lemma_sends, lemma_sends_holds)
  `FV_ASSERT(lemma_waits, !(way_q ? age_q < 7'd3 : young_q > 3'd2) || (rx_idle && u_rx.phase_q == 4'd8))
  `FV_ASSERT(lemma_idle_line, way_q || young_q < 3'd3 || (u_rx.unused_meta && u_rx.line))
  `FV_ASSERT(lemma_line, !way_q || age_q < 7'd2 || u_rx.line == $past(line, 2))
  logic lemma_receives_holds;
  assign lemma_receives_holds =
      !(way_q && age_q >= 7'd3 && age_q < 7'd53) || (u_rx.phase_q == seen[3:0] &&
      (seen[7:4] == '0 ? u_rx.state_q == 1 :
       u_rx.state_q == 2 && 5'(u_rx.bits_left_q) + 5'(seen[7:4]) == 5'd9));
  `FV_ASSERT(lemma_receives, lemma_receives_holds)
  logic lemma_byte_holds;
  assign lemma_byte_holds =
      !(way_q && age_q >= 7'd3 && age_q < 7'd53 && seen[7:4] != '0) ||
      (rx_byte >> (4'd9 - seen[7:4])) == (byte_q & ~(8'hFF << (seen[7:4] - 4'd1)));
  `FV_ASSERT(lemma_byte, lemma_byte_holds)
  `FV_ASSERT(lemma_arrives, rx_valid == (way_q && age_q == 7'd53))

  `FV_ASSUME(line_was_at_rest, up_q || !valid_i)
  `FV_ASSERT(rests_high, !ready_o || txd_o)
  `FV_ASSERT(arrives_as_sent, !rx_valid || (way_q && rx_byte == byte_q))
  `FV_ASSERT(never_faulty, !rx_error)
  `FV_ASSERT(arrives_in_time, !(way_q && ready_o) || age_q <= 7'd60)
  `FV_ASSERT(taken_when_the_last_has_arrived, !(valid_i && ready_o && way_q) || rx_valid)
  `FV_COVER(seen_second_byte, rx_valid && byte_q == 8'h5A && again_q)

endmodule

`default_nettype wire
