// SPDX-License-Identifier: Apache-2.0
// ppmc_timer: reports that a number of ticks has passed since the last restart. The number is selected from
//         a few constants. For a single constant, use ppmc_delay; for a variable number, use
//         ppmc_xtal_timer.
// Rules:  P104-GEN-02/03.
// Timing: past_o rises at the edge that ends the cycle of the last tick, and is high until the next
//         restart_i. A tick in the cycle of restart_i does not count.
// Assumes: past_o is not used before the first restart, because the flip-flops have no reset.
`default_nettype none

module ppmc_timer #(
    parameter int unsigned Width = 8  // ppmc_lfsr_pkg::width(largest number - 1)
) (
    input  wire logic             clk_i,
    input  wire logic             restart_i,  // strobe: restart the count from 0
    input  wire logic             tick_i,     // strobe: count one tick; constant 1 for times in cycles
    input  wire logic [Width-1:0] last_i,     // LFSR state after(number - 1, Width); stable after restart_i
    output logic                  past_o      // 1: the number of ticks has passed
);

  logic [Width-1:0] count_q;

  always_ff @(posedge clk_i) begin
    if (restart_i) count_q <= Width'(1);
    else if (tick_i) count_q <= Width'(ppmc_lfsr_pkg::step(31'(count_q), Width));

    if (restart_i) past_o <= 1'b0;
    else if (tick_i && count_q == last_i) past_o <= 1'b1;
  end

endmodule

`default_nettype wire
