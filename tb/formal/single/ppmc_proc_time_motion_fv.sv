// SPDX-License-Identifier: Apache-2.0
// ppmc_proc_time_motion_fv: proves that no byte is accepted during the end delay of a motion, and that an
// initialisation is completed once.
`include "ppmc_fv.svh"
`default_nettype none

module ppmc_proc_time_motion_fv (
    input wire logic        clk_i,
    input wire logic        init_i,
    input wire logic        start_i,
    input wire logic        triangular_i,
    input wire logic [15:0] number_i,
    input wire logic        ramp_i,
    input wire logic        single_i,
    input wire logic        stop_i,
    input wire logic        pulse_i,
    input wire logic        last_i,
    input wire logic        final_i
);

  logic ready_o, go_o, end_delay_o, closed_o;

  `FV_RESET

  ppmc_proc_time_motion dut (.*);

  `FV_ASSUME(one_at_a_time, $countones({init_i, start_i, stop_i, pulse_i && last_i}) <= 1)
  `FV_ASSUME(closed, !(init_i || start_i) || !closed_o)
  `FV_ASSERT(p104_ds_07_closed, !end_delay_o || closed_o)
  `FV_ASSERT(p104_ds_02_once, !(ready_o && $past(ready_o)) || $past(init_i))
  `FV_COVER(seen_linger, end_delay_o && closed_o)

endmodule

`default_nettype wire
