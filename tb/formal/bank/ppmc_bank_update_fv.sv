// SPDX-License-Identifier: Apache-2.0
// ppmc_bank_update_fv: decision and update of a visit, for any state of its axis. Proves that a visit issues at
// most one order, that the position changes by one per pulse, that a killed or halted motion has no pulse,
// and that an axis without a motion has neither pulse nor rise.
`include "ppmc_fv.svh"
`default_nettype none

module ppmc_bank_update_fv
  import ppmc_bank_pkg::*;
  import ppmc_code_pkg::*;
  import ppmc_motion_pkg::*;
(
    input wire logic            clk_i,
    input wire walk_t           walk_i,
    input wire pace_t           pace_i,
    input wire setting_t        setting_i,
    input wire units_t          units_i,
    input wire logic            chop_i,
    input wire logic     [ 7:0] slow_i,
    input wire rest_t           rest_i,
    input wire logic            over_i,
    input wire seen_t           seen_i,
    input wire facts_t          facts_i,
    input wire logic            free_i,
    input wire logic            extra_i,
    input wire mail_t           mail_i,
    input wire logic            new_i,
    input wire decoded_t        decoded_i,
    input wire error_e          value_i,
    input wire asking_t         asking_i,
    input wire logic     [17:0] due_i,
    input wire logic     [17:0] after_i,
    input wire logic     [16:0] left_i,
    input wire logic     [31:0] position_i
);

  asking_t asking_o;
  logic take_o, anew_o, call_o, calm_o;
  logic [7:0] code_o;
  logic [31:0] params_o, position_o;
  plan_t plan_o;
  logic [17:0] add_o;
  walk_t walk_o;
  pace_t pace_o;
  setting_t setting_o;
  rest_t rest_o;
  logic [16:0] left_o;
  order_t order_o;
  answer_t answer_o;

  `FV_RESET

  ppmc_bank_plan #(.TimeBits(18)) u_plan (.*);

  ppmc_bank_update dut (
      .plan_i    (plan_o),
      .code_i    (code_o),
      .params_i  (params_o),
      .config_ni (2'b00),
      .read_seq_i(2'd0),
      .*
  );

  // Invariants of a motion's state.
  `FV_ASSUME(at_rest_nothing_runs, walk_i.busy || !(walk_i.run || walk_i.low))
  `FV_ASSUME(operations_behind_their_initialisation, !setting_i.building || !walk_i.busy)
  `FV_ASSUME(known_kind, decoded_i.kind <= KindAuxOff && decoded_i.params <= 3'd4)
  `FV_ASSUME(params_fit_the_kind,
             decoded_i.params == '0 || decoded_i.kind inside {KindInit, KindOperation, KindSwitching})
  `FV_ASSUME(parameters_at_rest, !(walk_i.busy && !asking_i.error && asking_i.number != '0))

  `FV_ASSERT(one_order, 2'(order_o.pulse) + 2'(order_o.rise) + 2'(order_o.sets) <= 2'd1)
  `FV_ASSERT(bank_mot_03_position_by_one, position_o - position_i inside {32'd0, 32'd1, 32'hFFFFFFFF})
  `FV_ASSERT(bank_mot_03_position_moves_with_pulses, position_o == position_i || order_o.pulse || plan_o.undo)
  `FV_ASSERT(p104_lim_03_none_when_killed, !(order_o.pulse && plan_o.kill))
  `FV_ASSERT(p104_stp_03_none_when_halted, !(order_o.pulse && plan_o.halt))
  `FV_ASSERT(no_pulse_without_a_motion,
             !order_o.pulse || (walk_i.busy && walk_i.run && !walk_i.low && !walk_i.held))
  `FV_ASSERT(no_order_to_rise_twice, !order_o.rise || walk_i.low)
  `FV_ASSERT(none_behind_the_last, !(order_o.pulse && plan_o.last) || !walk_o.run)
  `FV_ASSERT(no_start_in_a_motion, !plan_o.start || !walk_i.busy)
  `FV_ASSERT(kept_for_the_next_visit, walk_o.busy || !(walk_o.run || walk_o.low))
  `FV_ASSERT(rate_by_one, plan_o.start || pace_o.rate - pace_i.rate inside {8'd0, 8'd1, 8'hFF})
  `FV_COVER(seen_pulse_and_byte, order_o.pulse && take_o)
  `FV_COVER(seen_undo, plan_o.undo && position_o == position_i - 1'b1)

endmodule

`default_nettype wire
