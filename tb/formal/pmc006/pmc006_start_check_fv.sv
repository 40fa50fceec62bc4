// SPDX-License-Identifier: Apache-2.0
// pmc006_start_check_fv: proves which instructions and events start, resume and stop a motion, with a motion
// that ends at any time at which the real one can.
`include "ppmc_fv.svh"
`default_nettype none

module pmc006_start_check_fv
  import pmc006_pkg::*;
(
    input wire logic            clk_i,
    input wire exec_cmd_t       cmd_i,
    input wire logic            legal_i,
    input wire logic            exec_i,
    input wire motor_settings_t settings_i,
    input wire logic            locked_i,
    input wire logic            ext_event_i,
    input wire logic            stall_stop_i,
    input wire logic            key_stop_i,
    input wire logic            end_i          // the motion ends without a stop
);

  logic busy_i, start_o, run_o, halt_o, speed_o, speed_mode_o;

  `FV_RESET

  pmc006_start_check dut (.*);

  logic busy_q, endless_q, speed_q, moves, stops, ends, resumes, free;
  logic limits_q;  // in the last cycle, VSTART and VSTOP were at most VMAX

  assign busy_i = busy_q;

  // A stall stops only a motion in progress. Without a stop, a speed run ends only after N 0, and not in the
  // cycle of N 1.
  `FV_ASSUME(stall_of_a_motion, !stall_stop_i || busy_q)
  `FV_ASSUME(run_ends_after_stop, !end_i || !(endless_q && speed_o))

  assign moves = exec_i && legal_i && !busy_q && !settings_i.free && !locked_i && !ext_event_i && !key_stop_i;
  assign free = exec_i && legal_i && cmd_i.op == I_FREE && cmd_i.data[0];
  assign stops = ext_event_i || stall_stop_i || key_stop_i || free || (exec_i && cmd_i.op == I_ABORT);
  // verilog_format: off
  assign resumes = exec_i && legal_i && cmd_i.op == I_RUN && cmd_i.data[0] && busy_q && endless_q
      && !ext_event_i && !key_stop_i;
  // verilog_format: on
  assign ends = exec_i && legal_i && cmd_i.op == I_RUN && !cmd_i.data[0];

  // speed_q: register SPEED_MODE
  always_ff @(posedge clk_i)
    limits_q <= 14'(settings_i.vstart) <= settings_i.vmax && 14'(settings_i.vstop) <= settings_i.vmax;

  always_ff @(posedge clk_i)
    if (!rst_ni) {busy_q, speed_q} <= '0;
    else begin
      busy_q  <= start_o || run_o || (busy_q && !halt_o && !end_i);
      speed_q <= !stops && !ends && (run_o || resumes || speed_q);
      if (start_o || run_o) endless_q <= run_o;
    end

  `FV_ASSERT(p006_sta_01_step, start_o == (moves && cmd_i.op == I_STEP && limits_q))
  `FV_ASSERT(p006_sta_02_run, run_o == (moves && cmd_i.op == I_RUN && cmd_i.data[0] && settings_i.vmax != '0))
  `FV_ASSERT(p006_sta_10_halt, halt_o == stops)
  `FV_ASSERT(p006_sta_14_one, $countones({start_o, run_o, halt_o}) <= 1)
  `FV_ASSERT(speed_mode, speed_mode_o == speed_q)
  `FV_ASSERT(p006_sta_16_of_a_run, !speed_mode_o || (busy_q && endless_q))
  `FV_ASSERT(p006_mot_42_resume, speed_o == (speed_q || resumes))
  `FV_COVER(seen_resume, resumes && !speed_q && $past(speed_q && rst_ni))
  `FV_COVER(seen_end, !busy_q && $past(busy_q && endless_q && !halt_o))

endmodule

`default_nettype wire
