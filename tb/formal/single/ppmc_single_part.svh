// SPDX-License-Identifier: Apache-2.0
// verilog_syntax: parse-as-module-body
// Properties of a whole part with one axis, from the bus pins to the motor pins. The modules ppmc104_fv and
// stmc_fv include this file. They define dut, IdleLevel, and these signals: pin_rst_n, limit_cw_n,
// limit_ccw_n, alarm_n (pins), s, ccw (direction of the pulse), moved (a pulse begins at the pins in this
// cycle), is_read (the byte that the host has just written is a read code), and pins_at_rest.
// A level of a switch pin allows or prevents a pulse that begins at the pins four cycles later: two cycles
// for the synchroniser, one for the axis, and one for the output register. Some properties read strobes of
// blocks; the proofs of these blocks relate the strobes to the bus and to the motion.

  logic on;  // 1: the part is out of reset
  motion_t motion;
  motion_event_t now;
  action_t act;
  setup_t setup;
  logic ibf, obf, building, wr, wr_a0, take, load, rd_done;
  logic [7:0] wr_data;
  logic [23:0] left;

  assign on       = dut.rst_core_n;
  assign motion   = dut.u_single.motion_o;
  assign now      = dut.u_single.event_now;
  assign act      = dut.u_single.act_o;
  assign setup    = dut.u_single.setup_o;
  assign building = dut.u_single.building;
  assign ibf      = dut.u_single.u_host.ibf;
  assign obf      = dut.u_single.u_host.obf;
  assign wr       = dut.u_single.u_host.wr;
  assign wr_a0    = dut.u_single.u_host.wr_a0;
  assign wr_data  = dut.u_single.u_host.wr_data;
  assign rd_done  = dut.u_single.u_host.rd_done;
  assign take     = dut.u_single.take;
  assign load     = dut.u_single.act_req.read;
  assign left     = dut.u_single.remaining;

  // ---- reset ---------------------------------------------------------------------------------------

  logic idle;
  assign idle = pins_at_rest && !motion.busy && !ibf && !obf && !building && dut.u_single.status == '0 &&
      !dut.u_single.initialised;

  `FV_ASSERT(reset_is_idle, pin_rst_n || idle)

  // ---- pulses and switches -------------------------------------------------------------------------

  logic [3:0] cw_h, ccw_h, alarm_h;  // bit n: level of the pin n + 1 cycles ago
  logic [1:0] busy_h, start_h, pulse_h;
  logic cause, blocked_q;  // blocked_q: there has been a cause since the start of the operation

  assign cause = !alarm_h[3] || (ccw ? !ccw_h[3] : !cw_h[3]);

  always_ff @(posedge clk_i or negedge on)
    if (!on) begin
      {cw_h, ccw_h, alarm_h} <= '1;
      {busy_h, start_h, pulse_h, blocked_q} <= '0;
    end else begin
      cw_h      <= {cw_h[2:0], limit_cw_n};
      ccw_h     <= {ccw_h[2:0], limit_ccw_n};
      alarm_h   <= {alarm_h[2:0], alarm_n};
      busy_h    <= {busy_h[0], motion.busy};
      start_h   <= {start_h[0], act.start};
      pulse_h   <= {pulse_h[0], now.pulse};
      blocked_q <= !start_h[1] && (blocked_q || (busy_h[1] && cause));
    end

  `FV_ASSERT(no_pulse_at_a_cause, !(moved && cause))
  `FV_ASSERT(no_pulse_after_a_cause, !(moved && blocked_q))
  `FV_ASSERT(no_pulse_without_event, !moved || pulse_h[1])

  // ---- number of pulses: as written by the host, or fewer with a cause --------------------------------

  logic [7:0] byte_q, code_q;  // byte_q: last byte written by the host; code_q: last accepted command
  logic command_q, complete_q;  // command_q: byte_q is a command; complete_q: the count is complete
  logic [23:0] data_q;  // last three data bytes that were accepted
  logic [23:0] wanted, wanted_q, left_q;
  logic [2:0] op;

  assign op = command_q ? byte_q[2:0] : code_q[2:0];
  assign wanted = (op inside {3'b011, 3'b100}) ? {byte_q, data_q[23:8]} : (op == 3'b010) ? '0 : '1;

  always_ff @(posedge clk_i or negedge on)
    if (!on) {byte_q, code_q, command_q, data_q, wanted_q, left_q, complete_q} <= '0;
    else begin
      if (wr) {command_q, byte_q} <= {wr_a0, wr_data};
      if (take && command_q) code_q <= byte_q;
      if (take && !command_q) data_q <= {byte_q, data_q[23:8]};
      wanted_q   <= wanted;
      left_q     <= left;
      complete_q <= !act.start && (complete_q || (now.pulse && now.complete));
    end

  `FV_ASSERT(count_as_written, !on || !start_h[0] || left == wanted_q)
  `FV_ASSERT(count_down, !on || start_h[0] || left == left_q - 24'(pulse_h[0] && left_q != '0))
  `FV_ASSERT(count_complete, !now.pulse || now.complete == (left == '0))
  `FV_ASSERT(count_no_more, !(complete_q && now.pulse))
  `FV_ASSERT(count_or_a_cause, !now.done || motion.op.origin || complete_q || dut.u_single.cause != '0)

  // ---- excitation ----------------------------------------------------------------------------------

  logic homed_q, positive_q;
  logic [3:0] index_q, length, stride;  // index_q: row of the half-step table; stride: rows of a step
  logic [3:0] one, two, three;  // numbers of three adjacent phases (0: S1); `one` follows from index_q
  logic [4:0] row, row_q, lines;

  assign length = 4'd2 * (4'(setup.motor) + 4'd2);
  assign stride = setup.half ? 4'd1 : 4'd2;
  assign one    = {1'b0, index_q[3:1]};
  assign two    = (one + 4'd1 == (length >> 1)) ? 4'd0 : one + 4'd1;
  assign three  = (two + 4'd1 == (length >> 1)) ? 4'd0 : two + 4'd1;
  assign lines  = s ^ {5{!positive_q}};

  always_ff @(posedge clk_i or negedge on)
    if (!on) {homed_q, index_q} <= '0;
    else if (dut.u_single.phase_init || act.exc_off) {homed_q, index_q} <= {dut.u_single.phase_init, 4'd0};
    else if (now.pulse && !motion.op.pout_only) begin
      if (motion.op.ccw) index_q <= (index_q < stride) ? index_q + length - stride : index_q - stride;
      else index_q <= (index_q + stride >= length) ? index_q + stride - length : index_q + stride;
    end

  always_comb begin
    for (int unsigned p = 0; p < 5; p++) begin
      row[p] = 4'(p) == two;
      if (!index_q[0] || setup.motor == Motor5) row[p] |= 4'(p) == one;
      if (index_q[0] && setup.motor == Motor5) row[p] |= 4'(p) == three;
    end
    if (!homed_q) row = '0;
  end

  always_ff @(posedge clk_i or negedge on)
    if (!on) {row_q, positive_q} <= {5'd0, 1'(IdleLevel == 1'b0)};
    else {row_q, positive_q} <= {row, setup.positive};

  `FV_ASSERT(phases_are_a_row_or_off, !on || lines == row_q || (lines == '0 && !busy_h[0]))
  `FV_ASSERT(phases_step_with_a_pulse, !on || row == row_q || row == '0 || row_q == '0 || pulse_h[0])
  `FV_ASSERT(phases_of_a_motor, !homed_q || setup.motor != MotorNone)
  `FV_ASSERT(phases_as_written, !dut.u_single.phase_init || (code_q[7:6] == 2'b00 && code_q[1:0] != '0))

  // ---- answers -------------------------------------------------------------------------------------

  logic asked_q;  // 1: the last byte of the host is a read code, and has no answer yet
  logic [1:0] owed_q;  // bytes of the answer that the host has not read

  always_ff @(posedge clk_i or negedge on)
    if (!on) {asked_q, owed_q} <= '0;
    else begin
      if (wr) asked_q <= is_read;
      else if (load) asked_q <= 1'b0;
      if (load) owed_q <= (dut.u_single.check_result_i.select == SEL_REMAINING) ? 2'd3 : 2'd1;
      else if (rd_done) owed_q <= owed_q - 2'd1;
    end

  `FV_ASSERT(answer_has_a_request, !load || asked_q)
  `FV_ASSERT(answer_not_too_long, !on || !(obf || rd_done) || owed_q != '0)
  `FV_ASSERT(answer_to_each_request, !on || !(take && asked_q && !motion.busy) || load)

  // ---- no lock-up ----------------------------------------------------------------------------------

  // ibf_age_q: cycles for which the same byte has waited, without a table build. alarm_age_q: cycles for
  // which the alarm has been active since the last start. pulse_age_q: cycles since the last start or
  // pulse event.
  localparam int unsigned Age = ppmc_lfsr_pkg::width(40 - 1);
  logic [1:0] ibf_age_q;
  logic [5:0] alarm_age_q, pulse_age_q;
  logic low;
  logic [Age-1:0] shaper_age;

  assign shaper_age = dut.u_single.u_axis.u_shaper.age_q;
  assign low = dut.u_single.u_axis.u_shaper.low_o;

  always_ff @(posedge clk_i or negedge on)
    if (!on) {ibf_age_q, alarm_age_q, pulse_age_q} <= '0;
    else begin
      ibf_age_q   <= (!ibf || wr || building) ? '0 : ibf_age_q + 2'd1;
      alarm_age_q <= (alarm_n || act.start) ? '0 : (alarm_age_q == '1) ? '1 : alarm_age_q + 6'd1;
      if (act.start || now.pulse) pulse_age_q <= 6'd1;
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
