// SPDX-License-Identifier: Apache-2.0
// ppmc_bank_pins_fv: proves that pulses occur only in the cycle of their order, and that no pulse occurs at
// or after a cause until the axis is armed again.
`include "ppmc_fv.svh"
`default_nettype none

module ppmc_bank_pins_fv
  import ppmc_bank_pkg::*;
  import ppmc_motion_pkg::*;
(
    input wire logic            clk_i,
    input wire order_t          order_i,
    input wire logic      [2:0] at_i,
    input wire logic            stop_i,
    input wire switches_t       switches_i
);

  logic [2:0] clock_i;
  logic load_i, armed_o, emitted_o, stopped_o, alarm_o, limit_o, hold_o, pout_no, dir_o;
  logic [5:1] s_o;

  `FV_RESET

  ppmc_bank_pins #(.RoundBits(3)) dut (.*);

  // An axis is visited once per round.
  assign load_i = clock_i == '0;
  always_ff @(posedge clk_i) clock_i <= rst_ni ? clock_i + 1'b1 : '0;

  logic killed_q;  // a cause has occurred, and the axis has not been armed since
  logic ordered_q;  // the current order has a pulse
  logic [2:0] at_q;
  logic limit, found, cause;

  assign limit = dut.order_q.ccw ? switches_i.limit_ccw : switches_i.limit_cw;
  assign found = limit || switches_i.alarm || (switches_i.origin && dut.order_q.search);
  assign cause = found || stop_i || dut.order_q.halt;

  always_ff @(posedge clk_i)
    if (!rst_ni) {killed_q, ordered_q, at_q} <= {1'b1, 4'd0};
    else begin
      killed_q <= !(dut.set && dut.order_q.arm) && (killed_q || cause);
      if (load_i) {ordered_q, at_q} <= {order_i.pulse, at_i};
    end

  `FV_ASSUME(one_order, 2'(order_i.pulse) + 2'(order_i.rise) + 2'(order_i.sets) <= 2'd1)
  `FV_ASSUME(pulses_end_first, !(load_i && order_i.pulse) || (pout_no && !dut.pulse) || dut.rise)

  logic again_q;  // a pulse has been output
  always_ff @(posedge clk_i) again_q <= rst_ni && (again_q || !pout_no);

  `FV_ASSERT(bank_mot_02_none_at_a_cause, !(pout_no == 1'b0 && $past(rst_ni && pout_no)) || !$past(cause))
  `FV_ASSERT(p104_end_02_none_behind_a_cause, !(!pout_no && $past(rst_ni && pout_no)) || !$past(killed_q))
  `FV_ASSERT(bank_mot_01_at_its_clk, !(!pout_no && $past(rst_ni && pout_no)) || $past
             (ordered_q && clock_i == at_q))
  `FV_ASSERT(bank_mot_01_rises_as_ordered, !(pout_no && $past(rst_ni && !pout_no)) || $past
             (dut.order_q.rise && clock_i == at_q))
  `FV_ASSERT(p104_tim_04_one_edge, !(s_o != $past(s_o) && $past(rst_ni)) || $past(dut.set) || !pout_no)
  `FV_ASSERT(direction_steady, !($past(rst_ni) && dir_o != $past(dir_o)) || $past(dut.set))
  `FV_ASSERT(p104_end_04_why, !(!armed_o && $past(rst_ni && armed_o) && limit_o) || $past(limit))
  `FV_COVER(seen_pulse_killed, armed_o && dut.now && dut.order_q.pulse && limit && again_q)

endmodule

`default_nettype wire
