// SPDX-License-Identifier: Apache-2.0
// ppmc_uart_rx: UART receiver, 8 data bits, no parity, 1 stop bit; any rate up to clk / 5.
// Rules:  UB-LIN-01, UB-LIN-03 .. 05.
// Timing: the line is synchronised here. Each bit is sampled in its middle, to the nearest clk. valid_o or error_o is
//         1 for one clk in the middle of the stop bit; byte_o stands for one more bit time at least.
// Rate:   step_i = 2**Width * rate / clk; it may change at any time and acts at once. With a Modulus (even, above
//         2**(Width-1)) bits are exact fractions: step_i = Modulus * rate / clk, wrap_i = step_i - Modulus.
`include "ppmc_assert.svh"
`default_nettype none

module ppmc_uart_rx #(
    parameter int unsigned     Width   = 20,  // of the phase accumulator
    parameter longint unsigned Modulus = 0    // phases of a bit; 0: 2**Width
) (
    input  wire logic             clk_i,
    input  wire logic             rst_ni,
    input  wire logic [Width-1:0] step_i,   // phases a clk
    input  wire logic [Width-1:0] wrap_i,   // only with a Modulus
    input  wire logic             rxd_i,    // raw pin, idle high
    output logic      [      7:0] byte_o,   // the character, with valid_o
    output logic                  valid_o,  // a character with a high stop bit
    output logic                  error_o,  // one with a low stop bit
    output logic                  break_o   // with error_o: all data bits were low as well
);

  typedef enum logic [1:0] {
    StIdle,
    StStart,
    StBits,
    StWaitHigh
  } state_e;

  localparam logic [Width-1:0] Half = (Modulus == 0) ? {1'b1, {(Width - 1) {1'b0}}} : Width'(-(Modulus / 2));

  state_e state_q;
  logic line, unused_meta, any_q, middle;
  logic [Width-1:0] phase_q, phase_d;
  logic [3:0] left_q;  // bits left, the stop bit is the last

  ppmc_sync u_sync (
      .clk_i,
      .rst_ni,
      .d_i (rxd_i),
      .q1_o(unused_meta),
      .q2_o(line)
  );

  // An idle phase stands at one half, so the first carry is the middle of the start bit. The edge lies half a clk
  // before the clk that sees it: that one counts as well.
  if (Modulus == 0) begin : g_binary
    logic unused_wrap;

    assign unused_wrap = &{1'b0, wrap_i};
    assign {middle, phase_d} = {1'b0, phase_q} + {1'b0, step_i};
  end else begin : g_modulus
    // The phase begins so far up that a bit ends with a carry; the next step takes it there again. A character may
    // follow on the very clk that has ended the one before.
    logic over_q, ends;
    logic [Width-1:0] sum;

    assign {middle, sum} = {1'b0, phase_q} + {1'b0, over_q ? wrap_i : step_i};
    assign ends = state_q == StWaitHigh ||
        (middle && (state_q == StStart ? line : state_q == StBits && left_q == '0));
    assign phase_d = ends ? Half : sum;
    always_ff @(posedge clk_i) over_q <= middle && !ends;
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
        if (middle && left_q == '0) begin
          valid_o <= line;
          error_o <= !line;
          state_q <= line ? StIdle : StWaitHigh;
        end
        default: if (line) state_q <= StIdle;  // StWaitHigh
      endcase
    end
  end

  assign break_o = !any_q;

  always_ff @(posedge clk_i) begin
    phase_q <= (state_q == StIdle && line) ? Half : phase_d;
    if (state_q == StStart) begin
      left_q <= 4'd8;
      any_q  <= 1'b0;
    end else if (state_q == StBits && middle && left_q != '0) begin
      left_q <= left_q - 1'b1;
      byte_o <= {line, byte_o[7:1]};
      any_q  <= any_q || line;
    end
  end

`ifndef SYNTHESIS
  `PPMC_ASSERT(ub_lin_05_one_outcome, !(valid_o && error_o))
`endif

endmodule

`default_nettype wire
