// SPDX-License-Identifier: Apache-2.0
// ppmc_board_led_stretch: stretches a short event, so that it is visible on an LED.
// Rules:  docs/boards.md, LEDs.
// Timing: led_o rises one cycle after on_i. It falls a fixed time after the last cycle in which on_i = 1.
//         This time is a power of two in cycles, between 1/32 s and 1/16 s.
`default_nettype none

module ppmc_board_led_stretch #(
    parameter int unsigned ClkHz = 24_000_000
) (
    input  wire logic clk_i,
    input  wire logic rst_ni,
    input  wire logic on_i,
    output logic      led_o
);

  localparam int unsigned Bits = $clog2(ClkHz / 32);

  logic [Bits-1:0] left_q;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      led_o  <= 1'b0;
      left_q <= '0;
    end else if (on_i) begin
      led_o  <= 1'b1;
      left_q <= '1;
    end else begin
      led_o <= left_q != '0;
      if (left_q != '0) left_q <= left_q - 1'b1;
    end
  end

endmodule

`default_nettype wire
