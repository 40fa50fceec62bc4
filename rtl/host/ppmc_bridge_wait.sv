// SPDX-License-Identifier: Apache-2.0
// ppmc_bridge_wait: compares the duration of a wait in a script with its time limit.
// Rules:  UB-WAIT-01, op TIMEOUT.
// Timing: while waiting_i is low, the time is 0. After waiting_i rises, timeout_o rises within limit .. limit
//         + 1 ms, plus one cycle. With a limit of 0, timeout_o is always high.
`default_nettype none

module ppmc_bridge_wait
  import ppmc_bridge_pkg::*;
(
    input  wire logic        clk_i,
    input  wire logic        ms_i,       // strobe every millisecond
    input  wire logic        start_i,    // strobe: a new script; set the default limit
    input  wire logic        set_i,      // strobe: set the limit to limit_i
    input  wire logic [15:0] limit_i,    // new limit in ms
    input  wire logic        waiting_i,  // 1: a wait is in progress
    output logic             timeout_o   // 1: the limit has been reached
);

  logic [15:0] limit_q, wait_q;
  logic limit_zero_q, at_limit_q, expired_q;

  assign timeout_o = expired_q || limit_zero_q;

  always_ff @(posedge clk_i) begin
    if (start_i) limit_q <= DEFAULT_LIMIT_MS;
    else if (set_i) limit_q <= limit_i;
    limit_zero_q <= limit_q == '0;
    // In the first cycle in which waiting_i is low, wait_q still contains the time of the previous wait.
    // Therefore waiting_i is part of the condition.
    at_limit_q   <= waiting_i && wait_q == limit_q;
    if (!waiting_i) begin
      expired_q <= 1'b0;
      wait_q    <= '0;
    end else if (ms_i) begin
      expired_q <= expired_q || at_limit_q;
      wait_q    <= wait_q + 1'b1;
    end
  end

endmodule

`default_nettype wire
