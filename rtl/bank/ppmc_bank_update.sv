// SPDX-License-Identifier: Apache-2.0
// ppmc_bank_update: executes the decisions of a visit: next state of the axis, order to the pin cell, answer
//         for the host.
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
    parameter int unsigned HoldBits = 17  // bits of left_i
) (
    input  wire plan_t                   plan_i,      // decisions of the visit
    input  wire seen_t                   seen_i,      // pin cell and switches
    input  wire logic     [         7:0] code_i,      // code of the action
    input  wire logic     [        31:0] params_i,    // parameters of code_i
    input  wire logic     [         1:0] config_ni,   // vsel and csel, inverted
    input  wire logic     [         1:0] read_seq_i,  // seq of the answer that the host has read last
    // state before the visit
    input  wire walk_t                   walk_i,      // state of the motion
    input  wire pace_t                   pace_i,      // interval of the motion
    input  wire setting_t                setting_i,   // progress of the initialisation
    input  wire units_t                  units_i,     // units of the chopper
    input  wire logic                    chop_i,      // chopping at standstill, from the initialisation
    input  wire logic     [         7:0] slow_i,      // start-up rate
    input  wire rest_t                   rest_i,      // phases, chopper, end of the last motion
    input  wire logic     [HoldBits-1:0] left_i,      // remaining rounds of the hold time, minus 1
    input  wire logic     [        31:0] position_i,  // CW pulses minus CCW pulses
    // state after the visit
    output walk_t                        walk_o,      // state of the motion
    output pace_t                        pace_o,      // interval of the motion
    output setting_t                     setting_o,   // progress of the initialisation
    output rest_t                        rest_o,      // phases, chopper, end of the last motion
    output logic          [HoldBits-1:0] left_o,      // remaining rounds of the hold time, minus 1
    output logic          [        31:0] position_o,  // CW pulses minus CCW pulses
    // outputs
    output order_t                       order_o,     // order to the pin cell
    output answer_t                      answer_o,    // answer to a read command, with plan_i.read
    output logic                         call_o,      // set the pending interrupt of the axis
    output logic                         calm_o       // clear the pending interrupt of the axis
);

  op_code_t   code;
  init_code_t init;  // code_i as the code of an initialisation
  logic ramped, unused_bits;

  assign unused_bits = &{1'b0, plan_i, seen_i, code, init};
  assign code = op_code_t'(code_i);
  assign init = init_code_t'(code_i);
  assign ramped = code.op inside {OP_ACC_DEC, OP_CONT_HIGH};

  // ---- motion --------------------------------------------------------------------------------------

  logic [24:0] slack_add;
  logic [24:0] slack;  // with finish: remaining pulses minus 1
  logic down;  // climb decreases by 1
  logic ccw, counts;  // ccw: direction of a pulse that is added or removed; counts: there is such a pulse

  assign ccw    = walk_i.ccw ^ plan_i.undo;
  assign counts = plan_i.pulse || plan_i.undo;

  always_comb begin
    slack_add = '0;
    if (plan_i.finish) slack_add = {{10{walk_i.climb[14]}}, walk_i.climb};
    else if (plan_i.pulse && !plan_i.back) slack_add = plan_i.up ? -25'd2 : -25'd1;
    slack = walk_i.slack + slack_add + 25'(plan_i.undo);

    down = plan_i.unit || (plan_i.pulse && plan_i.back);
    walk_o = walk_i;
    walk_o.slack = slack;
    walk_o.climb = walk_i.climb + {{14{down}}, down || (plan_i.pulse && plan_i.up)};
    walk_o.forced = walk_i.forced || plan_i.flag_stop || plan_i.flag_slow;
    walk_o.flag_stop = walk_i.flag_stop || plan_i.flag_stop;
    walk_o.flag_slow = walk_i.flag_slow || plan_i.flag_slow;
    if (plan_i.proceed) walk_o.held = 1'b0;
    if (plan_i.rise || plan_i.undo) walk_o.low = 1'b0;
    if (plan_i.kill) walk_o.run = 1'b0;
    if (plan_i.pulse) begin
      walk_o.low     = 1'b1;
      walk_o.run     = !plan_i.last;
      walk_o.last    = plan_i.last;
      walk_o.natural = walk_i.natural || plan_i.natural;
    end
    if (plan_i.finish) begin
      walk_o.busy = 1'b0;
      walk_o.run  = 1'b0;
      if (slack[24]) walk_o.slack = '0;
    end
    if (plan_i.finish || plan_i.ready) walk_o.climb = {7'd0, rest_i.programmed ? units_i.on : 8'd0};
    if (plan_i.toggle) begin
      walk_o.climb = '0;
      if (rest_i.programmed) walk_o.climb[7:0] = rest_i.on ? units_i.off : units_i.on;
    end
    if (plan_i.start) begin
      walk_o = '{
          busy: 1'b1,
          run: 1'b1,
          held: seen_i.mask,
          op: code.op,
          pout_only: code.pout_only,
          ccw: code.ccw,
          silent: code.silent,
          slack: 25'h0FFFFFF,
          default: '0
      };
      if (code.op inside {OP_ACC_DEC, OP_CONSTANT}) walk_o.slack = {1'b0, params_i[31:8]};
      if (code.op == OP_SINGLE) walk_o.slack = '0;
    end

    pace_o = pace_i;
    if (plan_i.probe) pace_o.rate = pace_i.down ? pace_i.rate + 1'b1 : pace_i.rate - 1'b1;
    if (plan_i.pulse && plan_i.turn) pace_o.down = 1'b1;
    if (plan_i.start) begin
      pace_o = '{slow: config_ni[0], extra: config_ni[1], down: 1'b0, rate: slow_i};
      if (!ramped) pace_o.rate = (code.op == OP_CONSTANT) ? params_i[7:0] : params_i[31:24];
    end

    position_o = position_i + {{31{ccw && counts}}, counts};
  end

  // ---- set-up, phases, standstill ------------------------------------------------------------------

  motor_e motor;

  assign motor = motor_e'(rest_i.motor);

  always_comb begin
    setting_o = setting_i;
    if (plan_i.init) setting_o.building = 1'b1;
    if (plan_i.ready) setting_o = '{initialised: 1'b1, building: 1'b0};
    if (plan_i.exc_off) setting_o.initialised = 1'b0;

    rest_o = rest_i;
    if (counts && !walk_i.pout_only) begin
      rest_o.pattern = stepped(rest_i.pattern, rest_i.pair, rest_i.half, motor, ccw);
      rest_o.pair    = rest_i.pair ^ rest_i.half;
    end
    if (plan_i.first) begin
      rest_o.motor    = init.motor;
      rest_o.half     = init.half;
      rest_o.positive = init.positive;
    end
    if (plan_i.first || plan_i.exc_off) begin
      rest_o.pattern = {3'b000, {2{plan_i.first}}};
      rest_o.pair    = 1'b1;
    end
    if (plan_i.ready) rest_o.chop = chop_i;
    if (plan_i.exc_off) rest_o.chop = 1'b0;
    if (plan_i.toggle) rest_o.on = !rest_i.on;
    if (plan_i.ready || plan_i.start || plan_i.exc_off || plan_i.finish) rest_o.on = 1'b1;
    if (plan_i.switching) rest_o.programmed = 1'b1;
    if (plan_i.hold) rest_o.hold = 1'b1;
    if (plan_i.start) rest_o.hold = 1'b0;
    if (plan_i.finish) begin
      rest_o.fresh = 1'b1;
      rest_o.cause = '{
          stop: seen_i.stop || walk_i.flag_stop,
          alarm: seen_i.alarm,
          limit: seen_i.limit,
          slow: walk_i.flag_slow
      };
      if (slack[24]) rest_o.cause = '0;
    end
    if (calm_o) rest_o.fresh = 1'b0;
    if (plan_i.read) rest_o.seq = answer_o.seq;

    left_o = left_i - HoldBits'(plan_i.rest);
    if (plan_i.finish) left_o = HoldBits'(HoldRounds - 1);
  end

  // ---- outputs -------------------------------------------------------------------------------------

  logic [5:1] levels;

  assign levels = rest_i.pattern ^ {5{!rest_i.positive}};
  assign call_o = plan_i.finish && !walk_i.silent;
  assign calm_o = plan_i.read && plan_i.select == SEL_FINISH;

  always_comb begin
    order_o = '{
        halt: plan_i.halt,
        pulse: plan_i.pulse,
        rise: plan_i.rise,
        sets: plan_i.start || plan_i.first || plan_i.exc_off || plan_i.ready || plan_i.toggle || plan_i.hold,
        arm: plan_i.start || (plan_i.pulse && !plan_i.last),
        search: walk_o.op == OP_ORIGIN,
        ccw: walk_o.ccw,
        hold: rest_o.hold,
        s: (rest_o.pattern & {5{rest_o.on}}) ^ {5{!rest_o.positive}}
    };

    // The new seq differs from the seq of the previous answer and from that of the answer read last.
    answer_o.seq = rest_i.seq + 2'd1;
    if (answer_o.seq == read_seq_i) answer_o.seq = rest_i.seq + 2'd2;
    answer_o.bytes = (plan_i.select == SEL_REMAINING) ? 2'd3 : 2'd1;
    answer_o.data  = walk_i.slack[23:0];
    unique case (plan_i.select)
      SEL_FINISH: answer_o.data[7:0] = {rest_i.fresh, rest_i.cause, walk_i.op};
      SEL_INPUTS:
      answer_o.data[7:0] = ~{
        seen_i.switches.origin,
        seen_i.switches.alarm,
        2'b11,
        seen_i.switches.limit_cw,
        seen_i.switches.limit_ccw,
        seen_i.switches.slow_cw,
        seen_i.switches.slow_ccw
      };
      SEL_OUTPUTS:
      answer_o.data[7:0] = {
        levels[1], levels[2], levels[3], levels[4], levels[5], rest_i.hold, walk_i.ccw, 1'b0
      };
      default: ;
    endcase
  end

endmodule

`default_nettype wire
