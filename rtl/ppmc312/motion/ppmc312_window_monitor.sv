// SPDX-License-Identifier: Apache-2.0
// ppmc312_window_monitor: one of the two position monitors (in-position, encode). Reports whether the
//         position is inside or outside the range.
// Rules:  P312-MON-05, P312-RSP-22, P312-CMD-02/03.
// Timing: pending_o follows inside_i by two cycles.
// Note:   a report is pending while the state (inside, outside) differs from the value in the report that the
//         host has read last. Its value is the other one, even if the state changes again before the load.
`default_nettype none

module ppmc312_window_monitor (
    input  wire logic clk_i,       // clock
    input  wire logic rst_ni,      // reset, asynchronous
    input  wire logic set_i,       // strobe: latch enable_i and repeat_i; restart
    input  wire logic enable_i,    // with set_i; 1: enable, 0: disable the monitor
    input  wire logic repeat_i,    // with set_i; 1: continue, 0: end after one report
    input  wire logic evaluate_i,  // 1: update the state from inside_i
    input  wire logic inside_i,    // 1: the position is within the range
    output logic      enabled_o,   // 1: the monitor is active
    output logic      outside_o,   // 1: active, and the position is outside the range
    output logic      pending_o,   // 1: a report is pending
    output logic      value_o,     // contents of the report; 1: outside the range, 0: inside
    input  wire logic load_i,      // strobe: the report is being loaded
    input  wire logic read_i       // strobe: the report has been read; may coincide with load_i
);

  // reported_q: the value that the host has read last
  logic repeat_q, outside_q, reported_q, loaded_q, disabled_pending_q, restarted_q;

  assign outside_o = enabled_o && outside_q;
  assign value_o   = !reported_q;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      enabled_o <= 1'b0;
      repeat_q <= 1'b0;
      outside_q <= 1'b0;
      reported_q <= 1'b0;
      loaded_q <= 1'b0;
      disabled_pending_q <= 1'b0;
      pending_o <= 1'b0;
      restarted_q <= 1'b0;
    end else begin
      restarted_q <= set_i;  // inside_i is not valid for the new range yet
      loaded_q <= (loaded_q || load_i) && !read_i;
      if (load_i) disabled_pending_q <= 1'b0;
      if (read_i) reported_q <= value_o;
      if (set_i) begin
        enabled_o <= enable_i;
        repeat_q  <= repeat_i;
        outside_q <= 1'b0;
        // A report that is loaded keeps its value until it has been read.
        if (!(loaded_q || load_i) || read_i) reported_q <= 1'b0;
        disabled_pending_q <= 1'b0;
        pending_o <= 1'b0;
      end else begin
        if (enabled_o && evaluate_i && !restarted_q) outside_q <= !inside_i;
        pending_o <= !load_i && !loaded_q && (disabled_pending_q || (enabled_o && outside_q != reported_q));
        if (enabled_o && !repeat_q && outside_q != reported_q && !loaded_q) begin
          enabled_o <= 1'b0;
          disabled_pending_q <= !load_i;
        end
      end
    end
  end

endmodule

`default_nettype wire
