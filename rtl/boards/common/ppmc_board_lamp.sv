// SPDX-License-Identifier: Apache-2.0
// ppmc_board_lamp: makes a short event long enough to be seen on a lamp.
// Rules:  docs/boards.md, lamps.
// Timing: lamp_o rises one clk after on_i and falls 2^n clk after the last clk with on_i = 1, 1/32 .. 1/16 s.
`default_nettype none

module ppmc_board_lamp #(
    parameter int unsigned ClkHz = 24_000_000
) (
    input  wire logic clk_i,
    input  wire logic rst_ni,
    input  wire logic on_i,
    output logic      lamp_o
);

  localparam int unsigned Bits = $clog2(ClkHz / 32);

  logic [Bits-1:0] left_q;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      lamp_o <= 1'b0;
      left_q <= '0;
    end else if (on_i) begin
      lamp_o <= 1'b1;
      left_q <= '1;
    end else begin
      lamp_o <= left_q != '0;
      if (left_q != '0) left_q <= left_q - 1'b1;
    end
  end

endmodule

`default_nettype wire
