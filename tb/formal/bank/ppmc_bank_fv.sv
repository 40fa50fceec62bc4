// SPDX-License-Identifier: Apache-2.0
// ppmc_bank_fv: a bank of four axes with any pin commands. Proves that a command reaches only the pins of
// its axis, that an alarm and a limit of the axis end its pulses from the switch pins to the motor pins, that
// each axis reads only its switches, and that int_n is low while any interrupt is pending.
`include "ppmc_fv.svh"
`default_nettype none

module ppmc_bank_fv
  import ppmc_bank_pkg::*;
(
    input wire logic       clk_i,
    input wire logic [9:0] a,
    input wire logic       cs_n,
    input wire logic       rd_n,
    input wire logic       wr_n,
    input wire logic [7:0] d_i,
    input wire logic [3:0] l1_n,
    input wire logic [3:0] l2_n,
    input wire logic [3:0] l3_n,
    input wire logic [3:0] l4_n,
    input wire logic [3:0] cnp_n,
    input wire logic [3:0] alm_n,
    input wire logic [1:0] watched_i  // any axis
);

  logic [7:0] d_o;
  logic d_oe, int_n;
  logic [19:0] s;
  logic [3:0] hold, pout_n, dir;

  `FV_RESET

  ppmc_bank #(
      .AXES  (4),
      .CLK_HZ(8_000_000)
  ) dut (
      .clk  (clk_i),
      .rst_n(rst_ni),
      .*
  );

  `FV_ASSUME(one_axis, watched_i == $past(watched_i))

  pin_cmd_t pin_cmd_q;  // current command of the watched axis
  logic [2:0] at_cycle_q;  // cycle of the round in which pin_cmd_q is executed
  logic [3:0] cycles_q;  // cycles since reset, saturates at 15
  logic pending_q, pout_q, dir_q, hold_q;
  logic [4:0] s_q;
  // cmd_executed_q: pin_cmd_q was executed one cycle ago; had_pulse_q: this command had a pulse
  logic cmd_executed_q, had_pulse_q;
  logic [2:0] alarm_q, cw_q, ccw_q;  // alarm and limits of the watched axis in the last three cycles
  logic switch_acts;  // the alarm or the limit of the direction acts in this cycle
  logic blocked_q, blocked_q2;  // blocked_q: it has acted, and the axis has not been armed since then
  logic irq_known_q;  // 1: a visit has ended, so the pending interrupt is known
  logic ends, visited_q;  // ends: visit of the watched axis in its last stage; visited_q: it has ended

  logic state_known;  // 1: a visit has ended, so the state is known
  logic visited_q2;
  always_ff @(posedge clk_i) visited_q2 <= rst_ni && visited_q;
  assign state_known = visited_q2;

  logic executes;  // the command of the watched axis is executed in this cycle

  assign ends = dut.axis[5] == {1'b0, watched_i} && cycles_q == '1;
  assign executes = visited_q && dut.axis[0] == at_cycle_q;
  assign switch_acts = alarm_q[1] || (pin_cmd_q.ccw ? ccw_q[1] : cw_q[1]);

  // Only a start changes the direction, and it sets the pins.
  logic [3:0] last_ccw;  // direction of the last command of each axis
  logic [3:0] set_pins;  // 1: the axis sets dir, hold and s
  for (genvar i = 0; i < 4; i++) begin : g_ccw
    assign last_ccw[i] = dut.g_axis[i].u_pins.pin_cmd_q.ccw;
    assign set_pins[i] = dut.g_axis[i].u_pins.set_pins;
  end
  `FV_ASSUME(direction_kept,
             !dut.last_stage[watched_i] || dut.pin_cmd.set_pins || dut.pin_cmd.ccw == last_ccw[watched_i])
  // From the start of a motion to its end, dir and hold do not change.
  logic levels_kept_holds;
  assign levels_kept_holds = {dut.pin_cmd.ccw, dut.pin_cmd.hold} == {dir[watched_i], hold[watched_i]}
      && !set_pins[watched_i];
  `FV_ASSUME(levels_kept, !(dut.last_stage[watched_i] && dut.pin_cmd.pulse) || levels_kept_holds)

  always_ff @(posedge clk_i) begin
    {pout_q, dir_q, hold_q, s_q} <= {pout_n[watched_i], dir[watched_i], hold[watched_i], s[5*watched_i+:5]};
    {alarm_q, cw_q} <= {alarm_q[1:0], !alm_n[watched_i], cw_q[1:0], !l1_n[watched_i]};
    ccw_q <= {ccw_q[1:0], !l2_n[watched_i]};
    blocked_q2 <= rst_ni && blocked_q;
    if (!rst_ni) begin
      {pin_cmd_q, at_cycle_q, cycles_q, pending_q} <= '0;
      {irq_known_q, cmd_executed_q, had_pulse_q, visited_q, blocked_q} <= '0;
    end else begin
      cycles_q <= (cycles_q == '1) ? '1 : cycles_q + 1'b1;
      if (ends) {visited_q, pin_cmd_q, at_cycle_q} <= {1'b1, dut.pin_cmd, dut.at_cycle};
      if (ends) {irq_known_q, pending_q} <= {1'b1, dut.irq_pending};
      cmd_executed_q <= executes;
      had_pulse_q <= pin_cmd_q.pulse;
      blocked_q <= state_known && !(executes && pin_cmd_q.set_pins && pin_cmd_q.arm) &&
          (blocked_q || switch_acts);
    end
  end

  // Actions of the executed command of the watched axis.
  logic had_set_pins_q, had_pulse_end_q;
  always_ff @(posedge clk_i) {had_set_pins_q, had_pulse_end_q} <= {pin_cmd_q.set_pins, pin_cmd_q.pulse_end};

  `FV_ASSERT(bank_mot_01_pulse_by_own_cmd,
             !(state_known && pout_q && !pout_n[watched_i]) || (cmd_executed_q && had_pulse_q))
  `FV_ASSERT(bank_mot_01_pulse_end_by_own_cmd,
             !(state_known && !pout_q && pout_n[watched_i]) || (cmd_executed_q && had_pulse_end_q))
  logic bank_mot_01_pins_by_own_cmd_holds;
  assign bank_mot_01_pins_by_own_cmd_holds =
      !state_known || {dir[watched_i], hold[watched_i]} == {dir_q, hold_q} ||
      (cmd_executed_q && had_set_pins_q);
  `FV_ASSERT(bank_mot_01_pins_by_own_cmd, bank_mot_01_pins_by_own_cmd_holds)
  `FV_ASSERT(bank_mot_01_phases_by_own_cmd,
             !state_known || s[5*watched_i+:5] == s_q || (cmd_executed_q && (had_set_pins_q || had_pulse_q)))
  `FV_ASSERT(bank_mot_02_no_pulse_at_own_alarm, !(state_known && pout_q && !pout_n[watched_i]) || !alarm_q[2])
  logic pulse_begins;
  assign pulse_begins = state_known && pout_q && !pout_n[watched_i];
  `FV_ASSERT(bank_mot_02_no_pulse_at_own_limit, !pulse_begins || !(dir[watched_i] ? ccw_q[2] : cw_q[2]))
  `FV_ASSERT(bank_mot_02_no_pulse_after_a_cause, !pulse_begins || !blocked_q2)
  logic bank_mot_05_own_switches_holds;
  assign bank_mot_05_own_switches_holds =
      dut.axis[2] != {1'b0, watched_i} || !state_known || (dut.pin_status.switches.alarm == alarm_q[1] &&
      dut.pin_status.switches.limit_cw == cw_q[1] && dut.pin_status.switches.limit_ccw == ccw_q[1] &&
      dut.pin_status.in_group == dut.mask[watched_i]);
  `FV_ASSERT(bank_mot_05_own_switches, bank_mot_05_own_switches_holds)
  `FV_ASSERT(bank_win_08_map, !irq_known_q || dut.pending_q[watched_i] == pending_q)
  `FV_ASSERT(bank_win_08_pending, !state_known || int_n == $past(dut.pending_q == '0))
  `FV_COVER(seen_blocked, blocked_q2 && dir[watched_i] && executes && pin_cmd_q.pulse)
  `FV_COVER(seen_pulse, state_known && pout_q && !pout_n[watched_i] && pending_q)

endmodule

`default_nettype wire
