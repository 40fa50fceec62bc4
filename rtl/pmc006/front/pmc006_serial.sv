// SPDX-License-Identifier: Apache-2.0
// pmc006_serial: serial line to the host: receives frames, sends one reply for each frame that is executed.
// Rules:  sections 2.1..2.4, P006-FRM-03/04/07/10, P006-BAD-05/06.
// Timing: e = the edge of the last stop-bit sample. frame_o.go is high in the cycle after e; de_o rises
//         ceil(1 bit) after e; bit edge n occurs ceil((2 + n) bits) after e; de_o falls ceil(82 bits) after
//         e. The receiver is off from e + 1 until ceil(81.5 bits) after e. This is the middle of the last
//         stop bit, when a host has received the complete reply.
// How:    each bit lasts one full turn of an accumulator with an exact modulus.
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
    input  wire logic        ready_i,  // 0: the receiver is off
    input  wire logic [ 7:0] addr_i,   // address of the device
    input  wire logic        rxd_i,    // raw pin
    output logic             txd_o,    // to the host, idle high
    output logic             de_o,     // the line driver is on
    output frame_t           frame_o,  // frame to be executed
    input  wire logic [31:0] reply_i   // stable from half a bit after frame_o.go
);

  localparam longint unsigned Common = ppmc_pkg::gcd(64'(ClkHz), 64'(Baud));
  // Even, so that the middle of a bit is exact.
  localparam longint unsigned Twice = ((64'(ClkHz) / Common) % 2 == 0) ? 64'd1 : 64'd2;
  localparam longint unsigned Modulus = Twice * 64'(ClkHz) / Common;
  localparam longint unsigned Unit = Twice * 64'(Baud) / Common;
  localparam int unsigned Width = 32'($clog2(Modulus));
  localparam longint unsigned Rest = (64'd1 << Width) - Modulus;
  localparam logic [Width-1:0] Step = Width'(Unit);
  localparam logic [Width-1:0] Wrap = Width'(Unit + Rest);
  localparam logic [Width-1:0] WrapHalf = Width'(Unit + Rest + Modulus / 64'd2);
  // Phases after a sample. Bits are counted from the sample, whose result is available two cycles later.
  localparam logic [Width-1:0] Zero = Width'(Rest + 64'd2 * Unit);
  localparam logic [Width-1:0] Half = Width'(Rest + 64'd2 * Unit + Modulus / 64'd2);
  // 192 bits to the next start bit, then 9.5 bits to the middle of the stop bit of this byte.
  localparam int unsigned Silence = 202;

  logic [7:0] char, next, sum_q, bits_q;
  logic valid, error, unused_break, line, unused_meta;
  logic listen, open_q, deaf_q, late, over_q, stop;
  logic [Width-1:0] phase_q;
  logic [3:0] left_q, at_q;

  // ---- receiver -------------------------------------------------------------------------------------------

  // After the receiver was off, the line must be high once before a byte is received. Otherwise the rest of a
  // byte could be mistaken for a start bit.
  ppmc_sync u_line (
      .clk_i,
      .rst_ni,
      .d_i (rxd_i),
      .q1_o(unused_meta),
      .q2_o(line)
  );

  assign listen = ready_i && !deaf_q;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) open_q <= 1'b0;
    else open_q <= listen && (open_q || line);
  end

  ppmc_uart_rx #(
      .Width  (Width),
      .Modulus(Modulus)
  ) u_rx (
      .clk_i,
      .rst_ni,
      .step_i (Step),
      .wrap_i (Wrap),
      .rxd_i  (rxd_i || !open_q),
      .byte_o (char),
      .valid_o(valid),
      .error_o(error),
      .break_o(unused_break)
  );

  pmc006_frame u_frame (
      .clk_i,
      .rst_ni,
      .addr_i,
      .byte_i (char),
      .valid_i(valid && listen),
      .error_i(error),
      .late_i (late),
      .frame_o
  );

  // ---- bits since the last byte ---------------------------------------------------------------------------

  always_ff @(posedge clk_i) begin
    if (valid) {over_q, phase_q} <= {1'b0, frame_o.go ? Zero : Half};
    else {over_q, phase_q} <= {1'b0, phase_q} + {1'b0, !over_q ? Step : stop ? WrapHalf : Wrap};
  end

  ppmc_delay #(
      .Ticks(Silence)
  ) u_silence (
      .clk_i,
      .restart_i(valid),
      .tick_i   (over_q),
      .past_o   (late)
  );

  // ---- reply ----------------------------------------------------------------------------------------------

  // The last stop bit consists of two halves; the receiver is switched on between them.
  assign stop = de_o && at_q[3] && left_q <= 4'd1;

  always_comb begin
    unique case (at_q[2:0])
      3'd0:    next = 8'ha5;
      3'd1:    next = 8'h7a;
      3'd2:    next = addr_i;
      3'd3:    next = reply_i[7:0];
      3'd4:    next = reply_i[15:8];
      3'd5:    next = reply_i[23:16];
      3'd6:    next = reply_i[31:24];
      default: next = sum_q;
    endcase
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      deaf_q <= 1'b0;
      de_o   <= 1'b0;
      txd_o  <= 1'b1;
    end else if (frame_o.go) deaf_q <= 1'b1;
    else if (over_q && (deaf_q || de_o)) begin
      de_o <= deaf_q;
      if (de_o && left_q != '0) txd_o <= bits_q[0];
      else if (de_o && at_q[3]) deaf_q <= 1'b0;
      else if (de_o) txd_o <= 1'b0;
    end
  end

  always_ff @(posedge clk_i) begin
    if (frame_o.go) begin
      left_q <= '0;
      at_q   <= '0;
      sum_q  <= '0;
    end else if (de_o && over_q) begin
      if (left_q != '0) begin
        left_q <= left_q - 1'b1;
        bits_q <= {1'b1, bits_q[7:1]};
        if (left_q == 4'd9) sum_q <= sum_q + bits_q;
      end else if (!at_q[3]) begin
        left_q <= 4'd9;
        bits_q <= next;
        at_q   <= at_q + 1'b1;
      end
    end
  end

`ifndef SYNTHESIS
  `PPMC_ASSERT(p006_frm_07, !de_o || deaf_q || stop)
  `PPMC_ASSERT(p006_frm_03, de_o || txd_o)
`endif

endmodule

`default_nettype wire
