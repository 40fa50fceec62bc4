// SPDX-License-Identifier: Apache-2.0
// ppmc_bridge_wait: compares the duration of a wait of a script with its limit.
// Rules:  UB-WAIT-01, op TIMEOUT.
// Timing: the time is held at 0 while waiting_i is low. over_o rises limit .. limit + 1 ms and one cycle
//         after waiting_i; with limit 0, over_o is always high.
`default_nettype none

module ppmc_bridge_wait
  import ppmc_bridge_pkg::*;
(
    input  wire logic        clk_i,
    input  wire logic        ms_i,       // strobe every millisecond
    input  wire logic        start_i,    // a new script: set the default limit
    input  wire logic        set_i,      // set another limit
    input  wire logic [15:0] limit_i,    // new limit, ms
    input  wire logic        waiting_i,  // a wait is in progress
    output logic             over_o      // the limit has been reached
);

  logic [15:0] limit_q, wait_q;
  logic look_once_q, at_limit_q, overdue_q;

  assign over_o = overdue_q || look_once_q;

  always_ff @(posedge clk_i) begin
    if (start_i) limit_q <= DefaultLimitMs;
    else if (set_i) limit_q <= limit_i;
    look_once_q <= limit_q == '0;
    at_limit_q  <= waiting_i && wait_q == limit_q;  // waiting_i excludes a match of the previous wait
    if (!waiting_i) begin
      overdue_q <= 1'b0;
      wait_q    <= '0;
    end else if (ms_i) begin
      overdue_q <= overdue_q || at_limit_q;
      wait_q    <= wait_q + 1'b1;
    end
  end

endmodule

`default_nettype wire
