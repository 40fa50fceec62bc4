// SPDX-License-Identifier: Apache-2.0
// ppmc_hold_timer: tells that the motor has been at rest for the hold time.
// Rules:  P104-END-08, P104-DS-09.
// Timing: hold_o falls one clk after busy_i rises and rises one clk after quantum tick number Quanta since
//         busy_i fell.
`default_nettype none

module ppmc_hold_timer #(
    parameter int unsigned Quanta = 136_000  // hold time in quantum ticks; 34 ms at 16 MHz
) (
    input  wire logic clk_i,
    input  wire logic rst_ni,
    input  wire logic busy_i,
    input  wire logic quantum_i,  // restarted by the fall of busy_i
    output logic      hold_o      // 1 after reset
);

  localparam int unsigned Width = ppmc_pkg::cnt_width(Quanta);

  logic [Width-1:0] count_q;
  logic done;

  // Counted from 0 upwards, Quanta is the first value with all of its ones set.
  assign done = (count_q & Width'(Quanta)) == Width'(Quanta);

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) hold_o <= 1'b1;
    else if (busy_i || done) hold_o <= !busy_i;
  end

  // No reset: every motion clears it, and before the first one it does not count.
  always_ff @(posedge clk_i) begin
    if (busy_i) count_q <= '0;
    else if (quantum_i && !hold_o) count_q <= count_q + 1'b1;
  end

endmodule

`default_nettype wire
