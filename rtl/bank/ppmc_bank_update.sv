// SPDX-License-Identifier: Apache-2.0
// ppmc_bank_update: executes the decisions of a visit. Computes the next state of the axis, the command to
//         the pin block, and the response to the host.
// Rules:  P104-PRO-01..04, P104-OPR-01..05, P104-END-01..07, P104-RD-02..07, P104-INI-05..08, P104-AUX-03/04,
//         P104-PHS-01..06, P104-SW-02..05; BANK-WIN-07, BANK-MOT-01..04.
// Timing: combinational.
`default_nettype none

module ppmc_bank_update
  import ppmc_bank_pkg::*;
  import ppmc_code_pkg::*;
  import ppmc_motion_pkg::*;
  import ppmc_op_pkg::*;
#(
    parameter int unsigned HoldRounds = 106_250,  // rounds from the end of a motion to HOLD
    parameter int unsigned HoldBits = 17  // bits of hold_left_i
) (
    input wire decision_t decision_i,  // decisions of the visit
    input wire pin_status_t pin_status_i,  // pin block and switches
    input wire logic [7:0] code_i,  // code of the command
    input wire logic [31:0] params_i,  // parameters of code_i
    input wire logic [1:0] config_ni,  // vsel and csel, inverted
    input wire logic [1:0] read_seq_i,  // seq of the response that the host has read last
    // state before the visit
    input wire motion_state_t motion_i,  // state of the motion
    input wire interval_t interval_i,  // interval of the motion
    input wire init_state_t init_state_i,  // progress of the initialisation
    input wire chop_units_t chop_units_i,  // units of the chopper phases
    input wire logic chop_i,  // 1: chop at standstill, as set by the initialisation
    input wire logic [7:0] slow_i,  // start-up rate
    input wire output_state_t outputs_i,  // phases, chopper, end of the last motion
    input wire logic [HoldBits-1:0] hold_left_i,  // remaining rounds of the hold time, minus 1
    input wire logic [31:0] position_i,  // CW pulses minus CCW pulses
    // state after the visit
    output motion_state_t motion_o,  // state of the motion
    output interval_t interval_o,  // interval of the motion
    output init_state_t init_state_o,  // progress of the initialisation
    output output_state_t outputs_o,  // phases, chopper, end of the last motion
    output logic [HoldBits-1:0] hold_left_o,  // remaining rounds of the hold time, minus 1
    output logic [31:0] position_o,  // CW pulses minus CCW pulses
    // outputs
    output pin_cmd_t pin_cmd_o,  // command to the pin block
    output read_data_t read_data_o  // response to a read command; valid with decision_i.read
);

  op_code_t   code;
  init_code_t init;  // code_i as an initialisation code
  logic has_ramp, unused_bits;

  assign unused_bits = &{1'b0, decision_i, pin_status_i, code, init};
  assign code = op_code_t'(code_i);
  assign init = init_code_t'(code_i);
  assign has_ramp = code.op inside {OP_ACC_DEC, OP_CONT_HIGH};

  // ---- motion --------------------------------------------------------------------------------------

  logic [24:0] margin_add;
  logic [24:0] decel_margin;  // with finish: remaining pulses minus 1
  logic count_down;  // decrement ramp_level
  logic position_changes;  // a pulse is counted or cancelled
  logic ccw;  // direction of the counted or cancelled pulse

  assign ccw    = motion_i.ccw ^ decision_i.cancel_pulse;
  assign position_changes = decision_i.pulse || decision_i.cancel_pulse;

  always_comb begin
    margin_add = '0;
    if (decision_i.finish) margin_add = {{10{motion_i.ramp_level[14]}}, motion_i.ramp_level};
    else if (decision_i.pulse && !decision_i.level_down) margin_add = decision_i.level_up ? -25'd2 : -25'd1;
    decel_margin = motion_i.decel_margin + margin_add + 25'(decision_i.cancel_pulse);

    count_down = decision_i.chop_unit || (decision_i.pulse && decision_i.level_down);
    motion_o = motion_i;
    motion_o.decel_margin = decel_margin;
    motion_o.ramp_level = motion_i.ramp_level
        + {{14{count_down}}, count_down || (decision_i.pulse && decision_i.level_up)};
    motion_o.decel_forced = motion_i.decel_forced || decision_i.flag_stop || decision_i.flag_slow;
    motion_o.flag_stop = motion_i.flag_stop || decision_i.flag_stop;
    motion_o.flag_slow = motion_i.flag_slow || decision_i.flag_slow;
    motion_o.pulse_unseen = decision_i.pulse || (motion_i.pulse_unseen && pin_status_i.pout_n);
    if (decision_i.go_accept) motion_o.held = 1'b0;
    if (decision_i.pulse_end || decision_i.cancel_pulse) motion_o.pulse_low = 1'b0;
    if (decision_i.abort_motion) motion_o.more_pulses = 1'b0;
    if (decision_i.pulse) begin
      motion_o.pulse_low     = 1'b1;
      motion_o.more_pulses   = !decision_i.last_pulse;
      motion_o.last_ordered  = decision_i.last_pulse;
      motion_o.decel_natural = motion_i.decel_natural || decision_i.decel_natural;
    end
    if (decision_i.finish) begin
      motion_o.busy = 1'b0;
      motion_o.more_pulses = 1'b0;
      if (decel_margin[24]) motion_o.decel_margin = '0;
    end
    if (decision_i.finish || decision_i.init_done)
      motion_o.ramp_level = {7'd0, outputs_i.chop_programmed ? chop_units_i.on : 8'd0};
    if (decision_i.chop_edge) begin
      motion_o.ramp_level = '0;
      if (outputs_i.chop_programmed)
        motion_o.ramp_level[7:0] = outputs_i.phases_on ? chop_units_i.off : chop_units_i.on;
    end
    if (decision_i.start) begin
      motion_o = '{
          busy: 1'b1,
          more_pulses: 1'b1,
          held: pin_status_i.in_group,
          op: code.op,
          pout_only: code.pout_only,
          ccw: code.ccw,
          silent: code.silent,
          decel_margin: 25'h0FFFFFF,
          default: '0
      };
      if (code.op inside {OP_ACC_DEC, OP_CONSTANT}) motion_o.decel_margin = {1'b0, params_i[31:8]};
      if (code.op == OP_SINGLE) motion_o.decel_margin = '0;
    end

    interval_o = interval_i;
    interval_o.rate += {{7{decision_i.rate_next && !interval_i.decel}}, decision_i.rate_next};
    if (decision_i.pulse && decision_i.decel_point) interval_o.decel = 1'b1;
    if (decision_i.start) begin
      interval_o = '{slow_base: config_ni[0], extra_time: config_ni[1], decel: 1'b0, rate: slow_i};
      if (!has_ramp) interval_o.rate = (code.op == OP_CONSTANT) ? params_i[7:0] : params_i[31:24];
    end

    position_o = position_i + {{31{ccw && position_changes}}, position_changes};
  end

  // ---- set-up, phases, standstill ------------------------------------------------------------------

  motor_e motor;

  assign motor = motor_e'(outputs_i.motor);

  always_comb begin
    init_state_o = init_state_i;
    if (decision_i.init) init_state_o.building = 1'b1;
    if (decision_i.init_done) init_state_o = '{initialised: 1'b1, building: 1'b0};
    if (decision_i.exc_off) init_state_o.initialised = 1'b0;

    outputs_o = outputs_i;
    if (position_changes && !motion_i.pout_only) begin
      outputs_o.pattern = next_phases(outputs_i.pattern, outputs_i.two_phases, outputs_i.half, motor, ccw);
      outputs_o.two_phases    = outputs_i.two_phases ^ outputs_i.half;
    end
    if (decision_i.first_init) begin
      outputs_o.motor    = init.motor;
      outputs_o.half     = init.half;
      outputs_o.positive = init.positive;
    end
    if (decision_i.first_init || decision_i.exc_off) begin
      outputs_o.pattern = {3'b000, {2{decision_i.first_init}}};
      outputs_o.two_phases    = 1'b1;
    end
    if (decision_i.init_done) outputs_o.chop = chop_i;
    if (decision_i.exc_off) outputs_o.chop = 1'b0;
    if (decision_i.chop_edge) outputs_o.phases_on = !outputs_i.phases_on;
    if (decision_i.init_done || decision_i.start || decision_i.exc_off || decision_i.finish)
      outputs_o.phases_on = 1'b1;
    if (decision_i.switching) outputs_o.chop_programmed = 1'b1;
    if (decision_i.hold_end) outputs_o.hold = 1'b1;
    if (decision_i.start) outputs_o.hold = 1'b0;
    if (decision_i.finish) begin
      outputs_o.finish_unread = 1'b1;
      outputs_o.cause = '{
          stop: pin_status_i.stop || motion_i.flag_stop,
          alarm: !pin_status_i.alarm_n,
          limit: pin_status_i.limit,
          slow: motion_i.flag_slow
      };
      if (decel_margin[24]) outputs_o.cause = '0;
    end
    if (decision_i.finish && !motion_i.silent) outputs_o.irq_pending = 1'b1;
    if (decision_i.read && decision_i.read_select == SEL_FINISH)
      {outputs_o.finish_unread, outputs_o.irq_pending} = '0;
    if (decision_i.read) outputs_o.read_data_seq = read_data_o.seq;

    hold_left_o = hold_left_i - HoldBits'(decision_i.hold_running);
    if (decision_i.finish) hold_left_o = HoldBits'(HoldRounds - 1);
  end

  // ---- outputs -------------------------------------------------------------------------------------

  logic [5:1] levels;

  assign levels = outputs_i.pattern ^ {5{!outputs_i.positive}};

  always_comb begin
    pin_cmd_o = '{
        halt: decision_i.halt,
        pulse: decision_i.pulse,
        pulse_end: decision_i.pulse_end,
        set_pins:
        decision_i.start
        ||
        decision_i.first_init
        ||
        decision_i.exc_off
        ||
        decision_i.init_done
        ||
        decision_i.chop_edge
        ||
        decision_i.hold_end,
        arm: decision_i.start || (decision_i.pulse && !decision_i.last_pulse),
        search: motion_o.op == OP_ORIGIN,
        ccw: motion_o.ccw,
        hold: outputs_o.hold,
        s: (outputs_o.pattern & {5{outputs_o.phases_on}}) ^ {5{!outputs_o.positive}}
    };

    // The new seq differs from the seq of the previous response, and from the seq of the response that the
    // host has read last.
    read_data_o.seq = outputs_i.read_data_seq + 2'd1;
    if (read_data_o.seq == read_seq_i) read_data_o.seq = outputs_i.read_data_seq + 2'd2;
    read_data_o.bytes = (decision_i.read_select == SEL_REMAINING) ? 2'd3 : 2'd1;
    read_data_o.data  = motion_i.decel_margin[23:0];
    unique case (decision_i.read_select)
      SEL_FINISH: read_data_o.data[7:0] = {outputs_i.finish_unread, outputs_i.cause, motion_i.op};
      SEL_INPUTS:
      read_data_o.data[7:0] = ~{
        pin_status_i.switches.origin,
        pin_status_i.switches.alarm,
        2'b11,
        pin_status_i.switches.limit_cw,
        pin_status_i.switches.limit_ccw,
        pin_status_i.switches.slow_cw,
        pin_status_i.switches.slow_ccw
      };
      SEL_OUTPUTS:
      read_data_o.data[7:0] = {
        levels[1], levels[2], levels[3], levels[4], levels[5], outputs_i.hold, motion_i.ccw, 1'b0
      };
      default: ;
    endcase
  end

endmodule

`default_nettype wire
