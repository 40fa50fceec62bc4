// SPDX-License-Identifier: Apache-2.0
// ppmc_bank_fv: a bank of four axes with any orders. Proves that each order reaches only the pins of its own
// axis, that each axis reads its own switches, and that int_n is low while any interrupt is pending.
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

  order_t order_q;  // current order of the watched axis
  logic [2:0] at_q;  // cycle of the round in which order_q acts
  logic [3:0] clk_q;  // cycles since reset, at most 15
  logic pending_q, pout_q, dir_q, hold_q;
  logic [4:0] s_q;
  logic now_q, ordered_q;  // now_q: order_q acted in the cycle before; ordered_q: it had a pulse
  logic [2:0] alarm_q, cw_q;  // alarm and CW limit of the watched axis in the last three cycles
  logic told_q;  // an interrupt has begun or ended
  logic ends, known_q;  // ends: a visit of the watched axis is in its last stage; known_q: one has ended

  assign ends = dut.axis[5] == {1'b0, watched_i} && clk_q == '1;

  always_ff @(posedge clk_i) begin
    {pout_q, dir_q, hold_q, s_q} <= {pout_n[watched_i], dir[watched_i], hold[watched_i], s[5*watched_i+:5]};
    {alarm_q, cw_q} <= {alarm_q[1:0], !alm_n[watched_i], cw_q[1:0], !l1_n[watched_i]};
    if (!rst_ni) {order_q, at_q, clk_q, pending_q, told_q, now_q, ordered_q, known_q} <= '0;
    else begin
      clk_q <= (clk_q == '1) ? '1 : clk_q + 1'b1;
      if (ends) {known_q, order_q, at_q} <= {1'b1, dut.order, dut.at};
      if (ends && (dut.call || dut.calm)) {told_q, pending_q} <= {1'b1, dut.call};
      now_q     <= known_q && dut.axis[0] == at_q;
      ordered_q <= order_q.pulse;
    end
  end

  logic steady;  // 1: a visit with an order has ended; before, the state is unknown
  logic known2_q;
  always_ff @(posedge clk_i) known2_q <= rst_ni && known_q;
  assign steady = known2_q;

  // Orders and pins of the watched axis.
  logic sets_q, rises_q;
  always_ff @(posedge clk_i) {sets_q, rises_q} <= {order_q.sets, order_q.rise};

  `FV_ASSERT(bank_mot_01_pulse_by_its_own_order,
             !(steady && pout_q && !pout_n[watched_i]) || (now_q && ordered_q))
  `FV_ASSERT(bank_mot_01_ends_by_its_own_order,
             !(steady && !pout_q && pout_n[watched_i]) || (now_q && rises_q))
  `FV_ASSERT(bank_mot_01_pins_by_its_own_order,
             !steady || {dir[watched_i], hold[watched_i]} == {dir_q, hold_q} || (now_q && sets_q))
  `FV_ASSERT(bank_mot_01_phases_by_its_own_order,
             !steady || s[5*watched_i+:5] == s_q || (now_q && (sets_q || ordered_q)))
  `FV_ASSERT(bank_mot_02_none_at_its_own_alarm, !(steady && pout_q && !pout_n[watched_i]) || !alarm_q[2])
  logic bank_mot_05_its_own_switches_holds;
  assign bank_mot_05_its_own_switches_holds =
      dut.axis[2] != {1'b0, watched_i} || !steady || (dut.seen.switches.alarm == alarm_q[1] &&
      dut.seen.switches.limit_cw == cw_q[1] && dut.seen.mask == dut.mask[watched_i]);
  `FV_ASSERT(bank_mot_05_its_own_switches, bank_mot_05_its_own_switches_holds)
  `FV_ASSERT(bank_win_08_map, !told_q || dut.pending_q[watched_i] == pending_q)
  `FV_ASSERT(bank_win_08_pending, !steady || int_n == $past(dut.pending_q == '0))
  `FV_COVER(seen_pulse, steady && pout_q && !pout_n[watched_i] && pending_q)

endmodule

`default_nettype wire
