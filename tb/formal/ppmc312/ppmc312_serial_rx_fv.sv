// SPDX-License-Identifier: Apache-2.0
// ppmc312_serial_rx_fv: compares the parser, with the real code table, with a parser that counts characters.
// A silence of 20 ms has 24 cycles. Characters are at least 9 cycles apart.
`include "ppmc_fv.svh"
`default_nettype none

module ppmc312_serial_rx_fv
  import ppmc312_serial_pkg::*;
(
    input wire logic       clk_i,
    input wire logic [3:0] adr_i,
    input wire logic [7:0] byte_i,
    input wire logic       valid_i,
    input wire logic       error_i,
    input wire logic       busy_i,
    input wire logic [3:0] place_i   // any byte of the block
);

  localparam logic [4:0] Silence = 5'd24;

  logic [7:0] code_o, data_o;
  logic we_o, generated_o, poll_o, run_o, fault_o, unknown_code_o, overrun_o, outcome;
  logic [3:0] addr_o;
  serial_code_t info;

  `FV_RESET

  ppmc312_serial_code_rom u_rom (
      .clk_i,
      .code_i(code_o),
      .info_o(info)
  );

  ppmc312_serial_rx #(
      .ClkHz (3),
      .XtalHz(40_000)
  ) dut (
      .info_i(info),
      .*
  );

  assign outcome = poll_o || run_o || fault_o || unknown_code_o;

  logic [3:0] gap_q;  // cycles since the last character, at most 8
  always_ff @(posedge clk_i)
    if (!rst_ni || valid_i || error_i) gap_q <= '0;
    else if (gap_q != 4'd8) gap_q <= gap_q + 4'd1;

  `FV_ASSUME(one_outcome, !(valid_i && error_i))
  `FV_ASSUME(apart, !(valid_i || error_i) || gap_q == 4'd8)
  `FV_ASSUME(busy_after_a_frame, !busy_i || $past(rst_ni && (busy_i || outcome)))
  `FV_ASSUME(static_station, adr_i == $past(adr_i))
  `FV_ASSUME(one_place, place_i == $past(place_i))

  // ---- expected frames ------------------------------------------------------------------------------

  logic open_q, is_poll_q, bad_q;  // bad_q: a character in a data position is not a hexadecimal digit
  logic [4:0] count_q;  // characters after the control code
  logic [4:0] age_q;  // cycles since the last valid character, at most Silence
  logic [7:0] sum_q, code_q;
  logic [3:0] high_q, digit, first;
  logic hex, control, character, code_known, code_bad_q, is_sum, sum_ok, silent;

  assign control = valid_i && byte_i >= 8'h80;
  assign character = valid_i && byte_i < 8'h80;
  assign hex = byte_i inside {[8'h30 : 8'h39], [8'h61 : 8'h66]};
  assign digit = (byte_i < 8'h40) ? 4'(byte_i - 8'h30) : 4'(byte_i - 8'h57);
  assign first = info.has_flags ? 4'd4 : 4'd3;
  assign code_known = count_q >= 5'd2 && info.is_known;
  assign is_sum    = character && open_q && !code_bad_q &&
      (is_poll_q || (code_known && count_q == 5'd2 + {info.size - first, 1'b0}));
  assign sum_ok = byte_i == {1'b0, ~sum_q[6:0]} && !bad_q;
  assign silent = age_q == Silence && !valid_i && !error_i;

  always_ff @(posedge clk_i) begin
    if (valid_i) age_q <= '0;
    else if (age_q < Silence) age_q <= age_q + 5'd1;
    if (!rst_ni || error_i || silent) open_q <= 1'b0;
    else if (control) open_q <= byte_i[6] == 1'b0 && byte_i[5] == 1'b0 && byte_i[3:0] == adr_i && !busy_i;
    else if (is_sum) open_q <= 1'b0;
    if (control) begin
      {is_poll_q, bad_q, code_bad_q, count_q} <= {byte_i[5:4] == 2'b00, 7'd0};
      sum_q <= byte_i;
    end else if (character && open_q && !is_sum) begin
      if (!code_bad_q && !(count_q >= 5'd2 && !info.is_known)) count_q <= count_q + 5'd1;
      if (!hex && count_q < 5'd2) code_bad_q <= 1'b1;
      if (!hex) bad_q <= 1'b1;
      high_q <= digit;
      sum_q  <= sum_q + (count_q[0] ? {4'd0, digit} : {digit, 4'd0});
      if (count_q == 5'd1) code_q <= {high_q, digit};
    end
    if (!rst_ni) {open_q, age_q} <= '0;
  end

  `FV_ASSERT(p312_ser_11_poll, poll_o == (is_sum && is_poll_q && sum_ok))
  `FV_ASSERT(p312_ser_11_instruction, run_o == (is_sum && !is_poll_q && sum_ok))
  `FV_ASSERT(p312_ser_14_fault, fault_o == ((is_sum && !sum_ok) || (silent && open_q && code_bad_q)))
  `FV_ASSERT(
      p312_ser_17_unknown,
      unknown_code_o == (silent && open_q && !code_bad_q && !is_poll_q && count_q >= 5'd2 && !info.is_known))
  `FV_ASSERT(p312_ser_15_overrun,
             overrun_o == (control && busy_i && byte_i[6:5] == 2'b00 && byte_i[3:0] == adr_i))
  `FV_ASSERT(p312_ser_11_code, !run_o || code_o == code_q)

  // ---- bytes of the block: an arbitrary one -----------------------------------------------------------

  logic [1:0] written_q;  // number of writes of this byte in the frame, at most 2
  logic [7:0] value_q, expected_q;
  logic is_generated_q;

  always_ff @(posedge clk_i) begin
    if (!rst_ni || control) written_q <= '0;
    else if (we_o && addr_o == place_i && written_q != 2'd2) written_q <= written_q + 2'd1;
    if (we_o && addr_o == place_i) {is_generated_q, value_q} <= {generated_o, data_o};
    if (character && count_q[0] && count_q >= 5'd2 && 4'(count_q[4:1] - 4'd1) + first == place_i)
      expected_q <= {high_q, digit};
  end

  `FV_ASSERT(p312_gen_04_whole_block, !run_o || written_q == 2'(place_i < info.size))
  // verilog_format: off
  `FV_ASSERT(
      p312_gen_04_bytes,
      !run_o || place_i >= info.size || (is_generated_q == (place_i < first) && (is_generated_q
          || value_q == expected_q)))
  // verilog_format: on
  `FV_ASSERT(no_byte_without_a_frame, !we_o || open_q)
  // ---- lemmas: registers of the parser are functions of the expected frame ------------------------------

  logic [4:0] all_chars;  // characters of code and data
  logic known_chars;  // all_chars is valid, and the code is known
  assign all_chars = 5'd2 + {info.size - first, 1'b0};
  // verilog_format: off
  assign known_chars = open_q && !is_poll_q && !code_bad_q && count_q >= 5'd2
      && dut.state_q inside {3'd4, 3'd5, 3'd6};
  // verilog_format: on

  localparam int unsigned SilenceBits = ppmc_lfsr_pkg::width(23);
  logic heard_q;  // a character has been received
  always_ff @(posedge clk_i) heard_q <= rst_ni && (heard_q || valid_i);

  logic lemma_state, lemma_silence;
  always_comb begin
    unique case (dut.state_q)
      3'd0: lemma_state = !open_q;
      3'd1: lemma_state = !is_poll_q && count_q < 5'd2 && !code_bad_q && dut.low_q == count_q[0] && !bad_q;
      3'd2, 3'd3: lemma_state = !is_poll_q && count_q == 5'd2 && !code_bad_q && gap_q < 4'd3 && !dut.low_q;
      3'd4:
      lemma_state = !is_poll_q && !code_bad_q && info.is_known && count_q < all_chars &&
          dut.at_q >= first && dut.at_q < info.size && count_q == 5'd2 + {dut.at_q - first, dut.low_q};
      3'd5:
      lemma_state = !is_poll_q && !code_bad_q && info.is_known && count_q == all_chars && dut.at_q < first &&
          gap_q == dut.at_q + ((count_q == 5'd2) ? 4'd3 : 4'd0) && !dut.low_q;
      3'd6: lemma_state = is_poll_q ? count_q == '0 : !code_bad_q && info.is_known && count_q == all_chars;
      default: lemma_state = !is_poll_q && (code_bad_q ? bad_q : count_q == 5'd2 && !info.is_known);
    endcase
    if (dut.state_q != 3'd0 && !open_q) lemma_state = 1'b0;
    lemma_silence = 1'b1;
    for (int unsigned n = 0; n < 24; n++)
    if (age_q == 5'(n) && heard_q && dut.u_silence.u_timer.count_q != SilenceBits'(ppmc_lfsr_pkg::after(
            n, SilenceBits
        )))
      lemma_silence = 1'b0;
  end

  `FV_ASSERT(lemma_parser, lemma_state)
  // verilog_format: off
  `FV_ASSERT(
      lemma_rom,
      is_poll_q || code_bad_q || !(dut.state_q inside {3'd3, 3'd4, 3'd5, 3'd6, 3'd7})
          || (u_rom.word_q == u_rom.Words[code_o] && info == u_rom.word_q))
  // verilog_format: on
  `FV_ASSERT(lemma_rom_in_time, dut.state_q != 3'd2 || !dut.waited_q || u_rom.word_q == u_rom.Words[code_o])
  `FV_ASSERT(lemma_timer, lemma_silence)
  `FV_ASSERT(lemma_past, !heard_q || dut.past == (age_q == Silence))
  `FV_ASSERT(lemma_heard, heard_q || !open_q)
  `FV_ASSERT(lemma_gap, !open_q || age_q >= 5'(gap_q))
  // verilog_format: off
  `FV_ASSERT(
      lemma_frame,
      !open_q || (dut.poll_q == is_poll_q && (dut.state_q == 3'd7 ? dut.invalid_q == code_bad_q
          : dut.sum_q == sum_q[6:0] && dut.invalid_q == bad_q)))
  // verilog_format: on
  `FV_ASSERT(lemma_code, !open_q || is_poll_q || code_bad_q || count_q < 5'd2 || code_o == code_q)
  `FV_ASSERT(lemma_high, !open_q || !count_q[0] || dut.high_q == high_q)
  // verilog_format: off
  `FV_ASSERT(
      lemma_bytes,
      !known_chars || written_q == '0 || (is_generated_q == (place_i < first) && (is_generated_q
          || value_q == expected_q)))
  `FV_ASSERT(
      lemma_written,
      !known_chars || written_q == 2'(place_i >= first ? {place_i - first, 1'b0} + 5'd4 <= count_q
          && place_i < info.size : dut.state_q == 3'd6 || (dut.state_q == 3'd5 && place_i < dut.at_q)))
  // verilog_format: on

  `FV_COVER(seen_instruction, run_o && info.size == 4'd6)
  `FV_COVER(seen_poll_after_fault, poll_o && age_q != '0 && bad_q == 1'b0)
  `FV_COVER(seen_unknown, unknown_code_o)

endmodule

`default_nettype wire
