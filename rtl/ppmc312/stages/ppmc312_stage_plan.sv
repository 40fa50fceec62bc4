// SPDX-License-Identifier: Apache-2.0
// ppmc312_stage_plan: looks up a rate in the stage table, and plans operations with acceleration and
//         deceleration.
// Rules:  P312-MOT-10..13 (kinds, pulses of the sides), P312-GEN-06 (t(x)).
// Timing: busy_o rises at the edge that ends the cycle of start_i. A look-up takes 131 cycles. The plan of an
//         operation that is not endless adds at most 7 cycles, or 60 cycles for a triangular profile. If the
//         deceleration does not begin with a complete stage, the search for its start adds 5 cycles + the
//         number of stages of the deceleration side. Results are valid until the next start.
// How:    one pass reads the table upward and finds t(x), the last stage that is not faster than rate_i. The
//         outputs are t(x) and t(x) + 1. If no stage qualifies, t(x) is the stage before the first used
//         stage. The rates need not decrease from stage to stage. The pass also adds up the pulses of the
//         stages, in separate sums for stages that both sides (acceleration, deceleration) have, and for
//         stages that only one side has. The sums up to t(x) are stored.
`default_nettype none

module ppmc312_stage_plan
  import ppmc312_stage_pkg::*;
(
    input wire logic clk_i,  // clock
    input wire logic rst_ni,  // reset, asynchronous
    input wire logic start_i,  // strobe: start
    input wire logic ramp_i,  // 1: look up and plan, 0: look up only
    input wire logic endless_i,  // 1: the operation runs until it is stopped
    input wire logic [15:0] rate_i,  // rate in base clocks; stable while busy_o = 1, like the inputs below
    input wire logic [31:0] count_i,  // pulses, at least 1
    input wire logic [6:0] first_acc_i,  // first stage of the acceleration side
    input wire logic [6:0] first_dec_i,  // first stage of the deceleration side
    output logic busy_o,  // from the cycle after start_i until the results are valid
    // table
    output logic both_o,  // 1: the read port of the motion is needed, too
    output logic [6:0] addr_o,  // stage to be read
    input wire logic [15:0] table_rate_i,  // rate of stage addr_o, two cycles later
    input wire logic [23:0] table_acc_i,  // acceleration pulses of this stage, two cycles later
    input wire logic [23:0] table_dec_i,  // deceleration pulses of this stage; valid with both_o
    output target_t target_o,  // look-up result for rate_i
    // plan
    output logic starts_with_accel_o,  // the operation begins with acceleration
    output logic [7:0] kind_o,  // status byte: 00: trapezoidal, 10: triangular, 20, 40: right-angled
    output logic [23:0] dec_pulses_o,  // pulses of the deceleration
    output ramp_pos_t decel_start_o,  // start of the deceleration
    // arithmetic, shared with the builder
    output logic op_start_o,  // strobe: start the operation
    output logic op_mul_o,  // 1: multiply, 0: divide
    output logic [23:0] op_lo_o,  // multiplier
    output logic [24:0] operand_o,  // product: 0 with op_start_o, then multiplicand; division: divisor
    input wire logic op_busy_i,  // 1: the result is not valid yet
    input wire logic [23:0] lo_i  // low bits of the product, or quotient
);

  localparam logic [6:0] Last = 7'd126;

  typedef enum logic [3:0] {
    StIdle,
    StFind,          // looks up the rate, adds the pulses
    StOneSide,       // adds the pulses of stages that only one side has
    StAcc,           // adds the acceleration pulses of stages that both sides have
    StDec,           // adds the deceleration pulses of stages that both sides have
    StKind,
    StDecOneSide,    // adds all pulses of the deceleration side
    StDecAll,
    StShort,         // checks whether the deceleration has too many pulses
    StBothAcc,       // adds the pulses of stages that both sides have
    StBothDec,
    StMultiply,
    StDivide,
    StSplit,         // adds the acceleration pulses of a triangular profile
    StSplitOneSide,
    StSearch         // searches for the start of the deceleration
  } state_e;

  state_e state_q;
  logic slows_q, ramp_q, run_q, next_q, done_q, wait_q, op_done, inner_q, acc_first, both, dec_some, dec_none;
  // valid_q[1] = 1: the table outputs stage `at`. in_acc_q[0], in_dec_q[0]: the side contains stage `at`;
  // in_acc_q[1], in_dec_q[1]: it contains the stage before `at`.
  logic [1:0] valid_q, in_acc_q, in_dec_q;
  // Signals of StSearch. over_none: no pulse remains. The registers follow one cycle later. below_q: `ahead`
  // is negative; begins_q: first cycle of the search; counts_q: the pulses of the stage are added.
  logic over_none, below_q, begins_q, counts_q;
  logic past, ends, step, virt, hit, hit_q, higher, counts, big, none, full, clear;
  logic [1:0][6:0] at_q;
  logic [6:0] at, at_s2_q, ge_q, ge1_q, gt1_q;
  logic [23:0] one_side_q, acc_q, one_side_kept_q, acc_kept_q, dec_kept_q, x;
  logic [24:0] sum_q, over_q;
  logic [25:0] ahead;

  assign acc_first = ppmc_pkg::less(32'(first_acc_i), 32'(first_dec_i));
  assign busy_o = state_q != StIdle;

  // ---- passes -------------------------------------------------------------------------------------

  // The table outputs stage `at`. A look-up begins one address before stage 0, because its result t(x) may be
  // this address.
  assign at = at_q[1];
  assign both = in_acc_q[0] && in_dec_q[0];
  assign step = valid_q[1];
  assign both_o = ramp_q;

  always_ff @(posedge clk_i) begin
    at_q <= {at_q[0], addr_o};
    if (run_q) addr_o <= 7'(ppmc_pkg::inc(32'(addr_o)));
    else addr_o <= (state_q == StSearch) ? first_dec_i : 7'h7f;
    if (!run_q) begin
      in_acc_q <= '0;
      in_dec_q <= '0;
    end else if (valid_q[0]) begin
      in_acc_q <= {in_acc_q[0], in_acc_q[0] || at_q[0] == first_acc_i};
      in_dec_q <= {in_dec_q[0], in_dec_q[0] || at_q[0] == first_dec_i};
    end
  end

  assign past = !ppmc_pkg::less(32'(at), 32'(ge1_q));
  assign ends = run_q && step && ((state_q == StFind) ? at == Last : past);

  // ---- look-up ------------------------------------------------------------------------------------

  assign virt = !in_acc_q[0] && !in_dec_q[0] && (at_q[0] == first_acc_i || at_q[0] == first_dec_i);
  assign hit = virt || ((in_acc_q[0] || in_dec_q[0]) && table_rate_i >= rate_i);
  assign higher = hit && (virt || table_rate_i != rate_i);

  assign target_o = '{rate: rate_i, has_decel: slows_q, ge: ge_q, ge1: ge1_q, gt1: gt1_q};

  always_ff @(posedge clk_i) begin
    if (state_q == StFind && step) begin
      if (hit) begin
        ge_q  <= at;
        ge1_q <= at_q[0];
      end
      if (higher) gt1_q <= at_q[0];
      if (in_dec_q == 2'b01) slows_q <= higher;
      if (hit && in_acc_q[1]) starts_with_accel_o <= 1'b1;
    end
    if (state_q == StIdle) starts_with_accel_o <= start_i ? 1'b0 : starts_with_accel_o;
  end

  // ---- sums ---------------------------------------------------------------------------------------

  always_ff @(posedge clk_i) begin
    hit_q <= state_q == StFind && step && hit;
    if (state_q == StIdle) begin
      one_side_q <= '0;
      acc_q <= '0;
    end else if (state_q == StFind && step) begin
      if (in_acc_q[0] != in_dec_q[0]) one_side_q <= one_side_q + (acc_first ? table_acc_i : table_dec_i);
      if (both) acc_q <= acc_q + table_acc_i;
    end
    if (hit_q) begin
      one_side_kept_q <= one_side_q;
      acc_kept_q <= acc_q;
      dec_kept_q <= sum_q[23:0];
    end
  end

  // ahead: pulses of the operation minus the pulses in sum_q
  assign ahead = {1'b0, count_i[24:0]} - {1'b0, sum_q};
  assign big = count_i[31:25] != '0;
  assign full = big || !ahead[25];
  assign none = !big && (ahead[25] || ahead[24:0] == '0);
  assign over_none = !big && (below_q || over_q == '0);

  always_comb begin
    // The first pass adds the deceleration pulses only of stages that both sides have.
    counts = step && ((state_q == StFind) ? both : !past);
    unique case (state_q)
      StOneSide:                  x = one_side_kept_q;
      StDecOneSide:               x = acc_first ? '0 : one_side_kept_q;
      StSplitOneSide:             x = acc_first ? one_side_kept_q : '0;
      StAcc, StBothAcc:           x = acc_kept_q;
      StDec, StDecAll, StBothDec: x = dec_kept_q;
      StSplit:                    x = lo_i;
      default:                    x = counts ? table_dec_i : '0;
    endcase
    clear = state_q inside {StIdle, StKind, StShort} || (state_q == StFind && done_q) ||
        (state_q == StDivide && op_done);
  end

  // dec_some: dec_pulses_o is loaded. In the first cycle of the search for the start of the deceleration
  // (begins_q), the new value is the number of pulses that remain for the deceleration. Otherwise it is the
  // number of pulses of the complete deceleration. dec_none: dec_pulses_o is cleared.
  assign dec_some = state_q == StShort || begins_q;
  assign dec_none = state_q == StKind || (state_q == StIdle && start_i && !ramp_i) || (begins_q && over_none);

  always_ff @(posedge clk_i) begin
    if (clear) sum_q <= '0;
    else if (!(state_q inside {StMultiply, StDivide})) sum_q <= sum_q + 25'(x);
    if (state_q inside {StAcc, StSearch}) {below_q, over_q} <= ahead;
    begins_q <= state_q == StSearch && next_q;
    counts_q <= state_q == StSearch && counts;
    at_s2_q  <= at;
    // The deceleration begins at the last stage at which pulses remain.
    if (counts_q && !over_none) begin
      decel_start_o.stage  <= at_s2_q;
      decel_start_o.pulses <= over_q[23:0];
    end
    if (state_q == StShort) begin
      decel_start_o.stage <= ge_q;
      decel_start_o.is_partial <= 1'b0;
    end
    if (state_q == StSearch) decel_start_o.is_partial <= 1'b1;
    if (dec_none) dec_pulses_o <= '0;
    else if (dec_some) dec_pulses_o <= begins_q ? over_q[23:0] : sum_q[23:0];
  end

  // ---- arithmetic ---------------------------------------------------------------------------------

  assign op_start_o = !wait_q && state_q inside {StMultiply, StDivide};
  assign op_mul_o = state_q == StMultiply;
  // Product: operand_o is 0 (the summand) in the cycle of op_start_o, and then over_q (the multiplicand).
  assign operand_o = (over_q & {25{op_mul_o && wait_q}}) | (sum_q & {25{!op_mul_o}});
  assign op_lo_o = acc_kept_q;
  assign op_done = wait_q && !op_busy_i;

  // ---- sequence -----------------------------------------------------------------------------------

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      state_q <= StIdle;
      run_q   <= 1'b0;
      next_q  <= 1'b0;
      done_q  <= 1'b0;
      valid_q <= '0;
      wait_q  <= 1'b0;
      ramp_q  <= 1'b0;
      inner_q <= 1'b0;
      kind_o  <= 8'h00;
    end else begin
      wait_q  <= op_start_o || (wait_q && op_busy_i);
      valid_q <= ends ? '0 : {valid_q[0], run_q};
      done_q  <= ends;
      next_q  <= 1'b0;
      if (ends) run_q <= 1'b0;
      if (next_q) run_q <= 1'b1;
      unique case (state_q)
        StIdle:
        if (start_i) begin
          ramp_q  <= ramp_i;
          kind_o  <= 8'h00;
          state_q <= StFind;
          run_q   <= 1'b1;
        end
        StFind:
        if (done_q) begin
          state_q <= (!ramp_q || endless_i) ? StIdle : starts_with_accel_o ? StOneSide : StDecOneSide;
          if (ramp_q && !endless_i && !starts_with_accel_o) kind_o <= 8'h20;
        end
        StOneSide:    state_q <= StAcc;
        StAcc: begin
          inner_q <= none;  // the motion uses only stages that one side has
          state_q <= StDec;
        end
        StDec:        state_q <= StKind;
        StKind: begin
          state_q <= full ? StDecOneSide : StBothAcc;
          if (!full) kind_o <= 8'h10;
          if (!full && inner_q) begin
            kind_o  <= acc_first ? 8'h40 : 8'h20;
            state_q <= acc_first ? StIdle : StSearch;
            next_q  <= !acc_first;
          end
        end
        StDecOneSide: state_q <= StDecAll;
        StDecAll:     state_q <= StShort;
        StShort: begin
          state_q <= full ? StIdle : StSearch;
          next_q  <= !full;
        end
        StBothAcc:    state_q <= StBothDec;
        StBothDec:    state_q <= StMultiply;
        StMultiply:   if (op_done) state_q <= StDivide;
        StDivide:     if (op_done) state_q <= StSplit;
        StSplit:      state_q <= StSplitOneSide;
        StSplitOneSide: begin
          state_q <= StSearch;
          next_q  <= 1'b1;
        end
        default:      if (done_q) state_q <= StIdle;
      endcase
    end
  end

endmodule

`default_nettype wire
