// SPDX-License-Identifier: Apache-2.0
// ppmc_bank_pins_fv: proves that a pulse occurs only in the cycle of its command. Proves that after an
// effective switch, STOP or a halt, no pulse occurs until the axis is armed again.
`include "ppmc_fv.svh"
`default_nettype none

module ppmc_bank_pins_fv
  import ppmc_bank_pkg::*;
  import ppmc_motion_pkg::*;
(
    input wire logic            clk_i,
    input wire pin_cmd_t        pin_cmd_i,
    input wire logic      [2:0] at_cycle_i,
    input wire logic            stop_i,
    input wire switches_t       switches_i
);

  logic [2:0] cycle_i;
  logic load_i, armed_o, stopped_o, alarm_no, limit_o, hold_o, pout_no, dir_o;
  logic [5:1] s_o;

  `FV_RESET

  ppmc_bank_pins #(.RoundBits(3)) dut (.*);

  // An axis is visited once per round.
  assign load_i = cycle_i == '0;
  always_ff @(posedge clk_i) cycle_i <= rst_ni ? cycle_i + 1'b1 : '0;

  logic blocked_q;  // 1: `cause` was high, and the axis has not been armed since then
  logic has_pulse_q;  // 1: the current command has a pulse
  logic [2:0] at_cycle_q;
  logic limit, switch_cause, cause;

  assign limit = dut.pin_cmd_q.ccw ? switches_i.limit_ccw : switches_i.limit_cw;
  assign switch_cause = limit || switches_i.alarm || (switches_i.origin && dut.pin_cmd_q.search);
  assign cause = switch_cause || stop_i || dut.pin_cmd_q.halt;

  always_ff @(posedge clk_i)
    if (!rst_ni) {blocked_q, has_pulse_q, at_cycle_q} <= {1'b1, 4'd0};
    else begin
      blocked_q <= !(dut.set_pins && dut.pin_cmd_q.arm) && (blocked_q || cause);
      if (load_i) {has_pulse_q, at_cycle_q} <= {pin_cmd_i.pulse, at_cycle_i};
    end

  `FV_ASSUME(one_pin_action, 2'(pin_cmd_i.pulse) + 2'(pin_cmd_i.pulse_end) + 2'(pin_cmd_i.set_pins) <= 2'd1)
  // From the start of a motion to its end, dir and hold do not change.
  logic levels_kept_holds;
  assign levels_kept_holds = {pin_cmd_i.ccw, pin_cmd_i.hold} == {dir_o, hold_o} && !dut.set_pins;
  `FV_ASSUME(levels_kept, !(load_i && pin_cmd_i.pulse) || levels_kept_holds)
  `FV_ASSUME(pulses_end_first, !(load_i && pin_cmd_i.pulse) || (pout_no && !dut.pulse) || dut.pulse_end)

  logic pulse_seen_q;  // 1: a pulse has been output
  always_ff @(posedge clk_i) pulse_seen_q <= rst_ni && (pulse_seen_q || !pout_no);

  `FV_ASSERT(bank_mot_02_no_pulse_at_cause, !(pout_no == 1'b0 && $past(rst_ni && pout_no)) || !$past(cause))
  `FV_ASSERT(p104_end_02_no_pulse_after_cause, !(!pout_no && $past(rst_ni && pout_no)) || !$past(blocked_q))
  `FV_ASSERT(bank_mot_01_pulse_in_its_cycle, !(!pout_no && $past(rst_ni && pout_no)) || $past
             (has_pulse_q && cycle_i == at_cycle_q))
  `FV_ASSERT(bank_mot_01_pulse_ends_in_its_cycle, !(pout_no && $past(rst_ni && !pout_no)) || $past
             (dut.pin_cmd_q.pulse_end && cycle_i == at_cycle_q))
  `FV_ASSERT(p104_tim_04_one_edge, !(s_o != $past(s_o) && $past(rst_ni)) || $past(dut.set_pins) || !pout_no)
  `FV_ASSERT(direction_stable, !($past(rst_ni) && dir_o != $past(dir_o)) || $past(dut.set_pins))
  `FV_ASSERT(hold_stable, !($past(rst_ni) && hold_o != $past(hold_o)) || $past(dut.set_pins))
  `FV_ASSERT(p104_end_04_cause, !(!armed_o && $past(rst_ni && armed_o) && limit_o) || $past(limit))
  `FV_COVER(seen_pulse_blocked, armed_o && dut.cycle_hit && dut.pin_cmd_q.pulse && limit && pulse_seen_q)

endmodule

`default_nettype wire
