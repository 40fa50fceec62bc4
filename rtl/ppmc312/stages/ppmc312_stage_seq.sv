// SPDX-License-Identifier: Apache-2.0
// ppmc312_stage_seq: for a motion along a stage table, selects the rate of the next pulse, or ends the
//         motion.
// Rules:  P312-MOT-12, P312-MOT-20, P312-MOT-30..33, P312-OVR-11.
// Timing: the outputs next_* become valid 4 cycles after each pulse.
//         A deceleration request acts at a boundary if slow_i is high 2 cycles before the boundary. A change
//         acts at a boundary if change_i occurs at least 5 cycles (constant rate) or 9 cycles (change along
//         the table) before the boundary.
//         If the rate of a stage becomes a constant rate at a boundary, a search for t(rate) begins. t(rate)
//         is the last stage that is not faster than this rate. The search takes 129 cycles. A ramp begins at
//         the earliest 136 cycles after this boundary, a deceleration to the end 132 cycles after it. Such a
//         deceleration is possible only with a table that is not monotonic: the constant rate is the rate of
//         a stage below first_dec_i, but it is faster than the rate of stage first_dec_i.
// How:    the running interval has the rate of a stage (up or down the table) or a constant rate. Counts and
//         stages are compared in the first cycle of an interval. The decision follows; it is delayed by two
//         cycles, in which the table reads the stage that the decision needs.
// Note:   a boundary is the end of an interval. With step_i = 1, a pulse begins at the boundary.
`include "ppmc_assert.svh"
`default_nettype none

module ppmc312_stage_seq
  import ppmc312_stage_pkg::*;
(
    input wire logic clk_i,  // clock
    input wire logic rst_ni,  // reset, asynchronous
    // active table
    input wire logic [6:0] first_acc_i,  // first stage of the acceleration side
    input wire logic [6:0] first_dec_i,  // first stage of the deceleration side
    input wire logic [15:0] rate_dec_i,  // rate of stage first_dec_i, base clocks
    output table_addr_t table_addr_o,  // read port of the table
    input wire stage_t stage_i,  // stage at table_addr_o, two cycles later
    // operation
    input wire logic load_i,  // strobe: start the operation profile_i
    input wire profile_t profile_i,  // sampled with load_i; target also 2 cycles after change_i
    input wire logic single_i,  // with load_i; 1: one pulse, regardless of dec_pulses
    // requests
    input wire logic change_i,  // strobe: change the rate; replaces a pending change
    input wire logic change_ramp_i,  // 1: change along the table; sampled 2 cycles after change_i
    input wire logic slow_i,  // 1: decelerate to the end
    // decision
    output logic next_end_o,  // no further pulse: the motion ends
    output logic next_low_o,  // with next_end_o; cause: no deceleration is necessary
    output logic next_count_o,  // with next_end_o; cause: the last pulse has been output
    output logic next_slow_o,  // slow_i has been evaluated
    output logic next_final_decel_o,  // the deceleration to the end begins
    output logic [15:0] next_rate_o,  // rate of the next interval, base clocks
    input wire logic step_i,  // strobe: boundary, and a pulse begins
    // running interval
    output logic [15:0] rate_o,  // rate of this interval in base clocks; before pulse 1: planned rate
    output logic const_rate_o,  // 1: constant rate
    output logic final_decel_o,  // 1: deceleration to the end
    output logic first_o,  // 1: before pulse 1
    output logic complete_o  // the last pulse of the count has been output
);

  typedef struct packed {
    logic ends;
    logic low;
    logic count;
    logic slow;
    logic final_decel;  // the deceleration to the end begins
    logic from_table;  // the rate is read from the table
    logic enter;  // the next stage begins, with all its pulses
    logic is_partial;  // the next stage begins, with some of its pulses
    logic change_used;  // the pending change is consumed
    logic take_target;  // the pending rate becomes the constant rate
    logic keep_rate;  // the rate of the running stage becomes the constant rate
  } boundary_action_t;

  typedef struct packed {
    logic const_rate;
    logic down;
    logic final_decel;
    logic last;     // 1: the deceleration ends with the last pulse of the count
    logic changed;
  } interval_mode_t;

  boundary_action_t action, action_q, action_q2;
  interval_mode_t mode_q, next, next_q, next_q2;
  logic [1:0][6:0] addr_q;
  // low_end_q: the ramp ends at first_dec_i; ramp_end_q: the ramp ends at ramp_to
  logic [1:0] low_end_q, ramp_end_q;
  logic low_end, ramp_end;
  target_t pending_q, target_q;
  logic pending_valid_q, pending_ramp_q, load_q, endless_q, no_decel_point_q, first_q;
  logic [1:0] change_q;
  logic [6:0] stage_q, last_stage_at_q;
  logic [15:0] rate_q;
  logic [23:0] more_q;  // pulses of the running stage after the current pulse
  logic [31:0] left_q;
  logic [23:0] dec_q;
  ramp_pos_t decel_start_q;
  // results of comparisons, one cycle after the compared values
  logic zero_q, decel_point_q, can_decel_q, stage_done_q, last_stage_q;
  logic [6:0] addr, adjacent_q, ramp_end_at_q, current_stage, a, b, ramp_at, ramp_to;
  logic ramp_down_q, ramp_some_q, downward, drop_change;
  logic searching_q, search_read, in_use_q, in_use, stage_ge;  // signals of the search
  logic [1:0] search_read_q;
  logic [6:0] search_stage_q;
  logic [3:0] ramp_ready_q;

  assign rate_o = rate_q;
  assign const_rate_o = mode_q.const_rate && !(first_q && decel_point_q);
  assign final_decel_o = mode_q.final_decel;
  assign first_o = first_q;
  assign complete_o = left_q == '0 && !endless_q;

  // ---- positions in the table ---------------------------------------------------------------------

  assign current_stage = mode_q.const_rate ? target_q.ge : stage_q;
  assign downward = mode_q.const_rate ? ramp_down_q : mode_q.down;

  // For a rate change, the ramp lies between the constant rate and the look-up result of the new rate.
  assign a = ramp_down_q ? first_dec_i : first_acc_i;
  assign b = ramp_down_q ? pending_q.gt1 : adjacent_q;
  assign ramp_at = ramp_down_q ? adjacent_q : ramp_end_at_q;
  assign ramp_to = ramp_down_q ? ramp_end_at_q : pending_q.ge;

  always_ff @(posedge clk_i) begin
    zero_q <= left_q == '0 && !endless_q;
    decel_point_q <= left_q == 32'(dec_q) && !no_decel_point_q;
    // If a constant rate is faster than the rate of stage first_dec_i, the look-up has found a stage at or
    // above first_dec_i.
    can_decel_q <= rate_q < rate_dec_i && (mode_q.const_rate || !ppmc_pkg::less(
        32'(stage_q), 32'(first_dec_i)
    ));
    stage_done_q <= more_q == '0;
    last_stage_q <= stage_q == last_stage_at_q;
    // adjacent_q: for pulse 1, the running stage; otherwise the next stage in the direction of the ramp,
    // seen from the running stage or from the constant rate
    adjacent_q  <= ((mode_q.const_rate && ramp_down_q) ? target_q.gt1 : current_stage) +
        {{6{downward}}, downward || mode_q.const_rate || !first_q};
    ramp_down_q <= pending_q.rate >= rate_q;
    ramp_end_at_q <= ppmc_pkg::less(32'(b), 32'(a)) ? a : b;
    ramp_some_q <= ppmc_pkg::less(32'(ramp_end_at_q), ramp_down_q ? 32'(target_q.gt1) : 32'(pending_q.ge1));
  end

  // ---- decision -----------------------------------------------------------------------------------

  always_comb begin
    action            = '0;
    action.slow       = slow_i && !(searching_q && can_decel_q);
    action.from_table = !mode_q.const_rate;
    next              = mode_q;
    low_end           = 1'b0;
    ramp_end          = 1'b0;
    addr              = current_stage;

    if (zero_q) begin
      action.ends  = 1'b1;
      action.count = 1'b1;
    end else if (mode_q.final_decel && stage_done_q && last_stage_q) begin
      action.ends = 1'b1;
    end else if (slow_i && !mode_q.final_decel && (first_q || !can_decel_q)) begin
      action.ends = 1'b1;
      action.low  = 1'b1;
    end else if (action.slow && !mode_q.final_decel && !mode_q.last) begin
      action.final_decel = 1'b1;
      next.final_decel   = 1'b1;
      low_end            = 1'b1;
    end else if (pending_valid_q && !pending_ramp_q) begin
      action.change_used = 1'b1;
      action.take_target = 1'b1;
      action.from_table = 1'b0;
      next = '{const_rate: 1'b1, down: mode_q.down, final_decel: 1'b0, last: 1'b0, changed: 1'b1};
      if (decel_point_q && pending_q.has_decel) begin
        addr    = pending_q.ge;
        next.last = 1'b1;
        low_end   = 1'b1;
      end
    end else if (decel_point_q && !mode_q.final_decel) begin
      action.change_used = pending_valid_q;
      if (!mode_q.changed && !pending_valid_q) begin
        addr              = decel_start_q.stage;
        action.is_partial = decel_start_q.is_partial;
        next.last         = 1'b1;
        low_end           = 1'b1;
      end else begin
        next.changed = 1'b1;
        next.last    = can_decel_q;
        low_end      = can_decel_q;
        if (!can_decel_q) begin
          next.const_rate = 1'b1;
          next.last = mode_q.last;
          action.keep_rate = !mode_q.const_rate;  // the stage rate becomes the constant rate
        end
      end
    end else if (pending_valid_q && mode_q.const_rate && ramp_ready_q[3]) begin
      action.change_used = 1'b1;
      action.take_target = 1'b1;
      next.changed       = 1'b1;
      ramp_end           = ramp_some_q;
      addr               = ramp_at;
      if (ramp_some_q) begin
        next.const_rate = 1'b0;
        next.down = ramp_down_q;
      end
    end else if (!mode_q.const_rate && stage_done_q) begin
      if (!last_stage_q) begin
        action.enter = 1'b1;
        addr         = adjacent_q;
      end else begin
        action.from_table = mode_q.last;
        action.keep_rate   = mode_q.last;
        next.const_rate    = 1'b1;
        next.last    = 1'b0;
      end
    end
    if (low_end) begin
      next.const_rate = 1'b0;
      next.down = 1'b1;
    end
    if (low_end || ramp_end) begin
      action.from_table = 1'b1;
      action.enter = 1'b1;
    end
    search_read = searching_q && mode_q.const_rate && !low_end && !ramp_end;
    if (search_read) addr = search_stage_q;
  end

  assign table_addr_o = '{side: next.down, stage: addr};

  always_ff @(posedge clk_i) begin
    addr_q     <= {addr_q[0], addr};
    next_q     <= next;
    next_q2    <= next_q;
    low_end_q  <= {low_end_q[0], low_end};
    ramp_end_q <= {ramp_end_q[0], ramp_end};
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      action_q  <= '0;
      action_q2 <= '0;
    end else begin
      action_q  <= action;
      action_q2 <= action_q;
    end
  end

  assign next_end_o = action_q2.ends;
  assign next_low_o = action_q2.low;
  assign next_count_o = action_q2.count;
  assign next_slow_o = action_q2.slow;
  assign next_final_decel_o = action_q2.final_decel;
  assign next_rate_o = action_q2.from_table ? stage_i.rate :
      action_q2.take_target ? pending_q.rate : target_q.rate;

  // ---- search -------------------------------------------------------------------------------------

  // This search determines t(rate) of a constant rate that was the rate of a stage. It reads all stages
  // upward, in cycles in which no decision needs the table. A pending change waits until this search has
  // ended.
  assign stage_ge = stage_i.rate >= rate_q;
  assign in_use = in_use_q || addr_q[1] == first_acc_i || addr_q[1] == first_dec_i;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      searching_q   <= 1'b0;
      search_read_q <= '0;
    end else begin
      search_read_q <= {search_read_q[0], search_read};
      if (load_i || (step_i && action_q2.take_target)) searching_q <= 1'b0;
      else if (step_i && action_q2.keep_rate) searching_q <= 1'b1;
      else if (search_read_q[1] && addr_q[1] == 7'd126) searching_q <= 1'b0;
    end
  end

  always_ff @(posedge clk_i) begin
    if (!searching_q) search_stage_q <= '0;
    else if (search_read) search_stage_q <= 7'(ppmc_pkg::inc(32'(search_stage_q)));
    in_use_q <= searching_q && (search_read_q[1] ? in_use : in_use_q);
  end

  // ---- state --------------------------------------------------------------------------------------

  // A change is loaded when no pending decision needs the previous change. A deceleration to the end
  // discards the pending change.
  assign drop_change = load_i || (step_i && action_q2.final_decel);

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      change_q        <= '0;
      pending_valid_q <= 1'b0;
      first_q         <= 1'b0;
      load_q          <= 1'b0;
      ramp_ready_q    <= '0;
    end else begin
      load_q   <= load_i;
      change_q <= {change_q[0] && !drop_change, change_i && !load_i};
      if (change_q[1] && !drop_change) pending_valid_q <= 1'b1;
      else if (drop_change || change_i || (step_i && action_q2.change_used)) pending_valid_q <= 1'b0;
      if (load_i) first_q <= 1'b1;
      else if (step_i) first_q <= 1'b0;
      ramp_ready_q <= (!pending_valid_q || !mode_q.const_rate || searching_q) ? '0 :
          {ramp_ready_q[2:0], 1'b1};
    end
  end

  // No reset: a load precedes every motion.
  always_ff @(posedge clk_i) begin
    if (change_q[1] || load_i) pending_q <= profile_i.target;
    if (change_q[1]) pending_ramp_q <= change_ramp_i;
    if (load_q || (step_i && action_q2.take_target)) begin
      target_q <= pending_q;
    end else if (step_i && action_q2.keep_rate) begin
      target_q.rate <= rate_q;
    end else if (searching_q && search_read_q[1] && in_use) begin
      if (stage_ge) target_q.ge <= addr_q[1];
      if (stage_ge && stage_i.rate != rate_q) target_q.gt1 <= addr_q[0];
      else if (!in_use_q) target_q.gt1 <= addr_q[1];
    end
    if (load_i) begin
      mode_q           <= '{const_rate: !profile_i.starts_with_accel, default: 1'b0};
      stage_q          <= first_acc_i;
      last_stage_at_q  <= profile_i.target.ge;
      more_q           <= '0;
      endless_q        <= profile_i.endless;
      no_decel_point_q <= profile_i.endless || single_i;
      left_q           <= profile_i.count;
      dec_q            <= profile_i.dec_pulses;
      decel_start_q    <= profile_i.decel_start;
    end else if (step_i) begin
      mode_q  <= next_q2;
      stage_q <= addr_q[1];
      if (low_end_q[1]) last_stage_at_q <= first_dec_i;
      else if (ramp_end_q[1]) last_stage_at_q <= ramp_to;
      more_q <= (action_q2.enter ?
                 (action_q2.is_partial ? decel_start_q.pulses : stage_i.pulses) : more_q) - 1'b1;
      left_q <= left_q - 1'b1;
    end
    // Before pulse 1, a pending change does not affect rate_q. Another change may still replace the pending
    // change, and each change is compared with the planned rate.
    if (step_i || (first_q && !action_q2.take_target)) rate_q <= next_rate_o;
  end

  logic unused_bits;
  assign unused_bits = &{1'b0, target_q, pending_q};

`ifndef SYNTHESIS
  `PPMC_ASSERT(p312_mot_07, !(step_i && next_end_o))
  `PPMC_ASSERT(p312_mot_32_search, !(searching_q && search_read_q[1]) || addr_q[0] == addr_q[1] + 1'b1)
  `PPMC_ASSERT(p312_mot_12_count, !(step_i && !endless_q && !first_q) || left_q != '0)
`endif

endmodule

`default_nettype wire
