// SPDX-License-Identifier: Apache-2.0
// ppmc312_stage_seq: selects what the next pulse of a motion along a stage table does: its rate, or the end
//         of the motion.
// Rules:  P312-MOT-12, P312-MOT-20, P312-MOT-30..33, P312-OVR-11.
// Timing: next_* are valid from 4 cycles after a pulse. slow_i acts at a boundary if it is high 2 cycles
//         before it; change_i acts if it occurs 5 cycles before the boundary (constant rate) or 9 cycles
//         (ramp). When a stage becomes a constant rate, a search for t(rate) takes 129 cycles: a ramp begins
//         at the earliest 136 cycles after that boundary, a deceleration to the end (only where rates do not
//         fall) 132 cycles.
// How:    the running interval is a stage (up or down) or a constant rate. Flags are compared in the first
//         cycle; then the decision is made and delayed two cycles, while the stage that it needs is read.
// Note:   a boundary is the end of an interval; with step_i = 1 a pulse begins there.
`include "ppmc_assert.svh"
`default_nettype none

module ppmc312_stage_seq
  import ppmc312_stage_pkg::*;
(
    input  wire logic          clk_i,          // clock
    input  wire logic          rst_ni,         // reset, asynchronous
    // active table
    input  wire logic   [ 6:0] first_acc_i,    // first stage of the acceleration side
    input  wire logic   [ 6:0] first_dec_i,    // first stage of the deceleration side
    input  wire logic   [15:0] rate_dec_i,     // R[first_dec_i], base clocks
    output look_t              look_o,         // read port of the table
    input  wire stage_t        stage_i,        // stage at look_o, two cycles later
    // operation
    input  wire logic          load_i,         // strobe: start plan_i
    input  wire plan_t         plan_i,         // with load_i; for a change, plan_i.to: 2 cycles later
    input  wire logic          single_i,       // with load_i: one pulse, regardless of plan_i.dec
    // requests
    input  wire logic          change_i,       // strobe: change the rate; replaces an older change
    input  wire logic          change_ramp_i,  // 1: change along the table; sampled 2 cycles after change_i
    input  wire logic          slow_i,         // 1: decelerate to the end
    // decision
    output logic               next_end_o,     // no further pulse: the motion ends
    output logic               next_low_o,     // end, because there is nothing to decelerate
    output logic               next_count_o,   // end, because the last pulse has been output
    output logic               next_slow_o,    // slow_i has been evaluated
    output logic               next_walk_o,    // the deceleration to the end begins
    output logic        [15:0] next_rate_o,    // rate of the next interval, base clocks
    input  wire logic          step_i,         // strobe: boundary, and a pulse begins
    // running interval
    output logic        [15:0] rate_o,         // base clocks; before pulse 1: planned rate, one cycle late
    output logic               flat_o,         // 1: constant rate
    output logic               walk_o,         // 1: deceleration to the end
    output logic               first_o,        // 1: before pulse 1
    output logic               complete_o      // the last pulse of the count has been output
);

  typedef struct packed {
    logic ends;
    logic low;
    logic count;
    logic slow;
    logic drop;   // the deceleration to the end begins
    logic fixed;  // the rate is read from the table
    logic enter;  // a stage begins, with all its pulses
    logic part;   // a stage begins, with some of its pulses
    logic used;   // the held change is consumed
    logic take;   // the held rate becomes the constant rate
    logic own;    // the rate of this stage becomes the constant rate
  } choice_t;

  typedef struct packed {
    logic flat;
    logic down;
    logic walk;
    logic last;     // deceleration that ends with the count
    logic changed;
  } mode_t;

  choice_t choice, choice_q, do_q;
  mode_t now_q, next, next_q, then_q;
  logic [1:0][6:0] addr_q;
  logic [1:0] low_end_q, ramp_end_q;  // low_end_q: this direction ends at first_dec_i; ramp_end_q: at ramp_to
  logic low_end, ramp_end;
  target_t held_q, target_q;
  logic held_valid_q, held_ramp_q, load_q, endless_q, no_point_q, first_q;
  logic [1:0] change_q;
  logic [6:0] stage_q, edge_at_q;
  logic [15:0] rate_q;
  logic [23:0] more_q;  // pulses of this stage after the current one
  logic [31:0] left_q;
  logic [23:0] dec_q;
  walk_t from_q;
  // flags, one cycle after the values that they compare
  logic zero_q, point_q, walk_ok_q, spent_q, edge_q;
  logic [6:0] addr, beside_q, ramp_end_at_q, here, a, b, ramp_at, ramp_to;
  logic ramp_down_q, ramp_some_q, back, forget;
  logic seek_q, look, in_use_q, in_use, stage_ge;  // signals of the search
  logic [1:0] look_q;
  logic [6:0] seek_at_q;
  logic [3:0] ramp_ready_q;

  assign rate_o = rate_q;
  assign flat_o = now_q.flat && !(first_q && point_q);
  assign walk_o = now_q.walk;
  assign first_o = first_q;
  assign complete_o = left_q == '0 && !endless_q;

  // ---- positions in the table ---------------------------------------------------------------------

  assign here = now_q.flat ? target_q.ge : stage_q;
  assign back = now_q.flat ? ramp_down_q : now_q.down;

  // The ramp of a change lies between the constant rate and the look-up result of the new rate.
  assign a = ramp_down_q ? first_dec_i : first_acc_i;
  assign b = ramp_down_q ? held_q.gt1 : beside_q;
  assign ramp_at = ramp_down_q ? beside_q : ramp_end_at_q;
  assign ramp_to = ramp_down_q ? ramp_end_at_q : held_q.ge;

  always_ff @(posedge clk_i) begin
    zero_q <= left_q == '0 && !endless_q;
    point_q <= left_q == 32'(dec_q) && !no_point_q;
    // A constant rate faster than R[first_dec_i] has a stage at first_dec_i or above.
    walk_ok_q <= rate_q < rate_dec_i && (now_q.flat || !ppmc_pkg::less(32'(stage_q), 32'(first_dec_i)));
    spent_q <= more_q == '0;
    edge_q <= stage_q == edge_at_q;
    // beside_q: stage next to the running one, or next to the constant rate; for pulse 1, the running stage.
    beside_q  <= ((now_q.flat && ramp_down_q) ? target_q.gt1 : here) +
        {{6{back}}, back || now_q.flat || !first_q};
    ramp_down_q <= held_q.rate >= rate_q;
    ramp_end_at_q <= ppmc_pkg::less(32'(b), 32'(a)) ? a : b;
    ramp_some_q <= ppmc_pkg::less(32'(ramp_end_at_q), ramp_down_q ? 32'(target_q.gt1) : 32'(held_q.ge1));
  end

  // ---- decision -----------------------------------------------------------------------------------

  always_comb begin
    choice       = '0;
    choice.slow  = slow_i && !(seek_q && walk_ok_q);
    choice.fixed = !now_q.flat;
    next         = now_q;
    low_end      = 1'b0;
    ramp_end     = 1'b0;
    addr         = here;

    if (zero_q) begin
      choice.ends  = 1'b1;
      choice.count = 1'b1;
    end else if (now_q.walk && spent_q && edge_q) begin
      choice.ends = 1'b1;
    end else if (slow_i && !now_q.walk && (first_q || !walk_ok_q)) begin
      choice.ends = 1'b1;
      choice.low  = 1'b1;
    end else if (choice.slow && !now_q.walk && !now_q.last) begin
      choice.drop = 1'b1;
      next.walk   = 1'b1;
      low_end     = 1'b1;
    end else if (held_valid_q && !held_ramp_q) begin
      choice.used  = 1'b1;
      choice.take  = 1'b1;
      choice.fixed = 1'b0;
      next         = '{flat: 1'b1, down: now_q.down, walk: 1'b0, last: 1'b0, changed: 1'b1};
      if (point_q && held_q.slows) begin
        addr    = held_q.ge;
        next.last = 1'b1;
        low_end   = 1'b1;
      end
    end else if (point_q && !now_q.walk) begin
      choice.used = held_valid_q;
      if (!now_q.changed && !held_valid_q) begin
        addr        = from_q.stage;
        choice.part = from_q.part;
        next.last   = 1'b1;
        low_end     = 1'b1;
      end else begin
        next.changed = 1'b1;
        next.last    = walk_ok_q;
        low_end      = walk_ok_q;
        if (!walk_ok_q) begin
          next.flat  = 1'b1;
          next.last  = now_q.last;
          choice.own = !now_q.flat;  // the stage becomes a constant rate
        end
      end
    end else if (held_valid_q && now_q.flat && ramp_ready_q[3]) begin
      choice.used  = 1'b1;
      choice.take  = 1'b1;
      next.changed = 1'b1;
      ramp_end     = ramp_some_q;
      addr         = ramp_at;
      if (ramp_some_q) begin
        next.flat = 1'b0;
        next.down = ramp_down_q;
      end
    end else if (!now_q.flat && spent_q) begin
      if (!edge_q) begin
        choice.enter = 1'b1;
        addr         = beside_q;
      end else begin
        choice.fixed = now_q.last;
        choice.own   = now_q.last;
        next.flat    = 1'b1;
        next.last    = 1'b0;
      end
    end
    if (low_end) begin
      next.flat = 1'b0;
      next.down = 1'b1;
    end
    if (low_end || ramp_end) begin
      choice.fixed = 1'b1;
      choice.enter = 1'b1;
    end
    look = seek_q && now_q.flat && !low_end && !ramp_end;
    if (look) addr = seek_at_q;
  end

  assign look_o = '{side: next.down, stage: addr};

  always_ff @(posedge clk_i) begin
    addr_q     <= {addr_q[0], addr};
    next_q     <= next;
    then_q     <= next_q;
    low_end_q  <= {low_end_q[0], low_end};
    ramp_end_q <= {ramp_end_q[0], ramp_end};
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      choice_q <= '0;
      do_q     <= '0;
    end else begin
      choice_q <= choice;
      do_q     <= choice_q;
    end
  end

  assign next_end_o = do_q.ends;
  assign next_low_o = do_q.low;
  assign next_count_o = do_q.count;
  assign next_slow_o = do_q.slow;
  assign next_walk_o = do_q.drop;
  assign next_rate_o = do_q.fixed ? stage_i.rate : do_q.take ? held_q.rate : target_q.rate;

  // ---- search -------------------------------------------------------------------------------------

  // Look-up for a constant rate that was the rate of a stage: all stages are read, upward, in cycles in which
  // no decision needs the table. A held change waits for the end of this search.
  assign stage_ge = stage_i.rate >= rate_q;
  assign in_use = in_use_q || addr_q[1] == first_acc_i || addr_q[1] == first_dec_i;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      seek_q <= 1'b0;
      look_q <= '0;
    end else begin
      look_q <= {look_q[0], look};
      if (load_i || (step_i && do_q.take)) seek_q <= 1'b0;
      else if (step_i && do_q.own) seek_q <= 1'b1;
      else if (look_q[1] && addr_q[1] == 7'd126) seek_q <= 1'b0;
    end
  end

  always_ff @(posedge clk_i) begin
    if (!seek_q) seek_at_q <= '0;
    else if (look) seek_at_q <= 7'(ppmc_pkg::inc(32'(seek_at_q)));
    in_use_q <= seek_q && (look_q[1] ? in_use : in_use_q);
  end

  // ---- state --------------------------------------------------------------------------------------

  // A change is loaded when no pending decision needs the previous change any more. A deceleration to the end
  // discards it.
  assign forget = load_i || (step_i && do_q.drop);

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      change_q     <= '0;
      held_valid_q <= 1'b0;
      first_q      <= 1'b0;
      load_q       <= 1'b0;
      ramp_ready_q <= '0;
    end else begin
      load_q   <= load_i;
      change_q <= {change_q[0] && !forget, change_i && !load_i};
      if (change_q[1] && !forget) held_valid_q <= 1'b1;
      else if (forget || change_i || (step_i && do_q.used)) held_valid_q <= 1'b0;
      if (load_i) first_q <= 1'b1;
      else if (step_i) first_q <= 1'b0;
      ramp_ready_q <= (!held_valid_q || !now_q.flat || seek_q) ? '0 : {ramp_ready_q[2:0], 1'b1};
    end
  end

  // No reset: every motion begins with a load.
  always_ff @(posedge clk_i) begin
    if (change_q[1] || load_i) held_q <= plan_i.to;
    if (change_q[1]) held_ramp_q <= change_ramp_i;
    if (load_q || (step_i && do_q.take)) begin
      target_q <= held_q;
    end else if (step_i && do_q.own) begin
      target_q.rate <= rate_q;
    end else if (seek_q && look_q[1] && in_use) begin
      if (stage_ge) target_q.ge <= addr_q[1];
      if (stage_ge && stage_i.rate != rate_q) target_q.gt1 <= addr_q[0];
      else if (!in_use_q) target_q.gt1 <= addr_q[1];
    end
    if (load_i) begin
      now_q      <= '{flat: !plan_i.climb, default: 1'b0};
      stage_q    <= first_acc_i;
      edge_at_q  <= plan_i.to.ge;
      more_q     <= '0;
      endless_q  <= plan_i.endless;
      no_point_q <= plan_i.endless || single_i;
      left_q     <= plan_i.count;
      dec_q      <= plan_i.dec;
      from_q     <= plan_i.from;
    end else if (step_i) begin
      now_q   <= then_q;
      stage_q <= addr_q[1];
      if (low_end_q[1]) edge_at_q <= first_dec_i;
      else if (ramp_end_q[1]) edge_at_q <= ramp_to;
      more_q <= (do_q.enter ? (do_q.part ? from_q.left : stage_i.pulses) : more_q) - 1'b1;
      left_q <= left_q - 1'b1;
    end
    // Before pulse 1 a waiting change does not affect rate_q, because another change may still replace it,
    // and because it is compared with the planned rate.
    if (step_i || (first_q && !do_q.take)) rate_q <= next_rate_o;
  end

  logic unused_bits;
  assign unused_bits = &{1'b0, target_q, held_q};

`ifndef SYNTHESIS
  `PPMC_ASSERT(p312_mot_07, !(step_i && next_end_o))
  `PPMC_ASSERT(p312_mot_32_search, !(seek_q && look_q[1]) || addr_q[0] == addr_q[1] + 1'b1)
  `PPMC_ASSERT(p312_mot_12_count, !(step_i && !endless_q && !first_q) || left_q != '0)
`endif

endmodule

`default_nettype wire
