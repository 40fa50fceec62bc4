// SPDX-License-Identifier: Apache-2.0
// ppmc_xtal_timer: counts crystal cycles from a restart on, and reports that a variable number has passed.
// Rules:  P104-GEN-02/03 for times that are not known at elaboration.
// Timing: after a restart at edge e, past_o is high from edge e + ceil(limit * ClkHz / XtalHz) on. A
//         register that past_o enables changes one edge later. The count stops at its maximum and never
//         wraps.
`default_nettype none

module ppmc_xtal_timer #(
    parameter int unsigned ClkHz  = 16_000_000,  // at least XtalHz / 3
    parameter int unsigned XtalHz = 16_000_000,
    parameter int unsigned Width  = 22           // bits of limit_i
) (
    input  wire logic             clk_i,
    input  wire logic             rst_ni,
    input  wire logic             restart_i,  // strobe: restart the count from 0
    input  wire logic [Width-1:0] limit_i,    // number of crystal cycles
    output logic                  past_o      // 1: limit_i crystal cycles have passed
);

  logic [1:0] cycles;
  logic full;
  logic [Width-1:0] count_q;

  assign full = (64'(XtalHz) > 64'd2 * 64'(ClkHz)) ? &count_q[Width-1:2] : &count_q[Width-1:1];

  ppmc_xtal_cycles #(
      .ClkHz (ClkHz),
      .XtalHz(XtalHz)
  ) u_cycles (
      .clk_i,
      .rst_ni,
      .restart_i,
      .cycles_o(cycles)
  );

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) count_q <= '0;
    else if (restart_i) count_q <= '0;
    else if (!full) count_q <= count_q + Width'(cycles);
  end

  assign past_o = count_q >= limit_i;

endmodule

`default_nettype wire
