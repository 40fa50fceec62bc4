// SPDX-License-Identifier: Apache-2.0
// verilog_syntax: parse-as-module-body
// Properties of one axis of a whole part, from the bus pins to the motor pins. A wrapper includes this file
// after it has defined the signals below. All expectations are computed from the pins and from the bytes that
// the host has written; `code` is the current command. Some properties read strobes of blocks; the proofs of
// these blocks relate the strobes to the bus and to the motion.
// A level of a switch pin allows or prevents a pulse that begins at the pins four cycles later: two cycles for
// the synchroniser, one for the axis, and one for the output register.
// The wrapper defines:
//   pin_rst_n, limit_cw_n, limit_ccw_n, alarm_n, s   pins
//   moved         a pulse begins at the pins in this cycle
//   is_idle       the part has the state that a reset must cause
//   addressed     `code` addresses the axis
//   is_read       the byte that the host has just written is a read code
//   must_answer   the part must answer a read code that it accepts in this cycle
//   positive_now  with phase_init: the host has written the polarity high = energised
//   IdleLevel     level of the phases until the first initialisation
//   on, motion, now, cause, start, exc_off, phase_init, building, left, low, shaper_age (Age bits)   axis
//   ibf, obf, wr, wr_a0, wr_data, rd_done, take, load                                             host port

  // ---- reset ---------------------------------------------------------------------------------------

  `FV_ASSERT(reset_is_idle, pin_rst_n || is_idle)

  // ---- bytes of the host ---------------------------------------------------------------------------

  logic [7:0] byte_q, code_q, code;  // last byte written by the host; last command that was accepted
  logic command_q;  // byte_q is a command
  logic [23:0] data_q;  // last three data bytes that were accepted
  logic ccw_q, pout_only_q, origin_q;  // operation that the host has written and the axis has started

  assign code = command_q ? byte_q : code_q;

  always_ff @(posedge clk_i or negedge on)
    if (!on) {byte_q, code_q, command_q, data_q, ccw_q, pout_only_q, origin_q} <= '0;
    else begin
      if (wr) {command_q, byte_q} <= {wr_a0, wr_data};
      if (take && command_q) code_q <= byte_q;
      if (take && !command_q) data_q <= {byte_q, data_q[23:8]};
      if (start) {ccw_q, pout_only_q, origin_q} <= {code[3], code[7], code[2:0] == 3'b111};
    end

  `FV_ASSERT(no_start_without_an_operation, !start || (addressed && code[6] && code[2:0] >= 3'd2))

  // ---- pulses and switches -------------------------------------------------------------------------

  logic [3:0] cw_h, ccw_h, alarm_h;  // bit n: level of the pin n + 1 cycles ago
  logic [1:0] busy_h, start_h, pulse_h;
  logic switch_acts, blocked_q;  // blocked_q: there has been a cause since the start of the operation

  assign switch_acts = !alarm_h[3] || (ccw_q ? !ccw_h[3] : !cw_h[3]);

  always_ff @(posedge clk_i or negedge on)
    if (!on) begin
      {cw_h, ccw_h, alarm_h} <= '1;
      {busy_h, start_h, pulse_h, blocked_q} <= '0;
    end else begin
      cw_h      <= {cw_h[2:0], limit_cw_n};
      ccw_h     <= {ccw_h[2:0], limit_ccw_n};
      alarm_h   <= {alarm_h[2:0], alarm_n};
      busy_h    <= {busy_h[0], motion.busy};
      start_h   <= {start_h[0], start};
      pulse_h   <= {pulse_h[0], now.pulse};
      blocked_q <= !start_h[1] && (blocked_q || (busy_h[1] && switch_acts));
    end

  `FV_ASSERT(no_pulse_at_a_cause, !(moved && switch_acts))
  `FV_ASSERT(no_pulse_after_a_cause, !(moved && blocked_q))
  `FV_ASSERT(no_pulse_without_event, !moved || pulse_h[1])

  // ---- number of pulses: as written by the host, or fewer with a cause --------------------------------

  logic complete_q;  // the pulse that completes the count has occurred
  logic [23:0] wanted, wanted_q, left_q;

  assign wanted = (code[2:0] inside {3'b011, 3'b100}) ? {byte_q, data_q[23:8]} :
      (code[2:0] == 3'b010) ? '0 : '1;

  always_ff @(posedge clk_i or negedge on)
    if (!on) {wanted_q, left_q, complete_q} <= '0;
    else begin
      wanted_q   <= wanted;
      left_q     <= left;
      complete_q <= !start && (complete_q || (now.pulse && now.complete));
    end

  `FV_ASSERT(count_as_written, !on || !start_h[0] || left == wanted_q)
  `FV_ASSERT(count_down, !on || start_h[0] || left == left_q - 24'(pulse_h[0] && left_q != '0))
  `FV_ASSERT(count_complete, !now.pulse || now.complete == (left == '0))
  `FV_ASSERT(count_no_more, !(complete_q && now.pulse))
  `FV_ASSERT(count_or_a_cause, !now.done || origin_q || complete_q || cause != '0)

  // ---- excitation ----------------------------------------------------------------------------------

  logic homed_q, positive, positive_q;  // homed_q: the phases are on; positive: high = energised
  motor_e motor;
  logic half;
  logic [3:0] index_q, length, stride;  // row of the half-step table
  logic [3:0] one, two, three;  // adjacent phases of this row
  logic [4:0] row, row_q, lines;

  assign length = 4'd2 * (4'(motor) + 4'd2);
  assign stride = half ? 4'd1 : 4'd2;
  assign one    = {1'b0, index_q[3:1]};
  assign two    = (one + 4'd1 == (length >> 1)) ? 4'd0 : one + 4'd1;
  assign three  = (two + 4'd1 == (length >> 1)) ? 4'd0 : two + 4'd1;
  assign lines  = s ^ {5{!positive_q}};

  always_ff @(posedge clk_i or negedge on)
    if (!on) begin
      {homed_q, index_q, half} <= '0;
      motor    <= MotorNone;
      positive <= IdleLevel == 1'b0;
    end else if (phase_init || exc_off) begin
      {homed_q, index_q} <= {phase_init, 4'd0};
      if (phase_init) begin
        {half, positive} <= {code_q[2], positive_now};
        motor <= motor_e'(code_q[1:0]);
      end
    end else if (now.pulse && !pout_only_q) begin
      if (ccw_q) index_q <= (index_q < stride) ? index_q + length - stride : index_q - stride;
      else index_q <= (index_q + stride >= length) ? index_q + stride - length : index_q + stride;
    end

  always_comb begin
    for (int unsigned p = 0; p < 5; p++) begin
      row[p] = 4'(p) == two;
      if (!index_q[0] || motor == Motor5) row[p] |= 4'(p) == one;
      if (index_q[0] && motor == Motor5) row[p] |= 4'(p) == three;
    end
    if (!homed_q) row = '0;
  end

  always_ff @(posedge clk_i or negedge on)
    if (!on) {row_q, positive_q} <= {5'd0, 1'(IdleLevel == 1'b0)};
    else {row_q, positive_q} <= {row, positive};

  `FV_ASSERT(phases_are_a_row_or_off, !on || lines == row_q || (lines == '0 && !busy_h[0]))
  `FV_ASSERT(phases_step_with_a_pulse, !on || row == row_q || row == '0 || row_q == '0 || pulse_h[0])
  `FV_ASSERT(phases_of_a_motor, !homed_q || motor != MotorNone)
  `FV_ASSERT(phases_as_written, !phase_init || (addressed && !command_q && code_q[7:6] == 2'b00))

  // ---- answers -------------------------------------------------------------------------------------

  logic asked_q;  // 1: the last byte of the host is a read code, and has no answer yet
  logic [1:0] owed_q;  // bytes of the answer that the host has not read

  always_ff @(posedge clk_i or negedge on)
    if (!on) {asked_q, owed_q} <= '0;
    else begin
      if (wr) asked_q <= is_read;
      else if (load) asked_q <= 1'b0;
      if (load) owed_q <= (code[2:0] == 3'b011) ? 2'd3 : 2'd1;
      else if (rd_done) owed_q <= owed_q - 2'd1;
    end

  `FV_ASSERT(answer_has_a_request, !load || asked_q)
  `FV_ASSERT(answer_not_too_long, !on || !(obf || rd_done) || owed_q != '0)
  `FV_ASSERT(answer_to_each_request, !on || !(take && asked_q && must_answer) || load)

  // ---- no lock-up ----------------------------------------------------------------------------------

  // ibf_age_q: cycles for which the same byte has waited, without a table build. alarm_age_q: cycles for which
  // the alarm has been active since the last start. pulse_age_q: cycles since the last start, end of the RUN
  // gate, or pulse event.
  logic [1:0] ibf_age_q;
  logic [5:0] alarm_age_q, pulse_age_q;

  always_ff @(posedge clk_i or negedge on)
    if (!on) {ibf_age_q, alarm_age_q, pulse_age_q} <= '0;
    else begin
      ibf_age_q   <= (!ibf || wr || building) ? '0 : ibf_age_q + 2'd1;
      alarm_age_q <= (alarm_n || start) ? '0 : (alarm_age_q == '1) ? '1 : alarm_age_q + 6'd1;
      if (start || now.pulse || motion.gated) pulse_age_q <= 6'd1;
      else if (pulse_age_q != '1 && pulse_age_q != '0) pulse_age_q <= pulse_age_q + 6'd1;
    end

  `FV_ASSERT(ready_ibf_falls, ibf_age_q != 2'd3)
  `FV_ASSERT(ready_busy_falls, !motion.busy || alarm_age_q < 6'd48)
  `FV_ASSERT(lemma_ready_stopped, !on || alarm_age_q < 6'd4 || !motion.moving)
  `FV_ASSERT(lemma_ready_last_pulse,
             !on || alarm_age_q < 6'd4 || pulse_age_q == '1 || !motion.busy ||
             pulse_age_q + 6'd4 > alarm_age_q)
  `FV_ASSERT(lemma_ready_low, !low || (pulse_age_q != '0 && pulse_age_q <= 6'd40))
  logic lemma_age_holds;
  always_comb begin
    lemma_age_holds = 1'b1;
    for (int unsigned n = 1; n < 40; n++)
    if (pulse_age_q == 6'(n) && shaper_age != Age'(ppmc_lfsr_pkg::after(n - 1, Age))) lemma_age_holds = 1'b0;
  end
  `FV_ASSERT(lemma_ready_age, lemma_age_holds)
