// SPDX-License-Identifier: Apache-2.0
// ppmc_delay, stub with a binary counter instead of an LFSR, which is easier to relate to other counters.
// ppmc_delay_fv proves that past_o of the real one rises with the same tick.
`default_nettype none

module ppmc_delay #(
    parameter int unsigned Ticks = 16
) (
    input  wire logic clk_i,
    input  wire logic restart_i,
    input  wire logic tick_i,
    output logic      past_o
);

  localparam int unsigned Width = $clog2(Ticks + 1);
  logic [Width-1:0] count_q;

  assign past_o = count_q == Width'(Ticks);

  always_ff @(posedge clk_i)
    if (restart_i) count_q <= '0;
    else if (tick_i && !past_o) count_q <= count_q + 1'b1;

endmodule

`default_nettype wire
