// SPDX-License-Identifier: Apache-2.0
// ppmc_bank_update_fv: decision and update of a visit, for any state of the axis. Proves that a visit
// issues at most one pin action, that the position changes by one per pulse, that a visit that aborts or
// halts a motion begins no pulse, and that no pulse begins or ends on an axis without a motion.
`include "ppmc_fv.svh"
`default_nettype none

module ppmc_bank_update_fv
  import ppmc_bank_pkg::*;
  import ppmc_code_pkg::*;
  import ppmc_motion_pkg::*;
(
    input wire logic                 clk_i,
    input wire motion_state_t        motion_i,
    input wire interval_t            interval_i,
    input wire init_state_t          init_state_i,
    input wire chop_units_t          chop_units_i,
    input wire logic                 chop_i,
    input wire logic          [ 7:0] slow_i,
    input wire output_state_t        outputs_i,
    input wire logic                 hold_end_i,
    input wire pin_status_t          pin_status_i,
    input wire compare_t             compare_i,
    input wire logic                 builder_free_i,
    input wire logic                 extra_time_i,
    input wire in_buf_t              in_buf_i,
    input wire logic                 in_buf_new_i,
    input wire decoded_t             decoded_i,
    input wire cmd_error_e           param_error_i,
    input wire parser_state_t        parser_i,
    input wire logic          [17:0] after_low_i,
    input wire logic          [16:0] hold_left_i,
    input wire logic          [31:0] position_i
);

  parser_state_t parser_o;
  logic take_o, restart_time_o;
  logic [7:0] code_o;
  logic [31:0] params_o, position_o;
  decision_t decision_o;
  logic [17:0] add_cycles_o;
  motion_state_t motion_o;
  interval_t interval_o;
  init_state_t init_state_o;
  output_state_t outputs_o;
  logic [16:0] hold_left_o;
  pin_cmd_t pin_cmd_o;
  read_data_t read_data_o;

  `FV_RESET

  ppmc_bank_plan #(.TimeBits(18)) u_plan (.*);

  ppmc_bank_update dut (
      .decision_i(decision_o),
      .code_i    (code_o),
      .params_i  (params_o),
      .config_ni (2'b00),
      .read_seq_i(2'd0),
      .*
  );

  // Invariants of the state of a motion.
  `FV_ASSUME(no_pulse_at_standstill, motion_i.busy || !(motion_i.more_pulses || motion_i.pulse_low))
  `FV_ASSUME(no_hold_in_a_motion, !motion_i.busy || !outputs_i.hold)
  `FV_ASSUME(no_motion_during_build, !init_state_i.building || !motion_i.busy)
  `FV_ASSUME(valid_kind, decoded_i.kind <= CmdAuxOff && decoded_i.params <= 3'd4)
  `FV_ASSUME(valid_params,
             decoded_i.params == '0 || decoded_i.kind inside {CmdInit, CmdOperation, CmdSwitching})
  `FV_ASSUME(no_open_params_while_busy, !(motion_i.busy && !parser_i.error && parser_i.number != '0))

  `FV_ASSERT(one_pin_action, 2'(pin_cmd_o.pulse) + 2'(pin_cmd_o.pulse_end) + 2'(pin_cmd_o.set_pins) <= 2'd1)
  `FV_ASSERT(bank_mot_03_position_by_one, position_o - position_i inside {32'd0, 32'd1, 32'hFFFFFFFF})
  `FV_ASSERT(bank_mot_03_position_changes_with_pulses,
             position_o == position_i || pin_cmd_o.pulse || decision_o.cancel_pulse)
  `FV_ASSERT(p104_lim_03_no_pulse_when_aborted, !(pin_cmd_o.pulse && decision_o.abort_motion))
  `FV_ASSERT(p104_stp_03_no_pulse_when_halted, !(pin_cmd_o.pulse && decision_o.halt))
  `FV_ASSERT(
      no_pulse_without_motion,
      !pin_cmd_o.pulse || (motion_i.busy && motion_i.more_pulses && !motion_i.pulse_low && !motion_i.held))
  `FV_ASSERT(no_second_pulse_end, !pin_cmd_o.pulse_end || motion_i.pulse_low)
  `FV_ASSERT(no_pulse_after_the_last, !(pin_cmd_o.pulse && decision_o.last_pulse) || !motion_o.more_pulses)
  `FV_ASSERT(direction_at_the_pins, motion_o.ccw == pin_cmd_o.ccw)
  `FV_ASSERT(direction_changes_with_the_pins,
             motion_o.ccw == motion_i.ccw || (decision_o.start && pin_cmd_o.set_pins))
  `FV_ASSERT(hold_changes_with_the_pins, outputs_o.hold == outputs_i.hold || pin_cmd_o.set_pins)
  `FV_ASSERT(no_hold_in_the_next_visit, !motion_o.busy || !outputs_o.hold)
  `FV_ASSERT(hold_at_a_pulse, !pin_cmd_o.pulse || !pin_cmd_o.hold)
  `FV_ASSERT(no_pins_during_motion, !pin_cmd_o.set_pins || !motion_i.busy)
  `FV_ASSERT(no_start_during_motion, !decision_o.start || !motion_i.busy)
  `FV_ASSERT(valid_for_the_next_visit, motion_o.busy || !(motion_o.more_pulses || motion_o.pulse_low))
  `FV_ASSERT(rate_by_one, decision_o.start || interval_o.rate - interval_i.rate inside {8'd0, 8'd1, 8'hFF})
  `FV_COVER(seen_pulse_and_byte, pin_cmd_o.pulse && take_o)
  `FV_COVER(seen_cancelled_pulse, decision_o.cancel_pulse && position_o == position_i - 1'b1)

endmodule

`default_nettype wire
