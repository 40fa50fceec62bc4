// SPDX-License-Identifier: Apache-2.0
// ppmc312_serial_tx: sends a reply when the line is free. Raises snd_o, then sends control code,
//         hexadecimal data and checksum.
// Rules:  P312-SER-01/02, P312-SER-13, P312-SER-18.
// Timing: snd_o rises one cycle after send_i, but at least ceil((1 + SndWait) * bit time) + 2 cycles after
//         rx_char_i. rx_char_i marks the middle of a stop bit, so the line was idle for SndWait + 0.5 bit
//         times. Edge n of the frame occurs ceil(n * bit time) after the rise of snd_o. The first start bit
//         begins at edge SndLead. snd_o falls at the last edge.
// Rate:   the phase has Width bits and increases by step_i per cycle. An overflow ends a bit. The next
//         cycle then adds wrap_i (step_i minus the modulus) instead of step_i.
`include "ppmc_assert.svh"
`default_nettype none

module ppmc312_serial_tx
  import ppmc312_serial_pkg::*;
#(
    parameter int unsigned Width    = 20,
    parameter bit          CharsSum = 1'b0,
    parameter int unsigned SndLead  = 1,     // bit times from the rise of snd_o to the start bit, 1 .. 16
    parameter int unsigned SndWait  = 0      // snd_o rises SndWait + 0.5 bit times after a stop bit, 0 .. 8
) (
    input  wire logic               clk_i,            // clock
    input  wire logic               rst_ni,           // reset, asynchronous
    input  wire logic   [      3:0] adr_i,            // station number
    input  wire logic   [Width-1:0] step_i,           // phase increment per cycle
    input  wire logic   [Width-1:0] wrap_i,           // step_i minus the modulus, modulo 2**Width
    input  wire logic               rx_char_i,        // strobe: middle of a received stop bit
    input  wire logic               send_i,           // send reply_i; high until sent_o
    input  wire reply_t             reply_i,          // reply, stable while send_i = 1
    output logic        [      1:0] index_o,          // index of the data byte
    input  wire logic   [      7:0] response_byte_i,  // byte index_o of the response, two cycles later
    output logic                    sent_o,           // strobe: the reply has been sent
    output logic                    txd_o,            // line, idle high
    output logic                    snd_o             // 1: drive the line
);

  typedef enum logic [1:0] {
    StControl,
    StHigh,
    StLow,
    StSum
  } state_e;

  state_e state_q;
  localparam int unsigned GapBits = $clog2(SndWait + 2);

  logic bit_end, last_q;
  logic [GapBits-1:0] gap_q;  // bit times until the line is free
  logic [Width-1:0] phase_q;
  logic [2:0] at_q;  // number of data bytes sent
  logic [3:0] left_q;  // remaining bits of the character
  logic [7:0] bits_q, char;
  logic [6:0] sum_q, control;
  logic [7:0] data;
  logic [3:0] nibble;

  // ---- characters ---------------------------------------------------------------------------------

  assign index_o = at_q[1:0];
  assign control = {1'b0, reply_i.kind, adr_i};

  always_comb begin
    unique case (at_q[1:0])
      2'd0:    data = reply_i.data[0];
      2'd1:    data = reply_i.data[1];
      default: data = reply_i.data[2];
    endcase
    if (reply_i.from_response) data = response_byte_i;
    nibble = (state_q == StHigh) ? data[7:4] : data[3:0];
    unique case (state_q)
      StControl: char = {1'b1, control};
      StSum:     char = {1'b0, ~sum_q};
      default:   char = (nibble > 4'd9) ? 8'(nibble) + 8'h57 : {4'h3, nibble};
    endcase
  end

  // ---- bits ---------------------------------------------------------------------------------------

  assign sent_o = snd_o && bit_end && left_q == '0 && last_q;

  // The phase starts one step ahead, to compensate for the registers of the pins. The phase also times the
  // gap before the reply. This gap has at most 9 bits, so it ends before the next stop bit can be received.
  always_ff @(posedge clk_i) begin
    if (!snd_o && gap_q == '0) {bit_end, phase_q} <= {1'b0, wrap_i};
    else {bit_end, phase_q} <= {1'b0, phase_q} + {1'b0, bit_end ? wrap_i : step_i};
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      snd_o <= 1'b0;
      txd_o <= 1'b1;
      gap_q <= '0;
    end else begin
      if (sent_o) snd_o <= 1'b0;
      else if (send_i && gap_q == '0) snd_o <= 1'b1;
      if (rx_char_i) gap_q <= GapBits'(SndWait + 1);
      else if (bit_end && gap_q != '0) gap_q <= gap_q - 1'b1;
      if (snd_o && bit_end) txd_o <= (left_q == '0) ? last_q : bits_q[0];
    end
  end

  always_ff @(posedge clk_i) begin
    if (!snd_o) begin
      state_q <= StControl;
      left_q  <= 4'(SndLead - 1);
      last_q  <= 1'b0;
      at_q    <= '0;
      if (SndLead > 1) bits_q <= '1;
    end else if (bit_end && left_q != '0) begin
      left_q <= left_q - 1'b1;
      bits_q <= {1'b1, bits_q[7:1]};
    end else if (bit_end) begin
      left_q <= 4'd9;
      bits_q <= char;
      unique case (state_q)
        StControl: begin
          sum_q   <= CharsSum ? 7'd0 : control;
          state_q <= (reply_i.count == '0) ? StSum : StHigh;
        end
        StHigh: begin
          sum_q   <= sum_q + (CharsSum ? char[6:0] : {nibble[2:0], 4'd0});
          state_q <= StLow;
        end
        StLow: begin
          sum_q   <= sum_q + (CharsSum ? char[6:0] : {3'd0, nibble});
          state_q <= (at_q + 1'b1 == reply_i.count) ? StSum : StHigh;
          at_q    <= at_q + 1'b1;
        end
        default: last_q <= 1'b1;
      endcase
    end
  end

`ifndef SYNTHESIS
  `PPMC_ASSERT(p312_ser_18_gate, txd_o || snd_o)
`endif

endmodule

`default_nettype wire
