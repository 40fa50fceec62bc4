// SPDX-License-Identifier: Apache-2.0
// ppmc_bank_pins: pins of one axis of a bank. Executes each order of a visit in the cycle of the order, and
//         suppresses pulses when a switch ends the motion.
// Rules:  BANK-MOT-01/02, BANK-GRP-04, P104-LIM-03..07, P104-TIM-04, P104-END-02/04, P104-PORT-02/03.
// Timing: an order is valid in the cell from the cycle after load_i on. It is executed at the end of the
//         cycle in which clock_i = at_i; halt is executed at the end of the first cycle. A switch acts in the
//         cycle in which it is active on switches_i.
`include "ppmc_assert.svh"
`default_nettype none

module ppmc_bank_pins
  import ppmc_bank_pkg::*;
  import ppmc_motion_pkg::*;
#(
    parameter int unsigned RoundBits = 5,
    parameter bit          PhaseIdle = 1'b1  // level of s_o until the first order
) (
    input wire logic clk_i,
    input wire logic rst_ni,
    input wire logic [RoundBits-1:0] clock_i,  // number of the cycle in the round
    // orders
    input wire logic load_i,  // the order is for this axis
    input wire order_t order_i,  // pin changes
    input wire logic [RoundBits-1:0] at_i,  // cycle of the pin changes
    input wire logic stop_i,  // end every motion
    input wire switches_t switches_i,  // synchronous levels
    // status for the visits
    output logic armed_o,  // pulses may be output
    output logic emitted_o,  // the last ordered pulse has been output
    output logic stopped_o,  // cause of armed_o = 0: STOP or a stop command
    output logic alarm_o,  // cause of armed_o = 0: alarm
    output logic limit_o,  // cause of armed_o = 0: limit of the direction
    // pins
    output logic [5:1] s_o,  // phases
    output logic hold_o,  // at standstill for the hold time
    output logic pout_no,  // pulse, L = active
    output logic dir_o  // 0 = CW
);

  order_t order_q;
  logic [RoundBits-1:0] at_q;
  logic given;  // the order that is loaded has a pulse
  logic now, limit, halt, ends, pulse, rise, set, unused_slow;

  assign unused_slow = switches_i.slow_cw ^ switches_i.slow_ccw;
  assign given = load_i && order_i.pulse;
  assign now = at_q == clock_i;
  assign limit = order_q.ccw ? switches_i.limit_ccw : switches_i.limit_cw;
  assign halt = order_q.halt || stop_i;
  assign ends = halt || limit || switches_i.alarm || (switches_i.origin && order_q.search);
  assign pulse = now && order_q.pulse && armed_o && !ends;
  assign rise = now && order_q.rise;
  assign set = now && order_q.sets;

  // The action of an order (pulse, rise or sets) may still be pending when the next order is loaded. Then it
  // is executed in exactly this cycle.
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      order_q                       <= '0;
      at_q                          <= '0;
      armed_o                       <= 1'b0;
      emitted_o                     <= 1'b1;
      {stopped_o, alarm_o, limit_o} <= '0;
    end else begin
      order_q.halt <= 1'b0;
      if (load_i) {order_q, at_q} <= {order_i, at_i};
      if (set || ends || (pulse && !order_q.arm)) armed_o <= set && order_q.arm;
      if (given || pulse || set) emitted_o <= !given;
      if (armed_o) {stopped_o, alarm_o, limit_o} <= {halt, switches_i.alarm, limit};
    end
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      s_o     <= {5{PhaseIdle}};
      hold_o  <= 1'b1;
      pout_no <= 1'b1;
      dir_o   <= 1'b0;
    end else begin
      if (pulse || rise) pout_no <= order_q.rise;
      if (pulse || set) s_o <= order_q.s;
      if (set) {hold_o, dir_o} <= {order_q.hold, order_q.ccw};
    end
  end

`ifndef SYNTHESIS
  `PPMC_ASSERT(
      bank_one_order,
      !(order_q.pulse && order_q.rise) && !(order_q.pulse && order_q.sets) && !(order_q.rise && order_q.sets))
  `PPMC_ASSERT(bank_mot_02, !(pulse && ends))
  `PPMC_ASSERT(bank_pulse_once, !(pulse && !pout_no))
`endif

endmodule

`default_nettype wire
