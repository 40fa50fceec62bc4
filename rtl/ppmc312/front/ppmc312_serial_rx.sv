// SPDX-License-Identifier: Apache-2.0
// ppmc312_serial_rx: parses the frames of the host, which consist of control code, hexadecimal data and
//         checksum. Also detects silence.
// Rules:  P312-SER-02, P312-SER-10..17, P312-BAD-16.
// Timing: poll_o, run_o, fault_o, unknown_code_o and overrun_o are asserted in the cycle of the character
//         that causes them, or in the cycle in which 20 ms of silence are complete.
`include "ppmc_assert.svh"
`default_nettype none

module ppmc312_serial_rx
  import ppmc312_serial_pkg::*;
#(
    parameter int unsigned ClkHz    = 16_000_000,
    parameter int unsigned XtalHz   = 16_000_000,
    // 1: checksum of the data characters, 0: of control code and data bytes
    parameter bit          CharsSum = 1'b0
) (
    input  wire logic               clk_i,           // clock
    input  wire logic               rst_ni,          // reset, asynchronous
    input  wire logic         [3:0] adr_i,           // station number
    // characters
    input  wire logic         [7:0] byte_i,          // received character; valid with valid_i
    input  wire logic               valid_i,         // strobe: character received
    input  wire logic               error_i,         // strobe: character without a stop bit
    input  wire logic               busy_i,          // a reply is pending or being sent
    // code table
    output logic              [7:0] code_o,          // received code
    input  wire serial_code_t       info_i,          // meaning of code_o, two cycles later
    // equivalent block of the parallel bus: first the data bytes, then header, length, code and flags
    output logic                    we_o,            // strobe: a byte of the block
    output logic                    generated_o,     // 1: header, length, code or flags, 0: a received byte
    output logic              [3:0] addr_o,          // position of the byte, 0 = header
    output logic              [7:0] data_o,          // received byte; valid with we_o and generated_o = 0
    // result
    output logic                    poll_o,          // strobe: a poll
    output logic                    run_o,           // strobe: an instruction with a correct checksum
    output logic                    fault_o,         // strobe: wrong checksum or invalid character
    output logic                    unknown_code_o,  // strobe: unknown code
    output logic                    overrun_o        // strobe: a frame was received while busy_i = 1
);

  localparam int unsigned SilenceXtal = 320_000;  // 20 ms

  typedef enum logic [2:0] {
    StSkip,    // waits for the next control code
    StCode,
    StWait,
    StCheck,   // checks whether code_o is known
    StData,
    StHead,    // outputs header, length, code, flags
    StSum,
    StInvalid  // unknown or invalid code: waits for silence
  } state_e;

  state_e state_q;
  logic control, addressed, data_char, digit, letter, hex, past, silent, frame_end, sum_ok, last;
  logic poll_q, invalid_q, low_q, waited_q;
  logic [3:0] nibble, high_q, at_q, first;
  logic [6:0] sum_q;

  // ---- characters ---------------------------------------------------------------------------------

  assign control = valid_i && byte_i[7];
  assign addressed = byte_i[6:5] == 2'b00 && byte_i[3:0] == adr_i;
  assign data_char = valid_i && !byte_i[7];
  assign digit = byte_i[7:4] == 4'h3 && byte_i[3:0] <= 4'd9;
  assign letter = byte_i[7:4] == 4'h6 && byte_i[3:0] inside {[4'd1 : 4'd6]};
  assign hex = digit || letter;
  assign nibble = byte_i[3:0] + (byte_i[6] ? 4'd9 : 4'd0);

  ppmc_delay #(
      .Ticks(ppmc_pkg::cyc(SilenceXtal, ClkHz, XtalHz))
  ) u_silence (
      .clk_i,
      .restart_i(valid_i),
      .tick_i   (1'b1),
      .past_o   (past)
  );

  assign silent = past && !valid_i && !error_i;

  // ---- result -------------------------------------------------------------------------------------

  assign sum_ok = byte_i[6:0] == ~sum_q && !invalid_q;
  assign frame_end = data_char && state_q == StSum;
  assign poll_o = frame_end && sum_ok && poll_q;
  assign run_o = frame_end && sum_ok && !poll_q;
  assign fault_o = (frame_end && !sum_ok) || (silent && state_q == StInvalid && invalid_q);
  assign unknown_code_o = silent && state_q == StInvalid && !invalid_q;
  assign overrun_o = control && addressed && busy_i;

  assign generated_o = state_q == StHead;
  assign we_o = (data_char && state_q == StData && low_q) || generated_o;
  assign first = info_i.has_flags ? 4'd4 : 4'd3;
  assign last = at_q + 1'b1 == info_i.size;
  assign addr_o = at_q;
  assign data_o = {high_q, nibble};

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) state_q <= StSkip;
    else if (error_i) state_q <= StSkip;
    else if (control) begin
      state_q <= StSkip;
      if (addressed && !busy_i) state_q <= byte_i[4] ? StCode : StSum;
    end else if (state_q == StWait) state_q <= waited_q ? StCheck : StWait;
    else if (state_q == StCheck) begin
      state_q <= StData;
      if (first == info_i.size) state_q <= StHead;
      if (!info_i.is_known) state_q <= StInvalid;
    end else if (generated_o) begin
      if (at_q + 1'b1 == first) state_q <= StSum;
    end else if (data_char) begin
      unique case (state_q)
        StCode: begin
          if (low_q) state_q <= StWait;
          if (!hex) state_q <= StInvalid;
        end
        StData:  if (low_q && last) state_q <= StHead;
        StSum:   state_q <= StSkip;
        default: ;
      endcase
    end else if (silent) state_q <= StSkip;
  end

  always_ff @(posedge clk_i) begin
    if (control) begin
      poll_q <= !byte_i[4];
      invalid_q <= 1'b0;
      low_q <= 1'b0;
      sum_q <= CharsSum ? 7'd0 : byte_i[6:0];
    end else begin
      if (state_q == StCheck) at_q <= (first == info_i.size) ? 4'd0 : first;
      if (generated_o) at_q <= at_q + 1'b1;
      if (data_char && state_q inside {StCode, StData}) begin
        if (!hex) invalid_q <= 1'b1;
        low_q <= !low_q;
        if (state_q == StData && low_q) at_q <= last ? 4'd0 : at_q + 1'b1;
        if (CharsSum) sum_q <= sum_q + byte_i[6:0];
        else sum_q <= sum_q + (low_q ? {3'd0, nibble} : {nibble[2:0], 4'd0});
      end
    end
    if (data_char) high_q <= nibble;
    waited_q <= state_q == StWait;
    if (data_char && state_q == StCode) code_o <= {code_o[3:0], nibble};
  end

  logic unused_info;
  assign unused_info = &{1'b0, info_i};

`ifndef SYNTHESIS
  `PPMC_ASSERT(p312_ser_19, !busy_i || !(poll_o || run_o || fault_o || unknown_code_o))
  `PPMC_ASSERT(p312_ser_14, !run_o || !invalid_q)
`endif

endmodule

`default_nettype wire
