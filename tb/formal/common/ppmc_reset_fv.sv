// SPDX-License-Identifier: Apache-2.0
// ppmc_reset_fv: for any waveform of the pin, proves that the reset is asserted immediately, and is
// released at the second clock edge that samples the pin high.
`include "ppmc_fv.svh"
`default_nettype none

module ppmc_reset_fv (
    input wire logic clk_i,
    input wire logic pin_ni  // reset pin, asynchronous, unconstrained
);

  logic rst_no;
  logic [1:0] high_q;  // consecutive edges that sampled the pin high, saturates at 2

  `FV_RESET

  ppmc_reset dut (
      .clk_i,
      .rst_ni(pin_ni && rst_ni),
      .rst_no
  );

  always_ff @(posedge clk_i)
    if (!rst_ni || !pin_ni) high_q <= 2'd0;
    else if (high_q != 2'd2) high_q <= high_q + 1'b1;

  `FV_ASSERT(asserted_at_once, pin_ni || !rst_no)
  `FV_ASSERT(released_at_the_second, !pin_ni || rst_no == (high_q == 2'd2))
  `FV_COVER(seen_again, rst_no && $past(!rst_no) && $past(pin_ni, 2) && $past(!pin_ni, 3))

endmodule

`default_nettype wire
