// SPDX-License-Identifier: Apache-2.0
// ppmc_uart_tx: UART transmitter with 8 data bits, no parity, 1 stop bit, for any rate up to clk / 2.
// Rules:  UB-LIN-01, UB-LIN-03.
// Timing: a byte is accepted in a cycle in which valid_i and ready_o are high. Its start bit begins at the
//         next edge. ready_o rises at the end of the stop bit, so the gap between two characters may be one
//         cycle.
// Rate:   step_i = 2**Width * rate / clk.
// Assumes: step_i is constant while a character is sent.
`default_nettype none

module ppmc_uart_tx #(
    parameter int unsigned Width = 20  // bits of the phase accumulator
) (
    input  wire logic             clk_i,
    input  wire logic             rst_ni,
    input  wire logic [Width-1:0] step_i,   // phases per cycle
    input  wire logic [      7:0] byte_i,   // character to be sent
    input  wire logic             valid_i,  // 1: byte_i is valid
    output logic                  ready_o,  // 1: a byte is accepted with valid_i
    output logic                  txd_o     // line, idle high
);

  logic [Width-1:0] phase_q, phase_d;
  logic [8:0] bits_q;  // remaining data bits and the stop bit
  logic [3:0] bits_left_q;  // bits that remain after the current bit
  logic bit_end;

  assign {bit_end, phase_d} = {1'b0, phase_q} + {1'b0, step_i};

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      ready_o <= 1'b1;
      txd_o   <= 1'b1;
    end else if (ready_o) begin
      ready_o <= !valid_i;
      txd_o   <= !valid_i;
    end else if (bit_end) begin
      ready_o <= bits_left_q == '0;
      txd_o   <= bits_q[0];
    end
  end

  // The phase starts at 0, so bit edge n occurs ceil(n * bit time) cycles after the start. Relative to an
  // ideal bit grid that begins half a cycle after the start, each edge is at most half a cycle early or late.
  always_ff @(posedge clk_i) begin
    phase_q <= ready_o ? '0 : phase_d;
    if (ready_o) begin
      bits_left_q <= 4'd9;
      bits_q <= {1'b1, byte_i};
    end else if (bit_end) begin
      bits_left_q <= bits_left_q - 1'b1;
      bits_q <= {1'b1, bits_q[8:1]};
    end
  end

endmodule

`default_nettype wire
