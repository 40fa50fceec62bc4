// SPDX-License-Identifier: Apache-2.0
// ppmc_bank_engine_fv: the engine with ppmc_bank_scheduler and eight axes, for any bytes, switches and pin
// blocks. Proves four properties. A visit reads the state that the previous visit of the same axis
// has written. A visit issues at most one pin action. An axis that is stopped or has no motion gets
// no pulse. A byte is accepted once.
`include "ppmc_fv.svh"
`default_nettype none

module ppmc_bank_engine_fv
  import ppmc_bank_pkg::*;
(
    input wire logic                 clk_i,
    input wire logic                 go_i,
    input wire logic                 stop_i,
    input wire in_buf_t              in_buf_i,
    input wire read_progress_t       read_progress_i,
    input wire logic           [1:0] config_ni,
    input wire pin_status_t          pin_status_i,
    input wire logic           [2:0] watched_i         // any axis
);

  localparam int unsigned TimeBits = 14;

  logic [5:0][2:0] axis;
  logic [7:0] last_stage;
  logic [6:0] clear;
  logic go, stop_active, read_data_we_o, irq_pending_o;
  axis_status_t status_o;
  logic [31:0] position_o;
  read_data_t read_data_o;
  pin_cmd_t pin_cmd_o;
  logic [2:0] at_cycle_o, go_left;

  `FV_RESET

  ppmc_bank_scheduler #(
      .RoundBits(3)
  ) u_scheduler (
      .axis_o (axis),
      .last_stage_o (last_stage),
      .clear_o(clear),
      .go_o   (go),
      .go_left_o(go_left),
      .stop_o (stop_active),
      .*
  );

  ppmc_bank_engine #(
      .Quantum  (1),
      .TimeBits (TimeBits),
      .RoundBits(3)
  ) dut (
      .axis_i (axis),
      .clear_i(clear[4:3]),
      .go_i   (go),
      .go_left_i(go_left),
      .*
  );

  `FV_ASSUME(one_axis, watched_i == $past(watched_i))

  // ---- visits --------------------------------------------------------------------------------------

  logic [4:0] cycles_q;  // cycles since reset, saturates at 31
  logic [2:0] since_visit_q;  // cycles since the end of the last visit of the watched axis
  logic visited_q;  // 1: the watched axis has been visited
  logic ends;  // 1: a visit of the watched axis is in its last stage
  logic resets;  // 1: this visit resets the axis

  assign ends = axis[5] == watched_i && cycles_q > 5'd4;

  always_ff @(posedge clk_i)
    if (!rst_ni) {cycles_q, since_visit_q, visited_q, resets} <= '0;
    else begin
      cycles_q <= (cycles_q == '1) ? '1 : cycles_q + 1'b1;
      since_visit_q <= ends ? '0 : since_visit_q + 1'b1;
      visited_q <= visited_q || ends;
      resets <= clear[4];
    end

  `FV_ASSERT(bank_gen_01_once_per_round, !visited_q || ends == (since_visit_q == 3'd7))

  // ---- state from visit to visit -------------------------------------------------------------------

  localparam int unsigned HoldBits = 15;

  logic [TimeBits+$bits(motion_state_t)+$bits(init_state_t)+$bits(parser_t)-1:0] state1_q;
  logic [$bits(output_state_t)+HoldBits+32-1:0] state2_q;
  interval_t interval_q;
  last_cmd_t last_cmd_q;
  ramp_t ramp_q;
  chop_units_t chop_units_q;
  axis_status_t status_q;
  logic [31:0] position_q;
  output_state_t outputs_q;
  logic cmd_set_q, ramp_set_q, chop_set_q;  // 1: the host has set last_cmd_q, ramp_q, chop_units_q

  always_ff @(posedge clk_i)
    if (!rst_ni) {cmd_set_q, ramp_set_q, chop_set_q} <= '0;
    else begin
      if (ends) {state1_q, state2_q, interval_q} <= {dut.state1_s5_q, dut.state2_s5_q, dut.interval_s5_q};
      if (ends) {status_q, position_q} <= {status_o, position_o};
      if (axis[4] == watched_i && visited_q) begin
        if (dut.take_s4_q) {cmd_set_q, last_cmd_q} <= {1'b1, dut.code_s4_q, dut.params_s4_q[31:8]};
        if (dut.decision_s4_q.init)
          {ramp_set_q, ramp_q} <= {
            1'b1, dut.init.chop, dut.params_s4_q[7:0], dut.params_s4_q[15:8], dut.params_s4_q[29:16]
          };
        if (dut.decision_s4_q.switching) {chop_set_q, chop_units_q} <= {1'b1, dut.params_s4_q[31:16]};
      end
    end

  // Lemmas for the induction: the axis that each stage processes, and whether the stage resets this axis. A
  // word that was read for an axis equals, in every stage until it is used, the word that the previous visit
  // of this axis has written.
  for (genvar i = 1; i < 6; i++) begin : g_stage
    `FV_ASSERT(lemma_axis, cycles_q < 5'(i) || axis[i] == axis[0] - 3'(i))
    `FV_ASSERT(lemma_clear, clear[i] == (cycles_q < 5'(8 + i)))
  end
  `FV_ASSERT(lemma_clear_first, clear[0] == (cycles_q < 5'd8))
  `FV_ASSERT(lemma_since_visit, !visited_q || axis[5] == watched_i + 3'd1 + since_visit_q)
  `FV_ASSERT(lemma_visited, visited_q ? cycles_q > 5'd5 : !(cmd_set_q || ramp_set_q || chop_set_q))
  `FV_ASSERT(lemma_axis_first, cycles_q == '1 || axis[0] == cycles_q[2:0])
  `FV_ASSERT(lemma_state1, !(visited_q && axis[1] == watched_i) || dut.state1_s1_q == state1_q)
  `FV_ASSERT(lemma_interval_pre,
             !(visited_q && axis[0] + 3'd1 == watched_i) || dut.interval_pre_q == interval_q)
  `FV_ASSERT(lemma_interval_s0, !(visited_q && axis[0] == watched_i) || dut.interval_s0_q == interval_q)
  `FV_ASSERT(lemma_interval_s1, !(visited_q && axis[1] == watched_i) || dut.interval_s1_q == interval_q)
  logic lemma_mem_s1_holds;
  assign lemma_mem_s1_holds =
      axis[1] != watched_i || cycles_q < 5'd6 || ((!cmd_set_q || dut.last_cmd_s1_q == last_cmd_q) &&
      (!ramp_set_q || dut.ramp_s1_q == ramp_q));
  `FV_ASSERT(lemma_mem_s1, lemma_mem_s1_holds)
  logic lemma_mem_s2_holds;
  assign lemma_mem_s2_holds =
      axis[2] != watched_i || cycles_q < 5'd6 || ((!cmd_set_q || dut.last_cmd_s2_q == last_cmd_q) &&
      (!ramp_set_q || dut.ramp_s2_q == ramp_q));
  `FV_ASSERT(lemma_mem_s2, lemma_mem_s2_holds)

  `FV_ASSERT(bank_gen_05_motion_kept, !(visited_q && axis[2] == watched_i) || dut.state1_s2_q == state1_q)
  `FV_ASSERT(bank_gen_05_position_kept, !(visited_q && axis[2] == watched_i) || dut.state2_s2_q == state2_q)
  `FV_ASSERT(bank_gen_05_interval_kept,
             !(visited_q && axis[2] == watched_i) || dut.interval_s2_q == interval_q)
  `FV_ASSERT(bank_gen_05_last_cmd_kept,
             !(cmd_set_q && axis[3] == watched_i) || dut.last_cmd_s3_q == last_cmd_q)
  `FV_ASSERT(bank_gen_05_ramp_kept, !(ramp_set_q && axis[3] == watched_i) || dut.ramp_s3_q == ramp_q)
  `FV_ASSERT(bank_gen_05_chop_units_kept,
             !(chop_set_q && axis[3] == watched_i) || dut.chop_units_s3_q == chop_units_q)

  assign outputs_q = state2_q[HoldBits+32+:$bits(output_state_t)];

  // ---- effects of a visit ----------------------------------------------------------------------------

  logic next_visit;  // 1: a visit of the watched axis that is not its first
  assign next_visit = visited_q && ends && !resets;

  `FV_ASSERT(
      one_pin_action,
      2'(pin_cmd_o.pulse) + 2'(pin_cmd_o.pulse_end) + 2'(pin_cmd_o.set_pins) <= 2'd1 || cycles_q < 5'd8)
  `FV_ASSERT(bank_mot_02_no_pulse_when_stopped, !pin_cmd_o.pulse || cycles_q < 5'd8 || $past
             (pin_status_i.armed, 3))
  `FV_ASSERT(no_pulse_without_motion,
             !next_visit || !(pin_cmd_o.pulse || pin_cmd_o.pulse_end) || (status_q.busy && status_o.busy))
  `FV_ASSERT(bank_mot_03_position_by_one, !next_visit || position_o - position_q inside {32'd0, 32'd1, '1})
  `FV_ASSERT(bank_hsk_01_accepted_as_written,
             !next_visit || status_o.ack_seq == status_q.ack_seq || status_o.ack_seq == $past(in_buf_i.seq, 4
                                                                                                 ))
  `FV_ASSERT(bank_hsk_01_motion_from_a_byte,
             !(next_visit && status_o.busy && !status_q.busy) || status_o.ack_seq != status_q.ack_seq)
  `FV_ASSERT(bank_hsk_04_read_data_from_a_byte,
             !(next_visit && read_data_we_o) || status_o.ack_seq != status_q.ack_seq)
  `FV_ASSERT(p104_end_07_interrupt_at_the_end,
             !(next_visit && irq_pending_o && !outputs_q.irq_pending) || (status_q.busy && !status_o.busy))
  `FV_ASSERT(bank_gen_05_reset,
             !(resets && cycles_q > 5'd8) || (status_o == '0 && pin_cmd_o == '0 && position_o == '0))

  // Words of the watched axis in the memories.
  logic [$bits(state1_q)-1:0] state1_word;
  logic [$bits(state2_q)-1:0] state2_word;
  interval_t interval_word;
  last_cmd_t last_cmd_word;
  ramp_t ramp_word;
  chop_units_t chop_units_word;
  assign state1_word = dut.state1_mem[watched_i];
  assign state2_word = dut.state2_mem[watched_i];
  assign interval_word = dut.interval_mem[watched_i];
  assign last_cmd_word = dut.last_cmd_mem[watched_i];
  assign ramp_word = dut.ramp_mem[watched_i];
  assign chop_units_word = dut.chop_units_mem[watched_i];

  `FV_ASSERT(lemma_mem_state,
             !visited_q || {state1_word, state2_word, interval_word} == {state1_q, state2_q, interval_q})
  logic lemma_mem_host_holds;
  assign lemma_mem_host_holds =
      (!cmd_set_q || last_cmd_word == last_cmd_q) && (!ramp_set_q || ramp_word == ramp_q) && (!chop_set_q ||
      chop_units_word == chop_units_q);
  `FV_ASSERT(lemma_mem_host, lemma_mem_host_holds)

  // Lemmas for the induction: the words of the watched axis in stages 3 and 4, and the relation between these
  // words and the last outputs.
  localparam int unsigned BusyAt = $bits(parser_t) + $bits(init_state_t) + $bits(motion_state_t) - 1;
  `FV_ASSERT(
      lemma_visit3,
      !(visited_q && axis[3] == watched_i) || {dut.state1_s3_q, dut.state2_s3_q} == {state1_q, state2_q})
  `FV_ASSERT(
      lemma_visit4,
      !(visited_q && axis[4] == watched_i) || {dut.state1_s4_q, dut.state2_s4_q} == {state1_q, state2_q})
  `FV_ASSERT(lemma_visit_last,
             !visited_q || (status_q == {state1_q[5:0], state1_q[BusyAt]} && position_q == state2_q[31:0]))
  logic lemma_visit_armed_holds;
  assign lemma_visit_armed_holds =
      !dut.decision_s4_q.pulse || cycles_q < 5'd8 ||
      (dut.pin_status_s4_q.armed && dut.state1_s4_q.motion.busy);
  `FV_ASSERT(lemma_visit_armed, lemma_visit_armed_holds)

  // Lemmas for the induction: the state of every axis is valid in every stage.
  for (genvar n = 0; n < 8; n++) begin : g_axis
    logic [$bits(state1_q)-1:0] word;
    motion_state_t motion;
    init_state_t init_state;
    parser_t parser;
    assign word = dut.state1_mem[n];
    assign {motion, init_state, parser} = word[0+:$bits(motion_state_t)+$bits(init_state_t)+$bits(parser_t)];
    `FV_ASSERT(lemma_valid0, cycles_q < 5'd3 || state_valid(motion, init_state, parser))
  end
  `FV_ASSERT(lemma_valid1, cycles_q < 5'd5 || state_valid(dut.state1_s1_q.motion, dut.state1_s1_q.init_state,
                                                          dut.state1_s1_q.parser))
  `FV_ASSERT(lemma_valid2, cycles_q < 5'd6 || state_valid(dut.state1_s2_q.motion, dut.state1_s2_q.init_state,
                                                          dut.state1_s2_q.parser))
  `FV_ASSERT(lemma_valid3, cycles_q < 5'd7 || state_valid(dut.state1_s3_q.motion, dut.state1_s3_q.init_state,
                                                          dut.state1_s3_q.parser))
  `FV_ASSERT(lemma_valid4, cycles_q < 5'd8 || state_valid(dut.state1_s4_q.motion, dut.state1_s4_q.init_state,
                                                          dut.state1_s4_q.parser))
  `FV_ASSERT(lemma_valid5, cycles_q < 5'd2 || state_valid(dut.state1_s5_q.motion, dut.state1_s5_q.init_state,
                                                          dut.state1_s5_q.parser))

  function automatic logic state_valid(motion_state_t motion, init_state_t init_state, parser_t parser);
    return motion.busy ? !init_state.building && (parser.error || parser.number == '0) :
        !(motion.more_pulses || motion.pulse_low);
  endfunction

  `FV_COVER(seen_host_words, cmd_set_q && ramp_set_q && chop_set_q && visited_q && axis[3] == watched_i)
  `FV_COVER(seen_read_data, next_visit && read_data_we_o && status_o.ack_seq != status_q.ack_seq)
  `FV_COVER(seen_motion, next_visit && status_o.busy && !status_q.busy)

endmodule

`default_nettype wire
