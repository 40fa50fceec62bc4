// SPDX-License-Identifier: Apache-2.0
// ppmc_bank_plan: decisions of a visit: whether the byte is accepted, the effect of byte and switches on the
//         motion, the edge to order from the pin cell, and the cycles to the next edge.
// Rules:  BANK-HSK-02, BANK-GRP-01/02, BANK-MOT-01..05, BANK-CHP-01, BANK-HLD-01; P104-PRO-04/05,
//         P104-FDC-01..05, P104-TIM-05, P104-LIM-01..09.
// Timing: combinational.
// Times:  rem in ppmc_bank_engine is the number of cycles from the visit to the awaited edge. All values
//         added to it are reduced by a round, because the next visit is one round later.
`default_nettype none

module ppmc_bank_plan
  import ppmc_bank_pkg::*;
  import ppmc_code_pkg::*;
  import ppmc_motion_pkg::*;
  import ppmc_op_pkg::*;
#(
    parameter int unsigned Quantum  = 25,  // quantum in cycles
    parameter int unsigned Round    = 32,  // round in cycles
    parameter int unsigned TimeBits = 20
) (
    // axis
    input  wire walk_t                   walk_i,     // state of the motion
    input  wire pace_t                   pace_i,     // interval of the motion
    input  wire setting_t                setting_i,  // progress of the initialisation
    input  wire rest_t                   rest_i,     // phases, chopper, end of the last motion
    input  wire logic                    over_i,     // the hold time ends with this visit
    input  wire seen_t                   seen_i,     // pin cell and switches
    input  wire facts_t                  facts_i,    // comparisons of this visit
    input  wire logic                    free_i,     // a ramp table may be built
    // command unit
    input  wire logic                    extra_i,    // vsel = L in CONFIG
    input  wire mail_t                   mail_i,     // byte of the host
    input  wire logic                    new_i,      // mail_i has not been accepted yet
    input  wire decoded_t                decoded_i,  // mail_i.data as a code
    input  wire error_e                  value_i,    // error in an initialisation that mail_i completes
    input  wire asking_t                 asking_i,   // state before this byte
    output asking_t                      asking_o,   // state after this byte
    output logic                         take_o,     // the byte is accepted
    output logic          [         7:0] code_o,     // code of the actions in plan_o
    output logic          [        31:0] params_o,   // parameters of code_o
    // decisions
    input  wire logic     [TimeBits-1:0] due_i,      // W minus the cycles since GO
    input  wire logic     [TimeBits-1:0] after_i,    // see ppmc_bank_interval_rom
    output plan_t                        plan_o,     // decisions of the visit
    output logic                         anew_o,     // restart rem from 0
    output logic          [TimeBits-1:0] add_o       // cycles to add to rem
);

  localparam int unsigned Width = 20 * Quantum;  // W in cycles
  localparam int unsigned Half = 4 * Quantum;  // half a fast base clock in cycles

  typedef logic [TimeBits-1:0] clk_t;

  action_t act;
  logic kill, undo, finish, ready, proceed, refuse, unit, toggle;
  logic ramp, finished, inits, completes, open, unused_stop, unused_bits;
  logic dec, halt, slow, counts, forced, fast_plain, grows, pulse, rests;

  assign unused_bits = &{1'b0, walk_i, setting_i, rest_i, seen_i, mail_i, act};

  // ---- events since the last visit -----------------------------------------------------------------

  always_comb begin
    ramp = walk_i.op inside {OP_ACC_DEC, OP_CONT_HIGH};
    kill = walk_i.busy && !seen_i.armed && (walk_i.run || !seen_i.emitted);
    undo = kill && !seen_i.emitted;
    finish = walk_i.busy && (kill ? undo || !walk_i.low : !walk_i.run && !walk_i.low);
    ready = setting_i.building && facts_i.built;
    proceed = facts_i.go && seen_i.mask && walk_i.held && walk_i.run && !kill;
    refuse = facts_i.go && seen_i.mask && !proceed;
    unit = !walk_i.busy && rest_i.chop && facts_i.fire && !ready;
    toggle = unit && walk_i.climb == '0;
  end

  // ---- the byte ------------------------------------------------------------------------------------

  assign finished = !walk_i.run || kill;
  assign inits = asking_i.code[7:6] == 2'b00;
  assign completes = inits && !mail_i.command && !asking_i.error && asking_i.number == 3'd1;
  assign open = !finish && !setting_i.building && !(facts_i.go && seen_i.mask) && !toggle
      && (free_i || !completes);
  assign take_o = new_i && open;
  assign code_o = mail_i.command ? mail_i.data : asking_i.code;
  assign params_o = {mail_i.data, asking_i.params[31:8]};

  asking_t asking;
  always_comb begin
    asking_o = asking;
    if (refuse) begin
      asking_o.error  = 1'b1;
      asking_o.number = setting_i.initialised ? ErrUndefined : ErrNotReady;
      if (walk_i.busy && !finish) asking_o.number = ErrBusy;
    end
  end

  ppmc_judge #(
      .Aux(1'b0)
  ) u_judge (
      .take_i        (take_o),
      .command_i     (mail_i.command),
      .byte_i        (mail_i.data),
      .data_i        (mail_i.data),
      .decoded_i,
      .value_i,
      .judged_i      (inits),
      .busy_i        (walk_i.busy),
      .ramp_i        (ramp),
      .decelerating_i(walk_i.forced || walk_i.natural || finished),
      .initialised_i (setting_i.initialised),
      .asking_i,
      .asking_o      (asking),
      .act_o         (act),
      .stop_o        (unused_stop)
  );

  // ---- the motion ----------------------------------------------------------------------------------

  always_comb begin
    plan_o.kill    = kill;
    plan_o.undo    = undo;
    plan_o.finish  = finish;
    plan_o.ready   = ready;
    plan_o.proceed = proceed;
    plan_o.refuse  = refuse;
    plan_o.unit    = unit;
    plan_o.toggle  = toggle;
    fast_plain = !pace_i.slow && !pace_i.extra;
    slow = walk_i.ccw ? seen_i.switches.slow_ccw : seen_i.switches.slow_cw;
    halt = act.halt || (act.decel && !ramp);
    dec = walk_i.forced || walk_i.natural || finished;
    counts = ramp && !dec && !halt && (!walk_i.pout_only || facts_i.full);
    plan_o.halt = halt;
    plan_o.flag_stop = act.decel && ramp && !dec;
    plan_o.flag_slow = slow && counts;
    forced = walk_i.forced || plan_o.flag_stop || plan_o.flag_slow;

    pulse = walk_i.run && !walk_i.held && !walk_i.low && !kill && facts_i.fire && !facts_i.more;
    plan_o.pulse = pulse && !halt;
    // A low time that may still become longer does not end before its length is known.
    grows = facts_i.more && fast_plain && !walk_i.last && pace_i.rate < 8'd3;
    plan_o.rise = walk_i.low && facts_i.fire && !grows && !undo;
    plan_o.probe = facts_i.more && !plan_o.rise && !undo;
    plan_o.back = ramp && (forced || facts_i.minus);
    plan_o.up = ramp && !forced && !pace_i.down && !facts_i.minus && !facts_i.zero && !facts_i.full;
    plan_o.turn = ramp && !pace_i.down && (forced || facts_i.minus || facts_i.zero);
    plan_o.natural = ramp && (facts_i.minus || (facts_i.zero && !facts_i.full));
    plan_o.last = (plan_o.back && facts_i.foot) || (facts_i.zero && walk_i.climb == '0);

    plan_o.start = act.start;
    plan_o.init = act.init;
    plan_o.first = act.init && !setting_i.initialised;
    plan_o.exc_off = act.exc_off;
    plan_o.switching = act.switching;
    plan_o.read = act.read;
    plan_o.select = mail_i.data[2:0];
    rests = !walk_i.busy && !rest_i.hold && !act.start;
    plan_o.rest = rests && !over_i;
    plan_o.hold = rests && over_i && !toggle;
  end

  // ---- cycles to the next edge ---------------------------------------------------------------------

  // Low time at a rate: W, except for the rates 0 to 2 with halves.
  function automatic clk_t low_time(logic [7:0] rate, logic halves);
    unique case ({
      halves && rate[7:2] == '0, rate[1:0]
    })
      3'b100:  return clk_t'(Half - Round);
      3'b101:  return clk_t'(2 * Half - Round);
      3'b110:  return clk_t'(3 * Half - Round);
      default: return clk_t'(Width - Round);
    endcase
  endfunction

  // Difference to the low time of the next slower rate.
  function automatic clk_t longer(logic [7:0] rate, logic halves);
    if (!halves || rate[7:2] != '0 || rate[1:0] == 2'd3) return -clk_t'(Round);
    return (rate[1:0] == 2'd2) ? clk_t'(Width - 3 * Half - Round) : clk_t'(Half - Round);
  endfunction

  // Fixed time of a chopper phase.
  function automatic clk_t phase(logic on, logic host, logic extra);
    unique case ({
      on, host, extra
    })
      3'b100, 3'b101: return clk_t'(ppmc104_pkg::CHOP_ON_DEFAULT * Quantum - Round);
      3'b000, 3'b001: return clk_t'(ppmc104_pkg::CHOP_OFF_DEFAULT * Quantum - Round);
      3'b110:         return clk_t'(ppmc104_pkg::CHOP_ON_VSEL_H * Quantum - Round);
      3'b010:         return clk_t'(ppmc104_pkg::CHOP_OFF_VSEL_H * Quantum - Round);
      3'b111:         return clk_t'(ppmc104_pkg::CHOP_ON_VSEL_L * Quantum - Round);
      default:        return clk_t'(ppmc104_pkg::CHOP_OFF_VSEL_L * Quantum - Round);
    endcase
  endfunction

  // The decisions of the byte are applied last, because they are timing-critical. After a halt no edge is
  // scheduled.
  always_comb begin
    anew_o = plan_o.start || proceed || finish || ready;
    add_o  = -clk_t'(Round);
    if (proceed) begin
      add_o = due_i;
    end else if (finish || ready || toggle) begin
      add_o = phase(toggle ? !rest_i.on : 1'b1, rest_i.programmed, extra_i);
    end else if (unit) begin
      add_o = clk_t'(ppmc104_pkg::CHOP_UNIT * Quantum - Round);
    end else if (plan_o.rise) begin
      add_o = after_i;
    end else if (pulse) begin
      add_o = low_time(pace_i.rate, fast_plain);
    end else if (plan_o.probe && pace_i.down) begin
      if (walk_i.low) add_o = longer(pace_i.rate, fast_plain && !walk_i.last);
      else add_o = pace_i.slow ? clk_t'(32 * Quantum - Round) : clk_t'(8 * Quantum - Round);
    end
    if (plan_o.start || (pulse && plan_o.last)) add_o = clk_t'(Width - Round);
  end

endmodule

`default_nettype wire
