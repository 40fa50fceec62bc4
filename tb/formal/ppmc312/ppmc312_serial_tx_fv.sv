// SPDX-License-Identifier: Apache-2.0
// ppmc312_serial_tx_fv: compares the line with the frame of the rules, bit by bit, with 2.5 cycles per bit.
`include "ppmc_fv.svh"
`include "common/ppmc_lemma.svh"
`default_nettype none

module ppmc312_serial_tx_fv
  import ppmc312_serial_pkg::*;
(
    input wire logic              clk_i,
    input wire logic              power_i,
    input wire logic   [3:0]      adr_i,
    input wire logic              rx_char_i,
    input wire logic              send_i,
    input wire reply_t            reply_i,
    input wire logic   [3:0][7:0] response_i  // bytes of the response in the queue
);

  localparam int unsigned Width = 3;

  logic sent_o, txd_o, snd_o;
  logic [1:0] index_o, index1_q, index2_q;

  `FV_RESET
  `FV_ANY_START(power_i)

  ppmc312_serial_tx #(
      .Width(Width)
  ) dut (
      .rst_ni         (rst_dut_n),
      .step_i         (3'd2),
      .wrap_i         (3'd5),
      .response_byte_i(response_i[index2_q]),
      .*
  );

  always_ff @(posedge clk_i) {index2_q, index1_q} <= {index1_q, index_o};

  logic [4:0] char_age_q;  // cycles since the last received character, at most 25
  // verilog_format: off
  `FV_ASSUME(
      stands,
      !(send_i && $past(rst_dut_n && send_i && !sent_o)) || ($past(reply_i) == reply_i
          && $past(response_i) == response_i && $past(adr_i) == adr_i))
  // verilog_format: on
  `FV_ASSUME(until_sent, send_i || !$past(rst_dut_n && send_i && !sent_o))
  `FV_ASSUME(sent_once, !(send_i && $past(rst_dut_n && sent_o)))
  `FV_ASSUME(counts, reply_i.count <= (reply_i.from_response ? 3'd4 : 3'd3))
  `FV_ASSUME(characters_apart, !rx_char_i || char_age_q == 5'd25)

  // ---- expected frame --------------------------------------------------------------------------------

  // A frame begins with the rise of snd_o. Edge n occurs ceil(2.5 * n) cycles after it.
  // begun_q: edge 1 has occurred; place_q, bit_q: character of the frame, and bit of this character.
  logic begun_q;
  logic [3:0] place_q, bit_q;
  logic [2:0] rest_q;  // 2 * cycles since the last edge - 5 * edges
  logic [3:0] chars;
  logic [3:0][7:0] data;
  logic [7:0] char, value, sum_q;  // value: summand of this character; sum_q: sum of the characters before it
  logic [3:0] digit;
  logic level, snd_q;

  assign chars = {1'b0, reply_i.count} + {1'b0, reply_i.count} + 4'd2;
  assign data  = reply_i.from_response ? response_i : {8'd0, reply_i.data};

  always_comb begin
    digit = place_q[0] ? data[2'((place_q-4'd1)>>1)][7:4] : data[2'((place_q-4'd1)>>1)][3:0];
    char  = (digit < 4'd10) ? 8'h30 + 8'(digit) : 8'h57 + 8'(digit);
    value = place_q[0] ? {digit, 4'd0} : 8'(digit);
    if (place_q == '0) {value, char} = {2{2'b10, reply_i.kind, adr_i}};
    if (place_q == chars - 4'd1) {value, char} = {8'd0, 1'b0, ~sum_q[6:0]};
    level = (!begun_q || bit_q == 4'd9) ? 1'b1 : (bit_q == '0) ? 1'b0 : char[3'(bit_q-4'd1)];
  end

  logic next_edge, late_q;  // late_q: the last character was received while snd_o was high
  logic [5:0] wait_q;  // cycles for which a reply waits
  assign next_edge = rest_q + 3'd2 >= 3'd5;

  always_ff @(posedge clk_i or negedge rst_dut_n)
    if (!rst_dut_n) begin
      {snd_q, begun_q, place_q, bit_q, rest_q, sum_q, late_q, wait_q} <= '0;
      char_age_q <= 5'd25;
    end else begin
      snd_q <= snd_o;
      if (!snd_o) {begun_q, place_q, bit_q, rest_q, sum_q} <= '0;
      else begin
        rest_q <= rest_q + 3'd2 - (next_edge ? 3'd5 : 3'd0);
        if (next_edge) begin
          begun_q <= 1'b1;
          bit_q   <= (!begun_q || bit_q == 4'd9) ? '0 : bit_q + 4'd1;
          if (bit_q == 4'd9) {place_q, sum_q} <= {place_q + 4'd1, sum_q + value};
        end
      end
      if (rx_char_i) late_q <= snd_o;
      if (rx_char_i) char_age_q <= '0;
      else if (char_age_q < 5'd25) char_age_q <= char_age_q + 5'd1;
      wait_q <= (!send_i || snd_o) ? '0 : wait_q + 6'd1;
    end

  `FV_LEMMA(p312_ser_02_line, txd_o == (!snd_o || level))
  `FV_LEMMA(p312_ser_18_ends, sent_o == (snd_o && next_edge && bit_q == 4'd9 && place_q == chars - 4'd1))
  `FV_LEMMA(p312_ser_18_falls, !$past(rst_dut_n && sent_o) || !snd_o)
  `FV_LEMMA(p312_ser_18_only_to_send, !(snd_o && !snd_q) || send_i)
  `FV_LEMMA(p312_ser_18_stays, !snd_q || snd_o || $past(sent_o))
  // The gap is one bit time (3 cycles) and 2 cycles. If a character ends in the cycle of the decision, or
  // during a reply, two stations send at the same time.
  `FV_LEMMA(p312_ser_18_gap, !(snd_o && !snd_q) || char_age_q >= 5'd4 || char_age_q == '0 || late_q)
  `FV_LEMMA(p312_ser_18_in_time, wait_q < 6'd7)

  // ---- lemmas: registers of the block are functions of the edge ----------------------------------------

  logic [6:0] part;  // sum of the characters up to this one
  logic [1:0] state;
  assign part  = sum_q[6:0] + value[6:0];
  assign state = (place_q + 4'd2 >= chars) ? 2'd3 : place_q[0] ? 2'd2 : 2'd1;

  logic [3:0] phase;
  assign phase = {dut.bit_end, dut.phase_q};

  logic lemma_holds;
  assign lemma_holds = !snd_o || (!begun_q ?
      dut.left_q == '0 && !dut.last_q && dut.state_q == 2'd0 && dut.at_q == '0 :
      dut.left_q == 4'd9 - bit_q && dut.last_q == (place_q == chars - 4'd1) &&
      dut.state_q == state && dut.bits_q == 8'({16'hffff, char} >> bit_q) && dut.sum_q == part &&
      (dut.last_q || dut.at_q == 3'(place_q >> 1)));
  `FV_LEMMA(lemma_registers, lemma_holds)
  // verilog_format: off
  `FV_LEMMA(
      lemma_place,
      bit_q <= 4'd9 && (!snd_o || place_q < chars) && (begun_q || {place_q, bit_q, sum_q} == '0))
  // verilog_format: on
  `FV_LEMMA(lemma_phase, !snd_o || (dut.bit_end == next_edge && rest_q < 3'd5 && phase == 4'd5 + 4'(rest_q)))
  `FV_LEMMA(lemma_sends, !snd_o || send_i)
  // verilog_format: off
  `FV_LEMMA(
      lemma_index,
      !snd_o || ((!(rest_q >= 3'd2 || bit_q != '0) || index1_q == index_o) && (bit_q == '0
          || index2_q == index_o)))
  `FV_LEMMA(
      lemma_gap,
      (phase inside {[4'd5 : 4'd9]}) && (!dut.gap_q || (char_age_q <= 5'd2 && (char_age_q != 5'd1
          || phase >= 4'd7) && (char_age_q != 5'd2 || phase == 4'd9))))
  `FV_LEMMA(
      lemma_gap_in_time,
      late_q || char_age_q > 5'd2 || snd_o || (dut.gap_q && phase == 4'd5 + {char_age_q[2:0], 1'b0}))
  `FV_LEMMA(
      lemma_gap_sending,
      late_q || char_age_q > 5'd2 || !snd_o || (!begun_q && rest_q == {char_age_q[1:0], 1'b0}))
  // verilog_format: on
  `FV_LEMMA(lemma_wait, wait_q <= (snd_o ? 6'd5 : (char_age_q <= 5'd4) ? 6'(char_age_q) : 6'd1))

  logic reset_q = 1'b0;  // a cover begins with a reset
  always_ff @(posedge clk_i) reset_q <= reset_q || !rst_dut_n;
  `FV_COVER(seen_end, reset_q && sent_o && reply_i.count == 3'd1)

endmodule

`default_nettype wire
