// SPDX-License-Identifier: Apache-2.0
// ppmc_bank_engine: pipeline that serves one axis a cycle: reads its state, decides, writes it back.
// Rules:  BANK-GEN-01, BANK-GEN-05, BANK-INI-01/02; the others in ppmc_bank_plan and ppmc_bank_update.
// Timing: seven cycles from the address of an axis to the edge of its visit; a new axis enters each cycle:
//         0 address    1 RAM    2 compare    3 plan    4 step    5 write; order_o is loaded
//         6 the order is valid in the cell: first cycle at whose end an edge can be ordered
//         The rate is read two cycles earlier, because the address of a threshold contains the rate.
`default_nettype none

module ppmc_bank_engine
  import ppmc_bank_pkg::*;
  import ppmc_code_pkg::error_e;
  import ppmc_code_pkg::decoded_t;
  import ppmc_code_pkg::init_code_t;
#(
    parameter int unsigned Quantum   = 25,    // quantum in cycles
    parameter int unsigned TimeBits  = 18,    // bits of an interval in cycles
    parameter bit          PhaseIdle = 1'b1,
    parameter int unsigned RoundBits = 5
) (
    input wire logic clk_i,
    input wire logic rst_ni,
    input wire logic [5:0][RoundBits-1:0] axis_i,  // axis of the visit in stage 0, 1 …
    input wire logic [4:3] clear_i,  // the visits in stages 3 and 4 reset their axes
    // from the window
    input wire mail_t mail_i,  // stage 1: input buffer
    input wire progress_t progress_i,  // stage 1: bytes of the answer that were read
    input wire logic [1:0] config_ni,  // stage 1: vsel and csel, inverted
    input wire logic go_i,  // stage 2: GO is active
    input wire logic [TimeBits-1:0] due_i,  // W minus the cycles since GO
    // from cells and switches
    input wire seen_t seen_i,  // stage 2: pin cell and switches
    // results of a visit, stage 5
    output status_t status_o,  // status register
    output logic [31:0] position_o,  // position
    output logic answer_we_o,  // write answer_o
    output answer_t answer_o,  // answer to a read command
    output order_t order_o,  // order to the pin cell
    output logic [RoundBits-1:0] at_o,  // cycle of order_o in the round
    output logic call_o,  // set the pending interrupt of the axis
    output logic calm_o  // clear the pending interrupt of the axis
);

  localparam int unsigned Round = 1 << RoundBits;
  localparam int unsigned HoldRounds = (136_000 * Quantum + Round - 1) / Round;
  localparam int unsigned HoldBits = $clog2(HoldRounds);
  localparam int unsigned StepBits = ppmc104_pkg::STEP_BITS;

  // Small FPGAs have few block RAMs. With few axes, the memory with the fewest bits is therefore built from
  // logic. Only an attribute uses this parameter, and simulation ignores attributes.
  // verilator lint_off UNUSEDPARAM
  localparam string PaceStyle = (Round > 8) ? "block" : "logic";
  // verilator lint_on UNUSEDPARAM

  typedef logic [RoundBits-1:0] axis_t;

  // ---- memories ------------------------------------------------------------------------------------

  // early_t: state that the comparisons need; late_t: state that only later stages need.
  typedef struct packed {
    logic [TimeBits-1:0] rem;      // cycles to the awaited edge
    walk_t               walk;
    setting_t            setting;
    command_t            command;
  } early_t;

  typedef struct packed {
    rest_t               rest;
    logic [HoldBits-1:0] left;
    logic [31:0]         position;
  } late_t;

  (* ram_style = "block", no_rw_check *)early_t earlies[Round];
  (* ram_style = "block", no_rw_check *)late_t  lates  [Round];
  (* ram_style = PaceStyle, no_rw_check *)pace_t  paces  [Round];
  // These words are written when a byte sets them, not by each visit, so a visit does not carry them through.
  (* ram_style = "block", no_rw_check *)words_t words  [Round];
  (* ram_style = "block", no_rw_check *)ramp_t  ramps  [Round];
  (* ram_style = "block", no_rw_check *)units_t chops  [Round];

  initial
    for (int unsigned i = 0; i < Round; i++) begin
      earlies[i] = '0;
      lates[i]   = '0;
      paces[i]   = '0;
      words[i]   = '0;
      ramps[i]   = '0;
      chops[i]   = '0;
    end

  words_t words1_q, words2_q, words3_q;
  ramp_t ramp1_q, ramp2_q, ramp3_q, ramp4_q;
  units_t units3_q, units4_q;
  early_t early1_q, early2_q, early3_q, early4_q, early, early5_q;
  late_t late2_q, late3_q, late4_q, late, late5_q;
  pace_t pace_r_q, pace0_q, pace1_q, pace2_q, pace3_q, pace4_q, pace, pace5_q;
  logic [7:0] probe0_q;
  logic [StepBits-1:0] threshold;
  logic [TimeBits-1:0] after, after3_q;

  always_ff @(posedge clk_i) begin
    pace_r_q <= paces[axis_i[0]+axis_t'(2)];
    early1_q <= earlies[axis_i[0]];
    late2_q <= lates[axis_i[1]];
    earlies[axis_i[5]] <= early5_q;
    lates[axis_i[5]] <= late5_q;
    paces[axis_i[5]] <= pace5_q;
    words1_q <= words[axis_i[0]];
    ramp1_q <= ramps[axis_i[0]];
    units3_q <= chops[axis_i[2]];
    // pace0_q.down = 1 (deceleration): the threshold of the next slower rate is compared.
    pace0_q <= pace_r_q;
    probe0_q <= pace_r_q.rate + 8'(pace_r_q.down);
    pace1_q <= pace0_q;
    pace2_q <= pace1_q;
    {early2_q, words2_q, ramp2_q} <= {early1_q, words1_q, ramp1_q};
    late3_q <= late2_q;
  end

  ppmc_bank_interval_rom #(
      .Quantum (Quantum),
      .Round   (Round),
      .TimeBits(TimeBits)
  ) u_times (
      .clk_i,
      .pace_i(pace0_q),
      .rest_o(after)
  );

  // ---- stage 2: comparisons ------------------------------------------------------------------------

  mail_t mail2_q, mail3_q;
  progress_t progress2_q, progress3_q, progress4_q;
  logic unused_bits;
  logic [1:0] config2_q, config3_q, config4_q;
  seen_t seen3_q, seen4_q;
  facts_t facts3_q;
  logic new3_q, reached, moves, booked;
  axis_t booked_for;
  decoded_t decoded3_q;
  error_e value3_q;
  logic [TimeBits-1:0] due3_q;
  walk_t walk2;

  assign unused_bits = &{1'b0, early4_q, ramp4_q, progress4_q, walk2};
  assign walk2 = early2_q.walk;
  assign reached = {walk2.climb[StepBits-1:0], !pace2_q.down} >= {threshold, pace2_q.down};
  assign moves = walk2.busy && walk2.op inside {ppmc_op_pkg::OP_ACC_DEC, ppmc_op_pkg::OP_CONT_HIGH};

  always_ff @(posedge clk_i) begin
    {mail2_q, progress2_q, config2_q} <= {mail_i, progress_i, config_ni};
    {mail3_q, progress3_q, config3_q} <= {mail2_q, progress2_q, config2_q};
    {early3_q, pace3_q, after3_q} <= {early2_q, pace2_q, after};
    {words3_q, ramp3_q} <= {words2_q, ramp2_q};
    seen3_q <= seen_i;
    due3_q <= due_i;
    new3_q <= mail2_q.seq != early2_q.command.taken;
    decoded3_q <= decode(mail2_q.data);
    value3_q <= ppmc104_pkg::judge({mail2_q.data, words2_q.params});
    facts3_q.fire <= early2_q.rem[TimeBits-1:RoundBits] == '0;
    if (pace2_q.down)
      facts3_q.more <= moves && (walk2.run || (walk2.low && !walk2.last)) && !reached
                                       && pace2_q.rate != ramp2_q.slow;
    else
      facts3_q.more <= moves && walk2.run && !walk2.low && !walk2.held && reached
                                         && pace2_q.rate != ramp2_q.fast;
    facts3_q.zero  <= walk2.slack == '0;
    facts3_q.minus <= walk2.slack[24];
    facts3_q.foot  <= walk2.climb[14:1] == '0;
    facts3_q.full  <= walk2.climb[StepBits-1:0] == ramp2_q.steps + 1'b1;
    facts3_q.go    <= go_i;
    facts3_q.built <= !(booked && booked_for == axis_i[2]);
  end

  // ---- stage 3: plan -------------------------------------------------------------------------------

  plan_t plan, plan4_q;
  logic take, take4_q, anew, anew4_q;
  logic [7:0] code, code4_q;
  logic [31:0] params, params4_q;
  logic [TimeBits-1:0] add, add4_q;
  ppmc_code_pkg::asking_t asking, asking3;
  command_t command3, command4_q;

  assign command3 = early3_q.command;
  assign asking3 = '{
          error: command3.error,
          number: command3.number,
          code: words3_q.code,
          params: {words3_q.params, 8'd0}
      };

  ppmc_bank_plan #(
      .Quantum (Quantum),
      .Round   (Round),
      .TimeBits(TimeBits)
  ) u_plan (
      .walk_i   (early3_q.walk),
      .pace_i   (pace3_q),
      .setting_i(early3_q.setting),
      .rest_i   (late3_q.rest),
      .over_i   (late3_q.left == '0),
      .seen_i   (seen3_q),
      .facts_i  (facts3_q),
      .free_i   (!booked),
      .extra_i  (config3_q[1]),
      .mail_i   (mail3_q),
      .new_i    (new3_q),
      .decoded_i(decoded3_q),
      .value_i  (value3_q),
      .asking_i (asking3),
      .asking_o (asking),
      .take_o   (take),
      .code_o   (code),
      .params_o (params),
      .due_i    (due3_q),
      .after_i  (after3_q),
      .plan_o   (plan),
      .anew_o   (anew),
      .add_o    (add)
  );

  ppmc_bank_tables #(
      .AxisBits(RoundBits),
      .StepBits(StepBits)
  ) u_tables (
      .clk_i,
      .rst_ni,
      .book_i     (plan.init && !clear_i[3]),
      .book_axis_i(axis_i[3]),
      .slow_i     (params[7:0]),
      .fast_i     (params[15:8]),
      .steps_i    (params[16+:StepBits]),
      .booked_o   (booked),
      .for_o      (booked_for),
      .axis_i     (axis_i[0]),
      .rate_i     (probe0_q),
      .threshold_o(threshold)
  );

  always_ff @(posedge clk_i) begin
    {early4_q, pace4_q, late4_q, seen4_q} <= {early3_q, pace3_q, late3_q, seen3_q};
    {progress4_q, config4_q} <= {progress3_q, config3_q};
    {plan4_q, code4_q, params4_q, anew4_q, add4_q} <= {clear_i[3] ? '0 : plan, code, params, anew, add};
    {take4_q, ramp4_q, units4_q} <= {take, ramp3_q, units3_q};
    command4_q <= '{
        taken: take ? mail3_q.seq : command3.taken,
        error: asking.error,
        number: asking.number
    };
  end

  // ---- stage 4: step -------------------------------------------------------------------------------

  order_t  order;
  answer_t answer;
  logic call, calm;
  init_code_t init;
  logic unused_words;

  assign init = init_code_t'(code4_q);
  assign unused_words = ^{init, asking};

  ppmc_bank_update #(
      .HoldRounds(HoldRounds),
      .HoldBits  (HoldBits)
  ) u_step (
      .plan_i    (plan4_q),
      .seen_i    (seen4_q),
      .code_i    (code4_q),
      .params_i  (params4_q),
      .config_ni (config4_q),
      .read_seq_i(progress4_q.seq),
      .walk_i    (early4_q.walk),
      .pace_i    (pace4_q),
      .setting_i (early4_q.setting),
      .units_i   (units4_q),
      .chop_i    (ramp4_q.chop),
      .slow_i    (ramp4_q.slow),
      .rest_i    (late4_q.rest),
      .left_i    (late4_q.left),
      .position_i(late4_q.position),
      .walk_o    (early.walk),
      .pace_o    (pace),
      .setting_o (early.setting),
      .rest_o    (late.rest),
      .left_o    (late.left),
      .position_o(late.position),
      .order_o   (order),
      .answer_o  (answer),
      .call_o    (call),
      .calm_o    (calm)
  );

  assign early.rem = (anew4_q ? '0 : early4_q.rem) + add4_q;
  assign early.command = command4_q;

  always_ff @(posedge clk_i) begin
    if (take4_q) words[axis_i[4]] <= '{code: code4_q, params: params4_q[31:8]};
    if (plan4_q.init)
      ramps[axis_i[4]] <= '{
          chop: init.chop,
          slow: params4_q[7:0],
          fast: params4_q[15:8],
          steps: params4_q[16+:StepBits]
      };
    if (plan4_q.switching) chops[axis_i[4]] <= params4_q[31:16];
  end

  // ---- stage 5: write, order -----------------------------------------------------------------------

  localparam early_t EarlyReset = '0;
  localparam late_t LateReset = '{
      rest: '{hold: 1'b1, on: 1'b1, pair: 1'b1, positive: !PhaseIdle, default: '0},
      left: '0,
      position: '0
  };

  always_ff @(posedge clk_i) begin
    early5_q    <= clear_i[4] ? EarlyReset : early;
    late5_q     <= clear_i[4] ? LateReset : late;
    pace5_q     <= clear_i[4] ? '0 : pace;
    answer_o    <= clear_i[4] ? '0 : answer;
    answer_we_o <= clear_i[4] || plan4_q.read;
    order_o     <= clear_i[4] ? '0 : order;
    // The order is executed immediately, or rem cycles after the first cycle in which an edge can be ordered.
    at_o        <= axis_i[0] + axis_t'(2) + (order.sets && !plan4_q.toggle ? '0 : axis_t'(early4_q.rem));
    call_o      <= call && !clear_i[4];
    calm_o      <= calm && !clear_i[4];
  end

  assign status_o = '{
          taken: early5_q.command.taken,
          error: early5_q.command.error,
          number: early5_q.command.number,
          busy: early5_q.walk.busy
      };
  assign position_o = late5_q.position;

endmodule

`default_nettype wire
