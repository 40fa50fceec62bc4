// SPDX-License-Identifier: Apache-2.0
// ppmc_board_reset: generates the reset of a board from power-on, PLL lock, the button, and the reset line
//         of a host.
// Rules:  drives rst_n of P104-PORT-03. Without a PLL, lock_i is 1; then the initial values of the
//         registers provide the power-on reset.
// Timing: rst_no falls immediately when lock_i falls, and at the third rising edge of clk_i at which req_ni
//         is sampled low. rst_no rises when lock_i and req_ni have been high without interruption for
//         HoldUs to 2 * HoldUs, so the button may bounce.
`default_nettype none

module ppmc_board_reset #(
    parameter int unsigned ClkHz  = 24_000_000,
    parameter int unsigned HoldUs = 1000         // hold time in us, 1 .. 1000
) (
    input  wire logic clk_i,
    input  wire logic lock_i,  // asynchronous; 1: clk_i is stable
    input  wire logic req_ni,  // asynchronous; 0: reset request
    output logic      rst_no
);

  if (ClkHz < 1_000_000 || HoldUs < 1 || HoldUs > 1000) begin : g_check
    $fatal(1, "ppmc_board_reset: ClkHz >= 1e6, HoldUs 1 .. 1000");
  end

  localparam int unsigned Bits = $clog2(ClkHz / 1_000_000 * HoldUs);

  // Without a PLL, lock_i is never low after configuration, so the counter needs an initial value.
  logic [Bits:0] count_q = '0;
  logic unused_meta, req_n;

  assign rst_no = count_q[Bits];

  ppmc_sync #(
      .Width   (1),
      .ResetVal(1'b0)
  ) u_sync (
      .clk_i,
      .rst_ni(lock_i),
      .d_i   (req_ni),
      .q1_o  (unused_meta),
      .q2_o  (req_n)
  );

  always_ff @(posedge clk_i or negedge lock_i) begin
    if (!lock_i) count_q <= '0;
    else if (!req_n) count_q <= '0;
    else if (!rst_no) count_q <= count_q + 1'b1;
  end

endmodule

`default_nettype wire
