// SPDX-License-Identifier: Apache-2.0
// ppmc_board_leds: generates the reset of a board and drives its LEDs.
// Rules:  docs/boards.md, LEDs.
// Timing: see ppmc_board_reset and ppmc_board_led_stretch.
`default_nettype none

module ppmc_board_leds #(
    parameter int unsigned ClkHz = 24_000_000
) (
    input  wire logic       clk_i,
    input  wire logic       lock_i,    // 1: clk_i is stable; 1 without a PLL
    input  wire logic       req_ni,    // 0: reset request
    output logic            rst_no,
    input  wire logic       link_i,
    input  wire logic       moving_i,
    input  wire logic       switch_i,  // 1: at least one switch is active
    output logic      [3:0] leds_o     // 1: on; [3]: out of reset, [2]: switch, [1]: motor moves, [0]: link
);

  logic led_link;

  ppmc_board_reset #(
      .ClkHz(ClkHz)
  ) u_reset (
      .clk_i,
      .lock_i,
      .req_ni,
      .rst_no
  );

  ppmc_board_led_stretch #(
      .ClkHz(ClkHz)
  ) u_led_link (
      .clk_i,
      .rst_ni(rst_no),
      .on_i  (link_i),
      .led_o (led_link)
  );

  assign leds_o = {rst_no, switch_i, moving_i, led_link};

endmodule

`default_nettype wire
