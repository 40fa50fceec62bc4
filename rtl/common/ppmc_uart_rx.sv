// SPDX-License-Identifier: Apache-2.0
// ppmc_uart_rx: UART receiver with 8 data bits, no parity, 1 stop bit, for any rate up to clk / 5.
// Rules:  UB-LIN-01, UB-LIN-03 .. 05.
// Timing: the block synchronises the line, and samples each bit in its middle, to the nearest cycle.
//         valid_o or error_o is high for one cycle in the middle of the stop bit. byte_o is valid for at
//         least one more bit time.
// Rate:   Modulus = 0: step_i = 2**Width * rate / clk. A change of step_i is effective immediately.
//         Modulus != 0 makes bit times exact fractions: step_i = Modulus * rate / clk, and wrap_i = step_i
//         - Modulus. Modulus must be even and greater than 2**(Width-1).
`include "ppmc_assert.svh"
`default_nettype none

module ppmc_uart_rx #(
    parameter int unsigned     Width   = 20,  // bits of the phase accumulator
    parameter longint unsigned Modulus = 0    // phases per bit; 0: 2**Width
) (
    input  wire logic             clk_i,
    input  wire logic             rst_ni,
    input  wire logic [Width-1:0] step_i,   // phases per cycle
    input  wire logic [Width-1:0] wrap_i,   // step_i - Modulus; ignored if Modulus = 0
    input  wire logic             rxd_i,    // line, asynchronous; idle high
    output logic      [      7:0] byte_o,   // received character; valid with valid_o
    output logic                  valid_o,  // strobe: a character with a high stop bit was received
    output logic                  error_o,  // strobe: a character with a low stop bit was received
    output logic                  break_o   // with error_o; 1: all data bits were also low
);

  typedef enum logic [1:0] {
    StIdle,
    StStart,
    StBits,
    StWaitHigh
  } state_e;

  localparam logic [Width-1:0] Half = (Modulus == 0) ? {1'b1, {(Width - 1) {1'b0}}} : Width'(-(Modulus / 2));

  state_e state_q;
  logic line, unused_meta, has_one_q, middle;
  logic [Width-1:0] phase_q, phase_d;
  logic [3:0] bits_left_q;  // remaining data bits; 0: the next bit is the stop bit

  ppmc_sync u_sync (
      .clk_i,
      .rst_ni,
      .d_i (rxd_i),
      .q1_o(unused_meta),
      .q2_o(line)
  );

  // Between characters, the phase is one half, so the first carry marks the middle of the start bit. On
  // average, the edge of the line occurs half a cycle before it is sampled. Therefore the cycle of the
  // sample counts as part of the start bit.
  if (Modulus == 0) begin : g_binary
    logic unused_wrap;

    assign unused_wrap = &{1'b0, wrap_i};
    assign {middle, phase_d} = {1'b0, phase_q} + {1'b0, step_i};
  end else begin : g_modulus
    // The phase has the offset -Modulus, so that a carry occurs every Modulus phases. The step after a carry
    // (wrap_i) restores this offset. The phase is set to Half at the end of a character, because the next
    // character may begin in the next cycle.
    logic wrapped_q, char_ends;
    logic [Width-1:0] sum;

    assign {middle, sum} = {1'b0, phase_q} + {1'b0, wrapped_q ? wrap_i : step_i};
    assign char_ends = state_q == StWaitHigh ||
        (middle && (state_q == StStart ? line : state_q == StBits && bits_left_q == '0));
    assign phase_d = char_ends ? Half : sum;
    always_ff @(posedge clk_i) wrapped_q <= middle && !char_ends;
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      state_q <= StWaitHigh;
      valid_o <= 1'b0;
      error_o <= 1'b0;
    end else begin
      valid_o <= 1'b0;
      error_o <= 1'b0;
      unique case (state_q)
        StIdle:  if (!line) state_q <= StStart;
        StStart: if (middle) state_q <= line ? StIdle : StBits;
        StBits:
        if (middle && bits_left_q == '0) begin
          valid_o <= line;
          error_o <= !line;
          state_q <= line ? StIdle : StWaitHigh;
        end
        default: if (line) state_q <= StIdle;  // StWaitHigh
      endcase
    end
  end

  assign break_o = !has_one_q;

  always_ff @(posedge clk_i) begin
    phase_q <= (state_q == StIdle && line) ? Half : phase_d;
    if (state_q == StStart) begin
      bits_left_q <= 4'd8;
      has_one_q   <= 1'b0;
    end else if (state_q == StBits && middle && bits_left_q != '0) begin
      bits_left_q <= bits_left_q - 1'b1;
      byte_o <= {line, byte_o[7:1]};
      has_one_q <= has_one_q || line;
    end
  end

`ifndef SYNTHESIS
  `PPMC_ASSERT(ub_lin_05_one_outcome, !(valid_o && error_o))
`endif

endmodule

`default_nettype wire
