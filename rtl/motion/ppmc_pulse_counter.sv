// SPDX-License-Identifier: Apache-2.0
// ppmc_pulse_counter: counts the motor position from the pulse output. CW pulses count up, CCW pulses count
//         down.
// Rules:  operations COUNT and ZERO of the bridge (docs/uart_bridge.md).
// Timing: count_o changes one cycle after pout_ni falls. clear_i has priority over a pulse at the same
//         edge.
`default_nettype none

module ppmc_pulse_counter #(
    parameter int unsigned Width = 32
) (
    input  wire logic             clk_i,
    input  wire logic             rst_ni,
    input  wire logic             clear_i,  // strobe: set the count to 0
    input  wire logic             pout_ni,  // pulse output, synchronous to clk_i
    input  wire logic             dir_i,    // 0: CW, 1: CCW
    output logic      [Width-1:0] count_o   // count, two's complement; wraps
);

  logic pout_nq;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      pout_nq <= 1'b1;
      count_o <= '0;
    end else begin
      pout_nq <= pout_ni;
      if (clear_i) count_o <= '0;
      else if (pout_nq && !pout_ni) count_o <= dir_i ? count_o - 1'b1 : count_o + 1'b1;
    end
  end

endmodule

`default_nettype wire
