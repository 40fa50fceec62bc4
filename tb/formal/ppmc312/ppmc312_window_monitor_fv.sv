// SPDX-License-Identifier: Apache-2.0
// ppmc312_window_monitor_fv: compares the reports of a monitor with the value that the host has read last.
`include "ppmc_fv.svh"
`default_nettype none

module ppmc312_window_monitor_fv (
    input wire logic clk_i,
    input wire logic set_i,
    input wire logic enable_i,
    input wire logic repeat_i,
    input wire logic evaluate_i,
    input wire logic inside_i,
    input wire logic load_i,
    input wire logic read_i
);

  logic enabled_o, outside_o, pending_o, value_o;

  `FV_RESET

  ppmc312_window_monitor dut (.*);

  // State of the rules. reads_q: the report with contents read_value_q is loaded, and has not been read.
  // once_q: without repetition, the report has been created, and is not withdrawn.
  logic on_q, repeat_q, outside_q, last_q, reads_q, read_value_q, once_q, set_q, differs, waits;

  `FV_ASSUME(loads_a_report, !load_i || (pending_o && !reads_q))
  `FV_ASSUME(reads_a_loaded_report, !read_i || reads_q || load_i)

  assign differs = on_q && outside_q != last_q;

  always_ff @(posedge clk_i)
    if (!rst_ni) {on_q, repeat_q, outside_q, last_q, reads_q, read_value_q, once_q, set_q, waits} <= '0;
    else begin
      set_q <= set_i;
      // A report waits in the next cycle if the value differs from the value that was read last.
      waits <= !set_i && !load_i && !reads_q && (once_q || differs);
      if (load_i) read_value_q <= value_o;
      reads_q <= (reads_q || load_i) && !read_i;
      if (read_i) last_q <= load_i ? value_o : read_value_q;
      if (load_i) once_q <= 1'b0;
      if (set_i) begin
        {on_q, repeat_q} <= {enable_i, repeat_i};
        {outside_q, last_q, once_q} <= '0;
      end else begin
        if (on_q && evaluate_i && !set_q) outside_q <= !inside_i;
        if (differs && !repeat_q && !reads_q) begin
          on_q   <= 1'b0;
          once_q <= !load_i;
        end
      end
    end

  `FV_ASSERT(p312_rsp_22_waits, pending_o == waits)
  `FV_ASSERT(p312_mon_05_enabled, enabled_o == on_q)
  `FV_ASSERT(p312_mon_05_outside, outside_o == (on_q && outside_q))
  `FV_ASSERT(p312_rsp_22_contents, !load_i || value_o != last_q)
  `FV_COVER(seen_second_report, load_i && last_q)
  `FV_COVER(seen_withdrawn, $past(rst_ni && pending_o && !load_i && !set_i) && !pending_o && on_q)

endmodule

`default_nettype wire
