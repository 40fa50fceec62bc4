// SPDX-License-Identifier: Apache-2.0
// ppmc312_arbiter_fv: proves that a pending instruction of the host starts after at most one triggered
// instruction, and that no instruction starts without a request.
`include "ppmc_fv.svh"
`default_nettype none

module ppmc312_arbiter_fv
  import ppmc312_pkg::*;
  import ppmc312_link_pkg::*;
  import ppmc312_instr_pkg::*;
(
    input wire logic    clk_i,
    input wire logic    idle_i,
    input wire logic    occupied_i,
    input wire logic    host_i,
    input wire queue_status_t queue_status_i
);

  logic start_o, n_o, missed_o, triggered;
  source_e source_o;

  `FV_RESET

  ppmc312_arbiter dut (.*);

  assign triggered = queue_status_i.fifo_triggered || queue_status_i.events_triggered != '0;

  logic [1:0] triggered_starts_q;  // triggered instructions that started while the host waits
  always_ff @(posedge clk_i)
    if (!rst_ni || !host_i || (start_o && source_o == SrcHost)) triggered_starts_q <= '0;
    else if (start_o && triggered_starts_q != '1) triggered_starts_q <= triggered_starts_q + 1'b1;

  `FV_ASSERT(p312_rsp_20_fair_to_the_host, triggered_starts_q <= 2'd1)
  `FV_ASSERT(only_pending_instructions, !start_o || (source_o == SrcHost ? host_i : triggered))
  `FV_ASSERT(accepts_only_when_idle, !(start_o || missed_o) || idle_i)
  `FV_ASSERT(p312_ovr_10_never_into_an_answer, !(start_o && source_o != SrcHost) || !occupied_i)
  `FV_ASSERT(not_idle_with_work, !(idle_i && !occupied_i && (host_i || triggered)) || start_o)
  `FV_ASSERT(only_triggered_buffer,
             !(start_o && source_o == SrcEvent) || queue_status_i.events_triggered[n_o])
  `FV_COVER(host_after_event, start_o && source_o == SrcHost && triggered && triggered_starts_q == 2'd1)

endmodule

`default_nettype wire
