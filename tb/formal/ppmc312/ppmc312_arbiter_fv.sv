// SPDX-License-Identifier: Apache-2.0
// ppmc312_arbiter_fv: proves that a waiting host is served after at most one triggered instruction, and that
// no instruction starts without a request.
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
    input wire stored_t stored_i
);

  logic start_o, n_o, lost_o, triggered;
  source_e source_o;

  `FV_RESET

  ppmc312_arbiter dut (.*);

  assign triggered = stored_i.due || stored_i.events != '0;

  logic [1:0] passed_q;  // instructions begun while the host was waiting
  always_ff @(posedge clk_i)
    if (!rst_ni || !host_i || (start_o && source_o == SrcHost)) passed_q <= '0;
    else if (start_o && passed_q != '1) passed_q <= passed_q + 1'b1;

  `FV_ASSERT(p312_rsp_20_fair_to_the_host, passed_q <= 2'd1)
  `FV_ASSERT(only_what_waits, !start_o || (source_o == SrcHost ? host_i : triggered))
  `FV_ASSERT(idle_alone, !(start_o || lost_o) || idle_i)
  `FV_ASSERT(p312_ovr_10_never_into_an_answer, !(start_o && source_o != SrcHost) || !occupied_i)
  `FV_ASSERT(never_rests_with_work, !(idle_i && !occupied_i && (host_i || triggered)) || start_o)
  `FV_ASSERT(buffer_that_waits, !(start_o && source_o == SrcEvent) || stored_i.events[n_o])
  `FV_COVER(seen_host_behind_event, start_o && source_o == SrcHost && triggered && passed_q == 2'd1)

endmodule

`default_nettype wire
