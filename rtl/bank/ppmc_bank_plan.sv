// SPDX-License-Identifier: Apache-2.0
// ppmc_bank_plan: decides, in each visit of an axis, whether the byte of the host is accepted, how this byte
//         and the switches affect the motion, which edge the pin block must output, and when the next edge
//         follows.
// Rules:  BANK-HSK-02, BANK-GRP-01/02, BANK-MOT-01..05, BANK-CHP-01, BANK-HLD-01; P104-PRO-04/05,
//         P104-FDC-01..05, P104-TIM-05, P104-LIM-01..09.
// Timing: combinational.
// How:    cycles_left of state_s1_t is the number of cycles from the visit to the awaited edge. The next
//         visit is one round later, so all values that are added to cycles_left are reduced by Round.
`default_nettype none

module ppmc_bank_plan
  import ppmc_bank_pkg::*;
  import ppmc_code_pkg::*;
  import ppmc_motion_pkg::*;
  import ppmc_op_pkg::*;
#(
    parameter int unsigned Quantum  = 25,  // quantum (4 crystal cycles) in clock cycles
    parameter int unsigned Round    = 32,  // time between two visits of an axis (a round) in cycles
    parameter int unsigned TimeBits = 20   // width of interval values, which are numbers of cycles
) (
    // axis
    input wire motion_state_t motion_i,  // state of the motion
    input wire interval_t interval_i,  // timing of the running interval
    input wire init_state_t init_state_i,  // progress of the initialisation
    input wire output_state_t outputs_i,  // phases, chopper, end of the last motion
    input wire logic hold_end_i,  // 1: the hold time ends in this visit
    input wire pin_status_t pin_status_i,  // pin block and switches
    input wire compare_t compare_i,  // comparisons of this visit
    input wire logic builder_free_i,  // 1: the builder of ramp tables is free
    // command unit
    input wire logic extra_time_i,  // 1: extra time (vsel low in CONFIG)
    input wire in_buf_t in_buf_i,  // byte from the host
    input wire logic in_buf_new_i,  // 1: in_buf_i has not been accepted yet
    input wire decoded_t decoded_i,  // in_buf_i.data decoded as a code
    input wire cmd_error_e param_error_i,  // error of an initialisation whose last byte is in_buf_i
    input wire parser_state_t parser_i,  // state of the parser before the byte
    output parser_state_t parser_o,  // state of the parser after the byte
    output logic take_o,  // 1: the byte is accepted
    output logic [7:0] code_o,  // code of the command in decision_o
    output logic [31:0] params_o,  // parameters of code_o
    // decisions
    input wire logic [TimeBits-1:0] after_low_i,  // cycles from end of low time to next pulse, minus Round
    output decision_t decision_o,  // decisions of the visit
    output logic restart_time_o,  // 1: clear cycles_left before add_cycles_o is added
    output logic [TimeBits-1:0] add_cycles_o  // cycles that are added to cycles_left
);

  localparam int unsigned WidthCycles = 20 * Quantum;  // pulse width in cycles
  localparam int unsigned HalfBaseCycles = 4 * Quantum;  // half a period of the fast base clock in cycles

  typedef logic [TimeBits-1:0] cycles_t;

  action_t act;
  logic pulse_missing;  // 1: the last ordered pulse has not been output
  logic abort_motion, cancel_pulse, finish, init_done, go_accept, go_reject, chop_unit, chop_edge;
  logic has_ramp, pulses_done, is_init, last_init_byte, accept_ok, unused_stop, unused_bits;
  logic decelerating, halt, slow_limit, slow_limit_enabled, decel_forced;
  logic fast_no_extra, low_may_grow, pulse, hold_waiting;

  assign unused_bits = &{1'b0, motion_i, init_state_i, outputs_i, pin_status_i, in_buf_i, act};

  // ---- events since the last visit -----------------------------------------------------------------

  always_comb begin
    has_ramp = motion_i.op inside {OP_ACC_DEC, OP_CONT_HIGH};
    pulse_missing = motion_i.pulse_unseen && pin_status_i.pout_n;
    abort_motion = motion_i.busy && !pin_status_i.armed && (motion_i.more_pulses || pulse_missing);
    cancel_pulse = abort_motion && pulse_missing;
    finish = motion_i.busy && (abort_motion ? cancel_pulse || !motion_i.pulse_low
        : !motion_i.more_pulses && !motion_i.pulse_low);
    init_done = init_state_i.building && compare_i.table_idle;
    go_accept = compare_i.go && pin_status_i.in_group
        && motion_i.held && motion_i.more_pulses && !abort_motion;
    go_reject = compare_i.go && pin_status_i.in_group && !go_accept;
    chop_unit = !motion_i.busy && outputs_i.chop && compare_i.edge_in_round && !init_done;
    chop_edge = chop_unit && motion_i.ramp_level == '0;
  end

  // ---- byte ----------------------------------------------------------------------------------------

  assign pulses_done = !motion_i.more_pulses || abort_motion;
  assign is_init = parser_i.code[7:6] == 2'b00;
  assign last_init_byte = is_init && !in_buf_i.is_command && !parser_i.error && parser_i.number == 3'd1;
  assign accept_ok = !finish && !init_state_i.building && !(compare_i.go && pin_status_i.in_group)
      && !chop_edge && (builder_free_i || !last_init_byte);
  assign take_o = in_buf_new_i && accept_ok;
  assign code_o = in_buf_i.is_command ? in_buf_i.data : parser_i.code;
  assign params_o = {in_buf_i.data, parser_i.params[31:8]};

  parser_state_t parser;
  always_comb begin
    parser_o = parser;
    if (go_reject) begin
      parser_o.error  = 1'b1;
      parser_o.number = init_state_i.initialised ? ErrUndefined : ErrNotReady;
      if (motion_i.busy && !finish) parser_o.number = ErrBusy;
    end
  end

  ppmc_command_check #(
      .Aux(1'b0)
  ) u_check (
      .take_i        (take_o),
      .command_i     (in_buf_i.is_command),
      .byte_i        (in_buf_i.data),
      .data_i        (in_buf_i.data),
      .decoded_i,
      .param_error_i (param_error_i),
      .is_checked_i  (is_init),
      .busy_i        (motion_i.busy),
      .ramp_i        (has_ramp),
      .decelerating_i(motion_i.decel_forced || motion_i.decel_natural || pulses_done),
      .initialised_i (init_state_i.initialised),
      .parser_i      (parser_i),
      .parser_o      (parser),
      .act_o         (act),
      .stop_o        (unused_stop)
  );

  // ---- motion --------------------------------------------------------------------------------------

  always_comb begin
    decision_o.abort_motion = abort_motion;
    decision_o.cancel_pulse = cancel_pulse;
    decision_o.finish = finish;
    decision_o.init_done = init_done;
    decision_o.go_accept = go_accept;
    decision_o.go_reject = go_reject;
    decision_o.chop_unit = chop_unit;
    decision_o.chop_edge = chop_edge;
    fast_no_extra = !interval_i.slow_base && !interval_i.extra_time;
    slow_limit = motion_i.ccw ? pin_status_i.switches.slow_ccw : pin_status_i.switches.slow_cw;
    halt = act.halt || (act.decel && !has_ramp);
    decelerating = motion_i.decel_forced || motion_i.decel_natural || pulses_done;
    slow_limit_enabled = has_ramp && !decelerating && !halt && (!motion_i.pout_only || compare_i.ramp_top);
    decision_o.halt = halt;
    decision_o.flag_stop = act.decel && has_ramp && !decelerating;
    decision_o.flag_slow = slow_limit && slow_limit_enabled;
    decel_forced = motion_i.decel_forced || decision_o.flag_stop || decision_o.flag_slow;

    pulse = motion_i.more_pulses && !motion_i.held && !motion_i.pulse_low && !abort_motion
        && compare_i.edge_in_round && !compare_i.rate_mismatch;
    decision_o.pulse = pulse && !halt;
    // While the rate of the interval still changes, the low time may become longer. Therefore the low time
    // does not end before its length is known.
    low_may_grow = compare_i.rate_mismatch && fast_no_extra && !motion_i.last_ordered
        && interval_i.rate inside {8'd0, 8'd1, 8'd2};
    decision_o.pulse_end = motion_i.pulse_low && compare_i.edge_in_round && !low_may_grow && !cancel_pulse;
    decision_o.rate_next = compare_i.rate_mismatch && !decision_o.pulse_end && !cancel_pulse;
    decision_o.level_down = has_ramp && (decel_forced || compare_i.margin_negative);
    decision_o.level_up = has_ramp && !decel_forced && !interval_i.decel
        && !compare_i.margin_negative && !compare_i.margin_zero && !compare_i.ramp_top;
    decision_o.decel_point = has_ramp && !interval_i.decel
        && (decel_forced || compare_i.margin_negative || compare_i.margin_zero);
    decision_o.decel_natural =
        has_ramp && (compare_i.margin_negative || (compare_i.margin_zero && !compare_i.ramp_top));
    decision_o.last_pulse = (decision_o.level_down && compare_i.ramp_bottom)
        || (compare_i.margin_zero && motion_i.ramp_level == '0);

    decision_o.start = act.start;
    decision_o.init = act.init;
    decision_o.first_init = act.init && !init_state_i.initialised;
    decision_o.exc_off = act.exc_off;
    decision_o.switching = act.switching;
    decision_o.read = act.read;
    decision_o.read_select = in_buf_i.data[2:0];
    hold_waiting = !motion_i.busy && !outputs_i.hold && !act.start;
    decision_o.hold_running = hold_waiting && !hold_end_i;
    decision_o.hold_end = hold_waiting && hold_end_i && !chop_edge;
  end

  // ---- cycles to the next edge ---------------------------------------------------------------------

  // Low time of a pulse at a rate, minus Round. If halves = 1 (low times of half an interval are allowed),
  // the low time at the rates 0 to 2 is half of the interval. Otherwise it is the full pulse width.
  function automatic cycles_t low_time(logic [7:0] rate, logic halves);
    unique case ({
      halves && rate[7:2] == '0, rate[1:0]
    })
      3'b100:  return cycles_t'(HalfBaseCycles - Round);
      3'b101:  return cycles_t'(2 * HalfBaseCycles - Round);
      3'b110:  return cycles_t'(3 * HalfBaseCycles - Round);
      default: return cycles_t'(WidthCycles - Round);
    endcase
  endfunction

  // Low time at `rate` + 1, minus the low time at `rate`, minus Round.
  function automatic cycles_t low_time_increase(logic [7:0] rate, logic halves);
    if (!halves || rate[7:2] != '0 || rate[1:0] == 2'd3) return -cycles_t'(Round);
    return (rate[1:0] == 2'd2) ? cycles_t'(WidthCycles - 3 * HalfBaseCycles - Round)
        : cycles_t'(HalfBaseCycles - Round);
  endfunction

  // Duration of a chopper phase without its units, minus Round. on = 1: ON phase, 0: OFF phase; programmed =
  // 1: the host has set the units; extra = 1: vsel is low.
  function automatic cycles_t chop_time(logic on, logic programmed, logic extra);
    unique case ({
      on, programmed, extra
    })
      3'b100, 3'b101: return cycles_t'(ppmc104_pkg::CHOP_ON_DEFAULT * Quantum - Round);
      3'b000, 3'b001: return cycles_t'(ppmc104_pkg::CHOP_OFF_DEFAULT * Quantum - Round);
      3'b110:         return cycles_t'(ppmc104_pkg::CHOP_ON_VSEL_H * Quantum - Round);
      3'b010:         return cycles_t'(ppmc104_pkg::CHOP_OFF_VSEL_H * Quantum - Round);
      3'b111:         return cycles_t'(ppmc104_pkg::CHOP_ON_VSEL_L * Quantum - Round);
      default:        return cycles_t'(ppmc104_pkg::CHOP_OFF_VSEL_L * Quantum - Round);
    endcase
  endfunction

  // The decisions that depend on the byte are timing-critical, so they are applied last. `pulse` is used
  // without the halt of this visit: no edge follows the halt, so cycles_left is not used.
  always_comb begin
    restart_time_o = decision_o.start || go_accept || finish || init_done;
    add_cycles_o   = -cycles_t'(Round);
    if (finish || init_done || chop_edge) begin
      add_cycles_o =
          chop_time(chop_edge ? !outputs_i.phases_on : 1'b1, outputs_i.chop_programmed, extra_time_i);
    end else if (chop_unit) begin
      add_cycles_o = cycles_t'(ppmc104_pkg::CHOP_UNIT * Quantum - Round);
    end else if (decision_o.pulse_end) begin
      add_cycles_o = after_low_i;
    end else if (pulse) begin
      add_cycles_o = low_time(interval_i.rate, fast_no_extra);
    end else if (decision_o.rate_next && interval_i.decel) begin
      if (motion_i.pulse_low)
        add_cycles_o = low_time_increase(interval_i.rate, fast_no_extra && !motion_i.last_ordered);
      else
        add_cycles_o =
            interval_i.slow_base ? cycles_t'(32 * Quantum - Round) : cycles_t'(8 * Quantum - Round);
    end
    if (decision_o.start || go_accept || (pulse && decision_o.last_pulse))
      add_cycles_o = cycles_t'(WidthCycles - Round);
  end

endmodule

`default_nettype wire
