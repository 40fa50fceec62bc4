// SPDX-License-Identifier: Apache-2.0
// ppmc_bank_pins: pins of one axis of a bank. Executes, in the requested cycle, the command that the engine
//         loads in a visit. Outputs no pulse after a switch, STOP or a halt has ended the motion.
// Rules:  BANK-MOT-01/02, BANK-GRP-04, P104-LIM-03..07, P104-TIM-04, P104-END-02/04, P104-PORT-02/03.
// Timing: a command is valid in pin_cmd_q from the cycle after load_i on. It is executed at the end of the
//         cycle in which cycle_i = at_cycle_q. The field halt does not wait for this cycle. It takes effect
//         at the end of the first cycle in which it is valid, and remains effective until the next command.
//         A switch acts in the cycle in which it is active on switches_i.
// Assumes: a command with a pulse has the levels of hold_o and dir_o, because only a start and the hold time
//         change them.
`include "ppmc_assert.svh"
`default_nettype none

module ppmc_bank_pins
  import ppmc_bank_pkg::*;
  import ppmc_motion_pkg::*;
#(
    parameter int unsigned RoundBits = 5,
    parameter bit          PhaseIdle = 1'b1  // level of s_o before the first command
) (
    input wire logic clk_i,
    input wire logic rst_ni,
    input wire logic [RoundBits-1:0] cycle_i,  // number of the cycle in the round
    // command
    input wire logic load_i,  // strobe: pin_cmd_i is for this axis
    input wire pin_cmd_t pin_cmd_i,  // immediate halt, and pin changes of the next round
    input wire logic [RoundBits-1:0] at_cycle_i,  // cycle of the pin changes
    input wire logic stop_i,  // 1: STOP, end a running motion
    input wire switches_t switches_i,  // switches, synchronised
    // status for the visits
    output logic armed_o,  // 1: pulses may be output
    output logic stopped_o,  // armed_o = 0 because of STOP or a stop command
    output logic alarm_no,  // 0: armed_o = 0 because of an alarm
    output logic limit_o,  // armed_o = 0 because of the limit in the direction of motion
    // pins
    output logic [5:1] s_o,  // phases
    output logic hold_o,  // high: at standstill for at least the hold time
    output logic pout_no,  // pulse, active low
    output logic dir_o  // 0: CW, 1: CCW
);

  pin_cmd_t pin_cmd_q;
  logic [RoundBits-1:0] at_cycle_q;
  // cycle_hit: the command is executed in this cycle; end_motion: a switch, STOP or a halt ends the motion in
  // this cycle
  logic cycle_hit, limit, halt, end_motion, pulse, pulse_end, set_pins, unused_slow;

  assign unused_slow = switches_i.slow_cw ^ switches_i.slow_ccw;
  assign cycle_hit = at_cycle_q == cycle_i;
  assign limit = pin_cmd_q.ccw ? switches_i.limit_ccw : switches_i.limit_cw;
  assign halt = pin_cmd_q.halt || stop_i;
  assign end_motion = halt || limit || switches_i.alarm || (switches_i.origin && pin_cmd_q.search);
  assign pulse = cycle_hit && pin_cmd_q.pulse && armed_o && !end_motion;
  assign pulse_end = cycle_hit && pin_cmd_q.pulse_end;
  assign set_pins = cycle_hit && pin_cmd_q.set_pins;

  // When the engine loads the next command, the action of the current command (pulse, pulse_end or set_pins)
  // may still be pending. In this case, the action is executed in exactly the cycle of load_i.
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      pin_cmd_q                      <= '0;
      at_cycle_q                     <= '0;
      armed_o                        <= 1'b0;
      {stopped_o, alarm_no, limit_o} <= 3'b010;
    end else begin
      if (load_i) {pin_cmd_q, at_cycle_q} <= {pin_cmd_i, at_cycle_i};
      armed_o <= (pulse || set_pins) ? pin_cmd_q.arm : armed_o && !end_motion;
      if (armed_o) {stopped_o, alarm_no, limit_o} <= {halt, !switches_i.alarm, limit};
    end
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      s_o     <= {5{PhaseIdle}};
      hold_o  <= 1'b1;
      pout_no <= 1'b1;
      dir_o   <= 1'b0;
    end else begin
      if (pulse || pulse_end) pout_no <= pin_cmd_q.pulse_end;
      if (pulse || set_pins) {s_o, hold_o, dir_o} <= {pin_cmd_q.s, pin_cmd_q.hold, pin_cmd_q.ccw};
    end
  end

`ifndef SYNTHESIS
  logic one_pin_action;
  assign one_pin_action = !(pin_cmd_q.pulse && pin_cmd_q.pulse_end)
      && !(pin_cmd_q.pulse && pin_cmd_q.set_pins) && !(pin_cmd_q.pulse_end && pin_cmd_q.set_pins);
  `PPMC_ASSERT(bank_one_pin_action, one_pin_action)
  `PPMC_ASSERT(bank_mot_02, !(pulse && end_motion))
  `PPMC_ASSERT(bank_pulse_once, !(pulse && !pout_no))
`endif

endmodule

`default_nettype wire
