// SPDX-License-Identifier: Apache-2.0
// ppmc_timer: whether so many ticks have come since the last restart, for one of a few numbers that are known at
//         elaboration (ppmc_delay: one alone; ppmc_xtal_timer: any).
// Rules:  P104-GEN-02/03.
// Timing: past_o rises at the edge that ends the cycle of that tick and stands until the next restart_i; a tick in
//         the cycle of restart_i does not count. No reset: nobody asks before the first restart.
`default_nettype none

module ppmc_timer #(
    parameter int unsigned Width = 8  // ppmc_lfsr_pkg::width(longest number - 1)
) (
    input  wire logic             clk_i,
    input  wire logic             restart_i,  // count from 0
    input  wire logic             tick_i,     // counts; 1 for times in clk
    input  wire logic [Width-1:0] last_i,     // after(number - 1, Width); steady from the next clk on
    output logic                  past_o      // so many have come
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
