// SPDX-License-Identifier: Apache-2.0
// pmc006_serial: serial interface to the host. Receives frames, and sends one reply to each valid frame.
// Rules:  P006-UART-01..05, P006-FRM-03/04/07/10, P006-BAD-05/06.
// Timing: e is the edge at which the last stop bit of a frame is sampled; ceil(n bits) is n bit times in
//         cycles, rounded up. frame_o.go is high in the cycle after e. de_o rises ceil(1 bit) after e. Bit
//         edge n of the reply occurs ceil((2 + n) bits) after e. de_o falls ceil(82 bits) after e. The
//         receiver is off from e + 1 until ceil(81.5 bits) after e. This is the middle of the last stop bit
//         of the reply, when a host has received the complete reply.
// How:    a bit is one full turn of an accumulator with an exact modulus, so the bit edges do not drift.
`include "ppmc_assert.svh"
`default_nettype none

module pmc006_serial
  import pmc006_pkg::frame_t;
#(
    parameter int unsigned ClkHz = 16_000_000,
    parameter int unsigned Baud  = 9600
) (
    input  wire logic        clk_i,
    input  wire logic        rst_ni,
    input  wire logic        ready_i,  // 0: switch the receiver off
    input  wire logic [ 7:0] addr_i,   // address of the device
    input  wire logic        rxd_i,    // from the host, raw pin
    output logic             txd_o,    // to the host, idle high
    output logic             de_o,     // 1: the line driver is on
    output frame_t           frame_o,  // valid frame for this device
    input  wire logic [31:0] reply_i   // data of the reply; stable from half a bit after frame_o.go
);

  localparam longint unsigned ClkBaudGcd = ppmc_pkg::gcd(64'(ClkHz), 64'(Baud));
  // Makes the modulus even, so that the middle of a bit is exact.
  localparam longint unsigned EvenFactor = ((64'(ClkHz) / ClkBaudGcd) % 2 == 0) ? 64'd1 : 64'd2;
  localparam longint unsigned Modulus = EvenFactor * 64'(ClkHz) / ClkBaudGcd;
  localparam longint unsigned BitUnits = EvenFactor * 64'(Baud) / ClkBaudGcd;
  localparam int unsigned Width = 32'($clog2(Modulus));
  localparam longint unsigned WrapOffset = (64'd1 << Width) - Modulus;
  localparam logic [Width-1:0] Step = Width'(BitUnits);
  localparam logic [Width-1:0] Wrap = Width'(BitUnits + WrapOffset);
  localparam logic [Width-1:0] WrapHalf = Width'(BitUnits + WrapOffset + Modulus / 64'd2);
  // Initial phases. They are loaded in the cycle of valid, two cycles after the stop bit was sampled. The
  // bit ends one bit time (PhaseZero) or half a bit time (PhaseHalf) after this sample.
  localparam logic [Width-1:0] PhaseZero = Width'(WrapOffset + 64'd2 * BitUnits);
  localparam logic [Width-1:0] PhaseHalf = Width'(WrapOffset + 64'd2 * BitUnits + Modulus / 64'd2);
  // Silence after which the next byte begins a new frame: 192 bits until the start bit of this byte, plus 9.5
  // bits from there to the middle of its stop bit; rounded up.
  localparam int unsigned SilenceBits = 202;

  logic [7:0] char, next_byte, sum_q, bits_q;
  logic valid, error, unused_break, line, unused_meta;
  logic rx_on, line_high_q, rx_off_q, timeout, bit_tick_q, in_stop_bit;
  logic [Width-1:0] phase_q;
  logic [3:0] bits_left_q, byte_index_q;

  // ---- receiver -------------------------------------------------------------------------------------------

  // When the receiver is switched on, it ignores the line until the line is high. Otherwise it could
  // mistake the rest of a byte for a start bit.
  ppmc_sync u_line (
      .clk_i,
      .rst_ni,
      .d_i (rxd_i),
      .q1_o(unused_meta),
      .q2_o(line)
  );

  assign rx_on = ready_i && !rx_off_q;

  always_ff @(posedge clk_i) line_high_q <= rx_on && (line_high_q || line);

  ppmc_uart_rx #(
      .Width  (Width),
      .Modulus(Modulus)
  ) u_rx (
      .clk_i,
      .rst_ni,
      .step_i (Step),
      .wrap_i (Wrap),
      .rxd_i  (rxd_i || !line_high_q),
      .byte_o (char),
      .valid_o(valid),
      .error_o(error),
      .break_o(unused_break)
  );

  pmc006_frame u_frame (
      .clk_i,
      .rst_ni,
      .addr_i,
      .byte_i(char),
      .valid_i(valid && rx_on),
      .error_i(error),
      .timeout_i(timeout),
      .frame_o
  );

  // ---- bits since the last byte ---------------------------------------------------------------------------

  always_ff @(posedge clk_i) begin
    if (valid) {bit_tick_q, phase_q} <= {1'b0, frame_o.go ? PhaseZero : PhaseHalf};
    else
      {bit_tick_q, phase_q} <= {1'b0, phase_q} + {1'b0, !bit_tick_q ? Step : in_stop_bit ? WrapHalf : Wrap};
  end

  ppmc_delay #(
      .Ticks(SilenceBits)
  ) u_silence (
      .clk_i,
      .restart_i(valid),
      .tick_i   (bit_tick_q),
      .past_o   (timeout)
  );

  // ---- reply ----------------------------------------------------------------------------------------------

  // The last stop bit is divided into two halves, because the receiver is switched on in the middle.
  assign in_stop_bit = de_o && byte_index_q[3] && bits_left_q <= 4'd1;

  always_comb begin
    unique case (byte_index_q[2:0])
      3'd0:    next_byte = 8'ha5;
      3'd1:    next_byte = 8'h7a;
      3'd2:    next_byte = addr_i;
      3'd3:    next_byte = reply_i[7:0];
      3'd4:    next_byte = reply_i[15:8];
      3'd5:    next_byte = reply_i[23:16];
      3'd6:    next_byte = reply_i[31:24];
      default: next_byte = sum_q;
    endcase
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      rx_off_q <= 1'b0;
      de_o <= 1'b0;
      txd_o <= 1'b1;
    end else if (frame_o.go) rx_off_q <= 1'b1;
    else if (bit_tick_q && (rx_off_q || de_o)) begin
      de_o <= rx_off_q;
      if (de_o && bits_left_q != '0) txd_o <= bits_q[0];
      else if (de_o && byte_index_q[3]) rx_off_q <= 1'b0;
      else if (de_o) txd_o <= 1'b0;
    end
  end

  always_ff @(posedge clk_i) begin
    if (frame_o.go) begin
      bits_left_q <= '0;
      byte_index_q <= '0;
      sum_q <= '0;
    end else if (de_o && bit_tick_q) begin
      if (bits_left_q != '0) begin
        bits_left_q <= bits_left_q - 1'b1;
        bits_q <= {1'b1, bits_q[7:1]};
        if (bits_left_q == 4'd9) sum_q <= sum_q + bits_q;
      end else if (!byte_index_q[3]) begin
        bits_left_q <= 4'd9;
        bits_q <= next_byte;
        byte_index_q <= byte_index_q + 1'b1;
      end
    end
  end

`ifndef SYNTHESIS
  `PPMC_ASSERT(p006_frm_07, !de_o || rx_off_q || in_stop_bit)
  `PPMC_ASSERT(p006_frm_03, de_o || txd_o)
`endif

endmodule

`default_nettype wire
