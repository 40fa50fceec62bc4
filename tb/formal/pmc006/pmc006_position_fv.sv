// SPDX-License-Identifier: Apache-2.0
// pmc006_position_fv: proves that only a step or an instruction changes the position, and that a step changes
// it by one in the direction of the step.
`include "ppmc_fv.svh"
`default_nettype none

module pmc006_position_fv (
    input wire logic        clk_i,
    input wire logic        step_i,
    input wire logic        forward_i,
    input wire logic        set_i,
    input wire logic [31:0] data_i,
    input wire logic        mark_i
);

  logic [31:0] pos_o, stall_o;

  `FV_RESET

  pmc006_position dut (.*);

  `FV_ASSUME(not_both, !(set_i && step_i))

  `FV_ASSERT(p006_mot_05_one_per_step, !$past(rst_ni && step_i) || pos_o == ($past(forward_i) ? $past(pos_o)
             + 32'd1 : $past(pos_o) - 32'd1))
  `FV_ASSERT(stable_without_step, !$past(rst_ni && !step_i && !set_i) || pos_o == $past(pos_o))
  `FV_ASSERT(p006_cmd_19_set, !$past(rst_ni && set_i) || pos_o == $past(data_i))
  `FV_ASSERT(p006_stl_02_marked, !$past(rst_ni) || stall_o == ($past(mark_i) ? $past(pos_o) : $past(stall_o)))
  `FV_COVER(seen_below_zero, pos_o == '1 && $past(pos_o) == '0)
  `FV_COVER(seen_a_stall, stall_o == 32'd2)

endmodule

`default_nettype wire
