// SPDX-License-Identifier: Apache-2.0
// ppmc_bank_engine: pipeline that begins a visit of another axis in each cycle. A visit reads the state of
//         one axis, makes decisions, and writes the state back. In a round, each axis is visited once.
// Rules:  BANK-GEN-01, BANK-GEN-05, BANK-INI-01/02; see also ppmc_bank_plan and ppmc_bank_update.
// Timing: a visit takes seven cycles, one per stage: 0 address, 1 RAM, 2 compare, 3 plan, 4 update, 5 write
//         and load of pin_cmd_o into the pin block, 6 command valid in the pin block. The pins can change at
//         the end of stage 6. The interval is read two cycles before state_s1_t, because the address of a
//         threshold (ppmc_bank_tables) contains the rate of the interval.
`default_nettype none

module ppmc_bank_engine
  import ppmc_bank_pkg::*;
  import ppmc_code_pkg::cmd_error_e;
  import ppmc_code_pkg::decoded_t;
  import ppmc_code_pkg::init_code_t;
#(
    parameter int unsigned Quantum   = 25,    // quantum (4 crystal cycles) in clock cycles
    parameter int unsigned TimeBits  = 18,    // width of interval values, which are numbers of cycles
    parameter bit          PhaseIdle = 1'b1,  // level of s before the first initialisation
    parameter int unsigned RoundBits = 5      // a round is 2^RoundBits cycles
) (
    input wire logic clk_i,
    input wire logic rst_ni,
    input wire logic [5:0][RoundBits-1:0] axis_i,  // axes in stages 0 to 5
    input wire logic [4:3] clear_i,  // [i] = 1: reset the axis in stage i
    // from the window
    input wire in_buf_t in_buf_i,  // stage 1: input buffer
    input wire read_progress_t read_progress_i,  // stage 1: response bytes that the host has read
    input wire logic [1:0] config_ni,  // stage 1: vsel and csel, inverted
    input wire logic go_i,  // stage 2: GO is active
    input wire logic [RoundBits-1:0] go_left_i,  // stage 2: further cycles for which go_i remains high
    // from pin blocks and switches
    input wire pin_status_t pin_status_i,  // stage 2: pin block and switches
    // results of a visit, stage 5
    output axis_status_t status_o,  // status register
    output logic [31:0] position_o,  // position
    output logic read_data_we_o,  // strobe: write read_data_o
    output read_data_t read_data_o,  // response to a read command
    output pin_cmd_t pin_cmd_o,  // command to the pin block
    output logic [RoundBits-1:0] at_cycle_o,  // cycle of the round in which the pin block executes pin_cmd_o
    output logic irq_pending_o  // 1: the axis has a pending interrupt
);

  localparam int unsigned Round = 1 << RoundBits;
  localparam int unsigned HoldRounds = (136_000 * Quantum + Round - 1) / Round;
  localparam int unsigned HoldBits = $clog2(HoldRounds);
  localparam int unsigned StepBits = ppmc104_pkg::STEP_BITS;

  // Small FPGAs have few block RAMs. With up to 8 axes, the smallest memory therefore consists of logic.
  // verilator lint_off UNUSEDPARAM
  localparam string IntervalStyle = (Round > 8) ? "block" : "logic";
  // verilator lint_on UNUSEDPARAM

  typedef logic [RoundBits-1:0] axis_t;

  // ---- memories ------------------------------------------------------------------------------------
  // The comparisons of stage 2 use state_s1_t, so it is read in stage 1. state_s2_t is read in stage 2.
  typedef struct packed {
    logic [TimeBits-1:0] cycles_left;  // cycles until the awaited edge
    motion_state_t       motion;
    init_state_t         init_state;
    parser_t             parser;
  } state_s1_t;

  typedef struct packed {
    output_state_t       outputs;
    logic [HoldBits-1:0] hold_left;  // remaining rounds of the hold time, minus 1
    logic [31:0]         position;   // CW pulses minus CCW pulses
  } state_s2_t;

  (* ram_style = "block", no_rw_check *) state_s1_t state1_mem[Round];
  (* ram_style = "block", no_rw_check *) state_s2_t state2_mem[Round];
  (* ram_style = IntervalStyle, no_rw_check *) interval_t interval_mem[Round];
  // A visit writes these words only when it accepts a byte, so only some stages have registers for them.
  (* ram_style = "block", no_rw_check *) last_cmd_t last_cmd_mem[Round];
  (* ram_style = "block", no_rw_check *) ramp_t ramp_mem[Round];
  (* ram_style = "block", no_rw_check *) chop_units_t chop_units_mem[Round];

  initial
    for (int unsigned i = 0; i < Round; i++) begin
      state1_mem[i] = '0;
      state2_mem[i] = '0;
      interval_mem[i] = '0;
      last_cmd_mem[i] = '0;
      ramp_mem[i] = '0;
      chop_units_mem[i] = '0;
    end

  last_cmd_t last_cmd_s1_q, last_cmd_s2_q, last_cmd_s3_q;
  ramp_t ramp_s1_q, ramp_s2_q, ramp_s3_q, ramp_s4_q;
  chop_units_t chop_units_s3_q, chop_units_s4_q;
  state_s1_t state1_s1_q, state1_s2_q, state1_s3_q, state1_s4_q, state1_d, state1_s5_q;
  state_s2_t state2_s2_q, state2_s3_q, state2_s4_q, state2_d, state2_s5_q;
  interval_t interval_pre_q, interval_s0_q, interval_s1_q, interval_s2_q, interval_s3_q, interval_s4_q;
  interval_t interval_d, interval_s5_q;
  logic [StepBits-1:0] threshold;
  logic [TimeBits-1:0] after_low, after_low_s3_q;

  always_ff @(posedge clk_i) begin
    interval_pre_q <= interval_mem[axis_i[0]+axis_t'(2)];
    state1_s1_q <= state1_mem[axis_i[0]];
    state2_s2_q <= state2_mem[axis_i[1]];
    state1_mem[axis_i[5]] <= state1_s5_q;
    state2_mem[axis_i[5]] <= state2_s5_q;
    interval_mem[axis_i[5]] <= interval_s5_q;
    last_cmd_s1_q <= last_cmd_mem[axis_i[0]];
    ramp_s1_q <= ramp_mem[axis_i[0]];
    chop_units_s3_q <= chop_units_mem[axis_i[2]];
    interval_s0_q <= interval_pre_q;
    interval_s1_q <= interval_s0_q;
    interval_s2_q <= interval_s1_q;
    {state1_s2_q, last_cmd_s2_q, ramp_s2_q} <= {state1_s1_q, last_cmd_s1_q, ramp_s1_q};
    state2_s3_q <= state2_s2_q;
  end

  ppmc_bank_interval_rom #(
      .Quantum (Quantum),
      .Round   (Round),
      .TimeBits(TimeBits)
  ) u_interval_rom (
      .clk_i,
      .interval_i (interval_s0_q),
      .after_low_o(after_low)
  );

  // ---- stage 2: comparisons ------------------------------------------------------------------------

  in_buf_t in_buf_s2_q, in_buf_s3_q;
  read_progress_t read_progress_s2_q, read_progress_s3_q, read_progress_s4_q;
  logic unused_bits;
  logic [1:0] config_n_s2_q, config_n_s3_q, config_n_s4_q;
  pin_status_t pin_status_s3_q, pin_status_s4_q;
  compare_t compare_s3_q;
  logic in_buf_new_s3_q, threshold_reached, ramp_motion, build_busy;
  axis_t build_axis;
  decoded_t decoded_s3_q;
  cmd_error_e param_error_s3_q;
  logic [RoundBits-1:0] go_left_s3_q;
  motion_state_t motion_s2;

  assign unused_bits = &{1'b0, state1_s4_q, ramp_s4_q, read_progress_s4_q, motion_s2};
  assign motion_s2 = state1_s2_q.motion;
  assign threshold_reached =
      {motion_s2.ramp_level[StepBits-1:0], !interval_s2_q.decel} >= {threshold, interval_s2_q.decel};
  assign ramp_motion =
      motion_s2.busy && motion_s2.op inside {ppmc_op_pkg::OP_ACC_DEC, ppmc_op_pkg::OP_CONT_HIGH};

  always_ff @(posedge clk_i) begin
    {in_buf_s2_q, read_progress_s2_q, config_n_s2_q} <= {in_buf_i, read_progress_i, config_ni};
    {in_buf_s3_q, read_progress_s3_q, config_n_s3_q} <= {in_buf_s2_q, read_progress_s2_q, config_n_s2_q};
    {state1_s3_q, interval_s3_q, after_low_s3_q} <= {state1_s2_q, interval_s2_q, after_low};
    {last_cmd_s3_q, ramp_s3_q} <= {last_cmd_s2_q, ramp_s2_q};
    pin_status_s3_q <= pin_status_i;
    go_left_s3_q <= go_left_i;
    in_buf_new_s3_q <= in_buf_s2_q.seq != state1_s2_q.parser.ack_seq;
    decoded_s3_q <= decode(in_buf_s2_q.data);
    param_error_s3_q <= ppmc104_pkg::check_params({in_buf_s2_q.data, last_cmd_s2_q.params});
    compare_s3_q.edge_in_round <= state1_s2_q.cycles_left[TimeBits-1:RoundBits] == '0;
    if (interval_s2_q.decel)
      compare_s3_q.rate_mismatch <= ramp_motion
          && (motion_s2.more_pulses || (motion_s2.pulse_low && !motion_s2.last_ordered))
          && !threshold_reached && interval_s2_q.rate != ramp_s2_q.slow;
    else
      compare_s3_q.rate_mismatch <= ramp_motion && motion_s2.more_pulses && !motion_s2.pulse_low
          && !motion_s2.held && threshold_reached && interval_s2_q.rate != ramp_s2_q.fast;
    compare_s3_q.margin_zero  <= motion_s2.decel_margin == '0;
    compare_s3_q.margin_negative <= motion_s2.decel_margin[24];
    compare_s3_q.ramp_bottom  <= motion_s2.ramp_level[14:1] == '0;
    compare_s3_q.ramp_top  <= motion_s2.ramp_level[StepBits-1:0] > ramp_s2_q.steps;
    compare_s3_q.go    <= go_i;
    compare_s3_q.table_idle <= !(build_busy && build_axis == axis_i[2]);
  end

  // ---- stage 3: plan -------------------------------------------------------------------------------

  decision_t decision, decision_s4_q;
  logic take, take_s4_q, restart_time;
  logic [7:0] code, code_s4_q;
  logic [31:0] params, params_s4_q;
  logic [TimeBits-1:0] cycles_left_s4_q, add_cycles, add_cycles_s4_q;
  ppmc_code_pkg::parser_state_t parser_state, parser_state_s3;
  parser_t parser_s3, parser_s4_q;

  assign parser_s3 = state1_s3_q.parser;
  assign parser_state_s3 = '{
          error: parser_s3.error,
          number: parser_s3.number,
          code: last_cmd_s3_q.code,
          params: {last_cmd_s3_q.params, 8'd0}
      };

  ppmc_bank_plan #(
      .Quantum (Quantum),
      .Round   (Round),
      .TimeBits(TimeBits)
  ) u_plan (
      .motion_i      (state1_s3_q.motion),
      .interval_i    (interval_s3_q),
      .init_state_i  (state1_s3_q.init_state),
      .outputs_i     (state2_s3_q.outputs),
      .hold_end_i    (state2_s3_q.hold_left == '0),
      .pin_status_i  (pin_status_s3_q),
      .compare_i     (compare_s3_q),
      .builder_free_i(!build_busy),
      .extra_time_i  (config_n_s3_q[1]),
      .in_buf_i      (in_buf_s3_q),
      .in_buf_new_i  (in_buf_new_s3_q),
      .decoded_i     (decoded_s3_q),
      .param_error_i (param_error_s3_q),
      .parser_i      (parser_state_s3),
      .parser_o      (parser_state),
      .take_o        (take),
      .code_o        (code),
      .params_o      (params),
      .after_low_i   (after_low_s3_q),
      .decision_o    (decision),
      .restart_time_o(restart_time),
      .add_cycles_o  (add_cycles)
  );

  // During deceleration (decel = 1), ramp_level is compared with the threshold of the next slower rate.
  ppmc_bank_tables #(
      .AxisBits(RoundBits),
      .StepBits(StepBits)
  ) u_tables (
      .clk_i,
      .rst_ni,
      .build_start_i(decision.init && !clear_i[3]),
      .build_axis_i (axis_i[3]),
      .slow_i       (params[7:0]),
      .fast_i       (params[15:8]),
      .steps_i      (params[16+:StepBits]),
      .build_busy_o (build_busy),
      .build_axis_o (build_axis),
      .axis_i       (axis_i[0]),
      .rate_i       (interval_s0_q.rate + 8'(interval_s0_q.decel)),
      .threshold_o  (threshold)
  );

  always_ff @(posedge clk_i) begin
    {state1_s4_q, interval_s4_q, state2_s4_q, pin_status_s4_q} <= {
      state1_s3_q, interval_s3_q, state2_s3_q, pin_status_s3_q
    };
    {read_progress_s4_q, config_n_s4_q} <= {read_progress_s3_q, config_n_s3_q};
    {decision_s4_q, code_s4_q, params_s4_q, add_cycles_s4_q} <= {
      clear_i[3] ? '0 : decision, code, params, add_cycles
    };
    // With go_left_s3_q, pulse 1 after GO occurs in the same cycle for all axes.
    if (!restart_time) cycles_left_s4_q <= state1_s3_q.cycles_left;
    else cycles_left_s4_q <= decision.go_accept ? TimeBits'(go_left_s3_q) : '0;
    {take_s4_q, ramp_s4_q, chop_units_s4_q} <= {take, ramp_s3_q, chop_units_s3_q};
    parser_s4_q <= '{
        ack_seq: take ? in_buf_s3_q.seq : parser_s3.ack_seq,
        error: parser_state.error,
        number: parser_state.number
    };
  end

  // ---- stage 4: update -----------------------------------------------------------------------------

  pin_cmd_t pin_cmd;
  read_data_t read_data;
  init_code_t init;
  logic unused_words;

  assign init = init_code_t'(code_s4_q);
  assign unused_words = ^{init, parser_state};

  ppmc_bank_update #(
      .HoldRounds(HoldRounds),
      .HoldBits  (HoldBits)
  ) u_update (
      .decision_i  (decision_s4_q),
      .pin_status_i(pin_status_s4_q),
      .code_i      (code_s4_q),
      .params_i    (params_s4_q),
      .config_ni   (config_n_s4_q),
      .read_seq_i  (read_progress_s4_q.seq),
      .motion_i    (state1_s4_q.motion),
      .interval_i  (interval_s4_q),
      .init_state_i(state1_s4_q.init_state),
      .chop_units_i(chop_units_s4_q),
      .chop_i      (ramp_s4_q.chop),
      .slow_i      (ramp_s4_q.slow),
      .outputs_i   (state2_s4_q.outputs),
      .hold_left_i (state2_s4_q.hold_left),
      .position_i  (state2_s4_q.position),
      .motion_o    (state1_d.motion),
      .interval_o  (interval_d),
      .init_state_o(state1_d.init_state),
      .outputs_o   (state2_d.outputs),
      .hold_left_o (state2_d.hold_left),
      .position_o  (state2_d.position),
      .pin_cmd_o   (pin_cmd),
      .read_data_o (read_data)
  );

  assign state1_d.cycles_left = cycles_left_s4_q + add_cycles_s4_q;
  assign state1_d.parser = parser_s4_q;

  always_ff @(posedge clk_i) begin
    if (take_s4_q) last_cmd_mem[axis_i[4]] <= '{code: code_s4_q, params: params_s4_q[31:8]};
    if (decision_s4_q.init)
      ramp_mem[axis_i[4]] <= '{
          chop: init.chop,
          slow: params_s4_q[7:0],
          fast: params_s4_q[15:8],
          steps: params_s4_q[16+:StepBits]
      };
    if (decision_s4_q.switching) chop_units_mem[axis_i[4]] <= params_s4_q[31:16];
  end

  // ---- stage 5: write, command ---------------------------------------------------------------------

  localparam state_s1_t State1Reset = '0;
  localparam state_s2_t State2Reset = '{
      outputs: '{hold: 1'b1, phases_on: 1'b1, two_phases: 1'b1, positive: !PhaseIdle, default: '0},
      hold_left: '0,
      position: '0
  };

  always_ff @(posedge clk_i) begin
    state1_s5_q <= clear_i[4] ? State1Reset : state1_d;
    state2_s5_q <= clear_i[4] ? State2Reset : state2_d;
    interval_s5_q <= clear_i[4] ? '0 : interval_d;
    read_data_o <= clear_i[4] ? '0 : read_data;
    read_data_we_o <= clear_i[4] || decision_s4_q.read;
    pin_cmd_o <= clear_i[4] ? '0 : pin_cmd;
    // set_pins without chop_edge acts in the first possible cycle. Others follow cycles_left cycles later.
    at_cycle_o     <= axis_i[0] + axis_t'(2)
        + (pin_cmd.set_pins && !decision_s4_q.chop_edge ? '0 : axis_t'(state1_s4_q.cycles_left));
  end

  assign status_o = '{
          ack_seq: state1_s5_q.parser.ack_seq,
          error: state1_s5_q.parser.error,
          number: state1_s5_q.parser.number,
          busy: state1_s5_q.motion.busy
      };
  assign position_o = state2_s5_q.position;
  assign irq_pending_o = state2_s5_q.outputs.irq_pending;

endmodule

`default_nettype wire
