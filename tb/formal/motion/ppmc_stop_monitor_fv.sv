// SPDX-License-Identifier: Apache-2.0
// ppmc_stop_monitor_fv: proves that every cause of an immediate end ends the motion in the same cycle, that
// no other event ends it immediately, and that the causes are recorded.
`include "ppmc_fv.svh"
`default_nettype none

module ppmc_stop_monitor_fv
  import ppmc_motion_pkg::*;
(
    input wire logic      clk_i,
    input wire logic      clear_i,
    input wire logic      complete_i,
    input wire logic      armed_i,
    input wire op_t       op_i,
    input wire switches_t switches_i,
    input wire logic      top_i,
    input wire logic      at_start_rate_i,
    input wire logic      dec_i,
    input wire logic      halt_i,
    input wire logic      decel_i,
    input wire logic      slow_i
);

  logic slow_seen_o, stop_o, forced_o, flagged_o;
  logic stmc_seen, stmc_stop, stmc_forced, stmc_flagged;
  stop_cause_t cause_o, stmc_cause;

  `FV_RESET

  ppmc_stop_monitor dut (.*);

  ppmc_stop_monitor #(
      .StopAtSlow(1'b1),
      .SlowOrigin(1'b1)
  ) u_stmc (
      .slow_seen_o(stmc_seen),
      .stop_o     (stmc_stop),
      .forced_o   (stmc_forced),
      .flagged_o  (stmc_flagged),
      .cause_o    (stmc_cause),
      .*
  );

  logic limit, slow, found, immediate;
  assign limit = op_i.ccw ? switches_i.limit_ccw : switches_i.limit_cw;
  assign slow = op_i.ccw ? switches_i.slow_ccw : switches_i.slow_cw;
  assign found = limit || switches_i.alarm || (op_i.origin && switches_i.origin);
  assign immediate = found || halt_i || (decel_i && !op_i.ramp);

  `FV_ASSERT(p104_lim_03_every_cause, !(armed_i && immediate) || (stop_o && stmc_stop))
  `FV_ASSERT(p104_end_05_only_causes, !stop_o || (armed_i && immediate))
  logic only_causes;
  assign only_causes = immediate || (op_i.origin && slow) || (at_start_rate_i && (slow_i || decel_i));
  `FV_ASSERT(stmc_in_03_only_causes, !stmc_stop || (armed_i && only_causes))
  `FV_ASSERT(p104_fdc_01_asked_for,
             !(armed_i && op_i.ramp && !immediate && !dec_i && (decel_i || slow_i)) || forced_o)
  `FV_ASSERT(p104_fdc_04_not_withdrawn, !$past(rst_ni && forced_o && !stop_o && !clear_i && !complete_i)
             || forced_o)
  `FV_ASSERT(p104_end_04_limit_told, !$past(rst_ni && stop_o && limit && !clear_i && !complete_i)
             || cause_o.limit)
  `FV_ASSERT(p104_end_04_alarm_told, !$past(rst_ni && stop_o && switches_i.alarm && !clear_i && !complete_i)
             || cause_o.alarm)
  `FV_ASSERT(p104_stp_03_command_told, !$past(rst_ni && armed_i && halt_i && !clear_i && !complete_i)
             || cause_o.stop)
  `FV_ASSERT(p104_end_04_no_cause_left, !$past(clear_i || complete_i) || cause_o == '0)
  `FV_COVER(seen_limit_while_slowing, stop_o && flagged_o && limit && $past(cause_o.slow))

endmodule

`default_nettype wire
