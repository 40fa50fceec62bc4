// SPDX-License-Identifier: Apache-2.0
// ppmc_delay: reports that a constant number of ticks has passed since the last restart.
// Rules:  P104-GEN-02/03; P312-GEN-02, times of P312-OUT-01/02, P312-INP-33, P312-SER-10..17.
// Timing: same as ppmc_timer. For a time of n crystal cycles, set tick_i = 1 and
//         Ticks = ppmc_pkg::cyc(n, ClkHz, XtalHz). Then, after a restart at edge e, past_o is high from edge
//         e + ceil(n * ClkHz / XtalHz) on.
`default_nettype none

module ppmc_delay #(
    parameter int unsigned Ticks = 16  // number of ticks, 1 .. 2**24 - 1
) (
    input  wire logic clk_i,
    input  wire logic restart_i,  // strobe: restart the count from 0
    input  wire logic tick_i,     // strobe: count one tick
    output logic      past_o      // 1: the ticks have passed since the restart
);

  localparam int unsigned Width = ppmc_lfsr_pkg::width(Ticks - 1);

  ppmc_timer #(
      .Width(Width)
  ) u_timer (
      .clk_i,
      .restart_i,
      .tick_i,
      .last_i(Width'(ppmc_lfsr_pkg::after(Ticks - 1, Width))),
      .past_o
  );

endmodule

`default_nettype wire
