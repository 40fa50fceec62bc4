// SPDX-License-Identifier: Apache-2.0
// ppmc312_stage_builder: fills the stage table. Computes it from the start-up, stop and high-speed rates, and
//         from the pulses of the acceleration side and the deceleration side.
// Rules:  P312-TBL-01..06, P312-CMD-00 (0x05).
// Timing: busy_o rises at the edge that ends the cycle of start_i. It falls when the table and its
//         description are complete, after at most 127 * 300 cycles.
// Assumes: curve_i is stable while busy_o = 1.
// How:    the speed of stage i is D_i = K*RH + (Rs-RH)*W_i. W_i is the weight of the stage, K is the weight
//         of the last stage, RH is the high-speed rate, and Rs is the larger of start_rate and stop_rate.
//         The first pass computes the rates R[i] = C/D_i, rounded, with C = K*Rs*RH. It also finds the first
//         stage of each side, and S, the sum of the D_i of each side. The second pass divides
//         (P*D_i + remainder of the previous stage) by S, where P is the number of pulses of the side. The
//         quotient is the number of pulses of stage i. The multiplier computes all products and sums as
//         summand + operand * multiplier (ppmc312_muldiv). A small RAM stores the intermediate values.
`include "ppmc_assert.svh"
`default_nettype none

module ppmc312_stage_builder
  import ppmc312_stage_pkg::*;
(
    input wire logic clk_i,  // clock
    input wire logic rst_ni,  // reset, asynchronous
    input wire logic start_i,  // strobe: start to build the table
    input wire curve_t curve_i,  // ramp; stable while busy_o = 1
    output logic busy_o,  // from the cycle after start_i until the table is written
    output logic too_few_pulses_o,  // a stage has at most 1 pulse; valid until the next start
    output table_write_t table_write_o,  // write port of the table
    output logic [1:0] begins_o,  // strobes: a side may begin at this stage; the last strobe is valid
    input wire logic [6:0] first_acc_i,  // stage of the last strobe of begins_o[0], 0 .. 126
    input wire logic [6:0] first_dec_i,  // stage of the last strobe of begins_o[1], 0 .. 126
    // arithmetic, shared with the planner
    output logic op_start_o,  // strobe: start an operation
    output logic op_mul_o,  // 1: multiply, 0: divide
    output logic [5:0] op_steps_o,  // 1 .. 24
    output logic [23:0] op_lo_o,  // multiplication: multiplier; division: low part of the dividend
    output logic [39:0] word_o,  // with op_start_o: summand or upper dividend; then the operand
    input wire logic op_busy_i,  // 1: the result is not valid yet
    input wire logic [39:0] hi_i,  // multiplication: high bits of the result; division: remainder
    input wire logic [23:0] lo_i  // multiplication: low bits of the result; division: quotient
);

  localparam logic [6:0] Last = 7'd126;

  typedef enum logic [3:0] {
    StIdle,
    StCopy,    // writes RH, Rs, Rs - RH into the RAM
    StBase,    // K * RH; K is the weight of the last stage
    StScale,   // K * Rs
    StSpeed,   // D
    StHalf,    // D / 2
    StCurve,   // C + D / 2
    StRate,    // R = (C + D / 2) / D
    StBegin,   // checks whether a side begins at this stage
    StSum,     // S + D; S: sum of D
    StProportion,   // P * D + remainder; P: pulses of the side
    StPulses,  // divides the result of StProportion by S
    StWrite,
    StNext
  } state_e;

  typedef enum logic [3:0] {
    WordHigh,
    WordSlowest,
    WordDiff,
    WordBase,
    WordScale,
    WordSpeed,
    WordHalf,
    WordZero,    // never written
    WordSum,     // sum S of the acceleration side
    WordSumDec,
    WordRemainder,
    WordRemainderDec
  } word_e;

  state_e state_q;
  logic pass_q, side_q, wait_q, works, done, last_side, we;
  logic [1:0] phase_q, hit_q, open_q;
  word_e h_word, x_word, to_word;
  logic [6:0] stage_q;
  logic [1:0][6:0] first;
  logic [16:0] weight;
  logic [15:0] slowest_q, diff_q, rate, limit, copy_value;
  logic [39:0] result;
  logic hit, opens;

  ppmc312_cosine_rom u_rom (
      .clk_i,
      .linear_i(!curve_i.cosine),
      .index_i (stage_q),
      .weight_o(weight)
  );

  assign rate = lo_i[15:0];
  assign limit = side_q ? curve_i.stop_rate : curve_i.start_rate;
  // All stages belong to the slower side, even if the rounding of R[1] makes it equal to R[0].
  assign hit = (limit == slowest_q) ? stage_q == '0 : rate >= limit;
  assign opens = stage_q == first[side_q];
  assign last_side = side_q || !curve_i.split;

  assign busy_o = state_q != StIdle;
  assign first = {first_dec_i, first_acc_i};
  assign begins_o = {side_q, !side_q} & {2{state_q == StBegin && hit}};

  // ---- operation of a state: read the summand, read the operand, start ----------------------------

  assign works = state_q inside {StBase, StScale, StSpeed, StHalf, StCurve, StRate, StSum,
                                  StProportion, StPulses};
  assign done = wait_q && !op_busy_i;
  assign op_mul_o = !(state_q inside {StRate, StPulses});

  always_comb begin
    op_steps_o = 6'd24;
    h_word     = WordBase;
    x_word     = WordSpeed;
    to_word    = WordSpeed;
    // While the builder is idle, word_o must be 0, because it is ORed with the operand of the planner.
    if (state_q inside {StIdle, StBase, StScale}) h_word = WordZero;
    unique case (state_q)
      StBase: begin
        x_word  = WordHigh;
        to_word = WordBase;
      end
      StScale: begin
        x_word  = WordSlowest;
        to_word = WordScale;
      end
      StSpeed: x_word = WordDiff;
      StHalf: begin
        h_word     = WordSpeed;
        op_steps_o = 6'd1;
        to_word    = WordHalf;
      end
      StCurve: begin
        h_word     = WordHalf;
        x_word     = WordScale;
        op_steps_o = 6'd16;
      end
      StRate:  op_steps_o = 6'd16;
      StSum: begin
        to_word = side_q ? WordSumDec : WordSum;
        h_word  = hit_q[side_q] ? WordZero : to_word;
      end
      StProportion: begin
        h_word = opens ? WordZero : side_q ? WordRemainderDec : WordRemainder;
      end
      StPulses: begin
        x_word  = side_q ? WordSumDec : WordSum;
        to_word = side_q ? WordRemainderDec : WordRemainder;
      end
      default: to_word = word_e'({2'b00, phase_q});
    endcase
    unique case (state_q)
      StHalf: op_lo_o = '0;
      StCurve: op_lo_o = 24'(curve_i.high_rate);
      StSum: op_lo_o = 24'd1;
      StProportion: op_lo_o = side_q ? curve_i.dec : curve_i.acc;
      default: op_lo_o = 24'(weight);
    endcase
    unique case (phase_q)
      2'd0:    copy_value = curve_i.high_rate;
      2'd1:    copy_value = slowest_q;
      default: copy_value = diff_q;
    endcase
    unique case (state_q)
      StCopy:           result = 40'(copy_value);
      StHalf, StPulses: result = hi_i;
      default:          result = {hi_i[15:0], lo_i};
    endcase
    we = state_q == StCopy || (done && !(state_q inside {StCurve, StRate, StProportion}));
  end

  ppmc_ram #(
      .Width   (40),
      .AddrBits(4)
  ) u_words (
      .clk_i,
      .we_i   (we),
      .waddr_i(to_word),
      .wdata_i(result),
      .raddr_i((phase_q == 2'd0 && !wait_q && op_mul_o) ? h_word : x_word),
      .rdata_o(word_o)
  );

  // ---- sequence -----------------------------------------------------------------------------------

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      state_q <= StIdle;
      phase_q <= '0;
      op_start_o <= 1'b0;
      wait_q <= 1'b0;
      pass_q <= 1'b0;
      side_q <= 1'b0;
      stage_q <= Last;
      too_few_pulses_o <= 1'b0;
    end else begin
      op_start_o <= works && phase_q == 2'd1;  // high in the first cycle of phase 2
      if (op_start_o) wait_q <= 1'b1;
      else if (done) wait_q <= 1'b0;
      if (op_start_o || done || !(works || state_q == StCopy)) phase_q <= '0;
      else if (!wait_q) phase_q <= phase_q + 1'b1;
      unique case (state_q)
        StIdle: begin
          pass_q  <= 1'b0;
          side_q  <= 1'b0;
          stage_q <= Last;
          if (start_i) begin
            too_few_pulses_o <= 1'b0;
            state_q <= StCopy;
          end
        end
        StCopy:
        if (phase_q == 2'd2) begin
          phase_q <= '0;
          state_q <= StBase;
        end
        StBase: if (done) state_q <= StScale;
        StScale:
        if (done) begin
          stage_q <= '0;
          state_q <= StSpeed;
        end
        StSpeed:
        if (done) state_q <= !pass_q ? StHalf : open_q[0] ? StProportion : curve_i.split ? StWrite : StNext;
        StHalf: if (done) state_q <= StCurve;
        StCurve: if (done) state_q <= StRate;
        StRate: if (done) state_q <= StBegin;
        StBegin: begin
          side_q <= !side_q;
          if (side_q) state_q <= StSum;
        end
        StSum:
        if (done) begin
          side_q  <= !last_side;
          state_q <= last_side ? StNext : StSum;
        end
        StProportion: if (done) state_q <= StPulses;
        StPulses: if (done) state_q <= StWrite;
        StWrite: begin
          if (open_q[side_q] && lo_i[23:1] == '0) too_few_pulses_o <= 1'b1;
          side_q  <= !last_side;
          state_q <= last_side ? StNext : open_q[1] ? StProportion : StNext;
          if (!last_side && !open_q[1]) side_q <= 1'b0;
        end
        StNext: begin
          stage_q <= 7'(ppmc_pkg::inc(32'(stage_q)));
          state_q <= StSpeed;
          if (stage_q == Last) begin
            stage_q <= '0;
            pass_q  <= 1'b1;
            state_q <= pass_q ? StIdle : StSpeed;
          end
        end
        default: state_q <= StIdle;
      endcase
    end
  end

  // No reset: these registers are written before use. The rates are stable long before use.
  always_ff @(posedge clk_i) begin
    slowest_q <= (curve_i.start_rate > curve_i.stop_rate) ? curve_i.start_rate : curve_i.stop_rate;
    diff_q <= slowest_q - curve_i.high_rate;
    if (state_q == StBegin) hit_q[side_q] <= hit;
    // open_q: the sides that have begun in the second pass
    for (int unsigned n = 0; n < 2; n++) begin
      if (!pass_q) open_q[n] <= 1'b0;
      else if (stage_q == first[n]) open_q[n] <= 1'b1;
    end
  end

  assign table_write_o = '{
          we_rate: state_q == StBegin && !side_q,
          we_acc: state_q == StWrite && !side_q && open_q[0],
          we_dec: state_q == StWrite && side_q,
          stage: stage_q,
          data: lo_i
      };

  logic unused_base;
  assign unused_base = &{1'b0, curve_i};

`ifndef SYNTHESIS
  `PPMC_ASSERT(p312_tbl_02_ends, !table_write_o.we_rate || stage_q != '0 || rate == slowest_q)
  `PPMC_ASSERT(p312_tbl_02_top, !table_write_o.we_rate || stage_q != Last || rate == curve_i.high_rate)
`endif

endmodule

`default_nettype wire
