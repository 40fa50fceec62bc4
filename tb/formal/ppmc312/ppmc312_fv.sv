// SPDX-License-Identifier: Apache-2.0
// ppmc312_fv: proves a complete PPMC-312 from its host pins to its motor pins, with TIMING = "FAST", a clock
// of 8 MHz and a crystal of 16 MHz (a pulse has 40 cycles). Each word of a RAM may have any value in every
// cycle, a table build takes five cycles and a plan three, with any results. All pins are unconstrained. A
// run begins with a reset or in any state of the lemmas, and the lemmas are proved by induction.
`include "ppmc_fv.svh"
`include "common/ppmc_lemma.svh"
`default_nettype none

module ppmc312_fv
  import ppmc312_pkg::*;
  import ppmc312_link_pkg::*;
(
    input wire logic        clk_i,
    input wire logic [46:0] pins_i  // all input pins but the clock
);

  logic [7:0] d_i, auxi;
  logic [3:0] adr;
  logic [2:0] rs, mod;
  logic
      pin_rst_n, mode, cs_n, we_n, oe_n, rxd, hsp, evt0_n, evt1_n, alm_n, end_n, epin, epdir, index_n, org_n;
  logic fl_n, bl_n, fhl_n, bhl_n, extck, run;
  logic [7:0] d_o;
  logic d_oe, wrq_n, irq_n, txd, snd, exon_n, cclr_n, aclr_n, zclmp_n, cd_n, pout, dir, intlk_n, out_oe;
  logic [5:0] auxo_n;

  `FV_RESET
  `FV_ANY_START(pin_rst_n)

`ifdef FV_COVERS
  // A cover needs two instructions, so its host has a fixed sequence: it writes a block of 11 bytes (initial
  // setting), reads the answer of 3 bytes, and writes a block of 10 bytes (one pulse CCW).
  localparam logic [10:0][7:0] Init = 88'hD00700_C800_E803_01_00_09_03;
  localparam logic [9:0][7:0] Move = 80'h01000000_0000_40_82_08_03;
  logic [8:0] time_q;
  logic [3:0] first_n, second_n;  // number of the write of a block
  logic writes, reads;
  always_ff @(posedge clk_i) time_q <= rst_ni ? time_q + 9'd1 : '0;
  assign first_n = 4'((time_q - 9'd8) >> 1);
  assign second_n = 4'((time_q - 9'd130) >> 1) + 4'd1;
  assign writes = !time_q[0] && (time_q inside {[9'd8 : 9'd32], [9'd130 : 9'd150]});
  assign reads = time_q inside {[9'd100 : 9'd104], [9'd108 : 9'd112], [9'd116 : 9'd120]};
  assign {cs_n, we_n, oe_n} = {!writes && !reads, !writes, !reads};
  always_comb begin
    {rs, d_i} = reads ? {3'd7, 8'd0} : {3'd5, (time_q < 9'd100) ? Init[4'd12-first_n] : Move[4'd11-second_n]};
    if (writes && time_q < 9'd100 && first_n == 4'd0) {rs, d_i} = {3'd2, 8'h20};
    if (writes && time_q < 9'd100 && first_n == 4'd1) {rs, d_i} = {3'd3, 8'h15};
    if (writes && time_q > 9'd100 && second_n == 4'd1) {rs, d_i} = {3'd3, 8'h16};
  end
  assign {pin_rst_n, mode, rxd, hsp, mod, adr, evt0_n, evt1_n, auxi} = {rst_ni, 2'b11, 8'd0, 2'b11, 8'd0};
  assign {alm_n, end_n, epin, epdir, index_n, org_n, fhl_n, bhl_n, extck, run} = 10'b11_00_11_11_11;
  assign {fl_n, bl_n} = pins_i[1:0] | {2{time_q < 9'd200}};
`else
  assign {pin_rst_n, mode, d_i, rs, cs_n, we_n, oe_n, rxd, hsp, mod, adr, evt0_n, evt1_n, auxi, alm_n, end_n,
          epin, epdir, index_n, org_n, fl_n, bl_n, fhl_n, bhl_n, extck, run} = pins_i;
`endif

  ppmc312 #(
      .CLK_HZ (8_000_000),
      .XTAL_HZ(16_000_000)
  ) dut (
      .clk  (clk_i),
      .rst_n(rst_dut_n),
      .*
  );

  logic on, start, launch, fire, output_on, endless, stop, multi, set_pos;
  logic [31:0] left, pos;
  end_cause_t cause;
  block_t block;

  assign on        = dut.rst_core_n;
  assign block     = dut.u_core.block;
  assign start     = dut.u_core.motion_req.start;
  assign multi     = dut.u_core.multi.valid;
  assign launch    = dut.u_core.u_axis.launch;
  assign output_on = dut.u_core.u_axis.output_on;
  assign fire      = dut.u_core.u_axis.u_motion.fire;
  assign stop      = dut.u_core.axis_event.stop;
  assign cause     = dut.u_core.axis_event.cause;
  assign left      = dut.u_core.u_axis.u_motion.u_seq.left_q;
  assign endless   = dut.u_core.u_axis.u_motion.u_seq.endless_q;
  assign pos       = dut.u_core.state.pos;
  assign set_pos   = dut.u_core.execute && block.code == I_POS_SET && !block.par[0][0];

  // ---- reset --------------------------------------------------------------------------------------

  // verilog_format: off
  `FV_ASSERT(
      reset_pins,
      pin_rst_n || ({pout, dir, d_oe, snd, out_oe, d_o} == '0
          && (&{wrq_n, irq_n, txd, exon_n, cclr_n, aclr_n, zclmp_n, cd_n, intlk_n, auxo_n})))
  `FV_ASSERT(
      reset_state,
      pin_rst_n || (!output_on && pos == '0 && dut.status == StatusIni && !dut.host_block.valid && !dut.rd_any
          && !dut.u_core.curve.valid))
  // verilog_format: on

  // ---- pulses and switches ------------------------------------------------------------------------

  // A level of a switch pin allows or prevents a pulse that begins at the pins three cycles later: two cycles
  // for the synchroniser, and one for the output register.
  logic [2:0] cw_h, ccw_h, alarm_h;  // bit n: level of the pin n + 1 cycles ago
  logic pout_q, dir_q, moved, output_q, start_q, launch_q, fire_q;  // …_q: one cycle ago
  logic alarm_acts, limit_acts;  // levels that were evaluated one cycle ago
  logic alarm_q, limit_q;  // there has been an alarm since the start, a limit since the launch
  // started instruction; launched_q: its motion has been launched; second_q: second phase of a zero return
  logic ccw_q, zero_q, launched_q, second_q;

  assign moved      = pout && !pout_q;
  assign alarm_acts = !alarm_h[2];
  assign limit_acts = dir_q ? !ccw_h[2] : !cw_h[2];

  always_ff @(posedge clk_i or negedge on)
    if (!on) begin
      {cw_h, ccw_h, alarm_h} <= '1;
      {pout_q, dir_q, output_q, start_q, launch_q, fire_q, alarm_q, limit_q} <= '0;
      {ccw_q, zero_q, launched_q, second_q} <= '0;
    end else begin
      cw_h <= {cw_h[1:0], fl_n};
      ccw_h <= {ccw_h[1:0], bl_n};
      alarm_h <= {alarm_h[1:0], alm_n};
      {pout_q, dir_q, output_q, start_q, launch_q, fire_q} <= {pout, dir, output_on, start, launch, fire};
      alarm_q <= alarm_acts || (alarm_q && !start_q);
      limit_q <= !launch_q && (limit_q || (output_q && limit_acts));
      if (start)
        {ccw_q, zero_q, launched_q, second_q} <= {block.par[0][6], block.code == I_ZERO, launch, 1'b0};
      else if (launch) {launched_q, second_q} <= {1'b1, launched_q};
    end

  `FV_LEMMA(no_pulse_at_a_cause, !(moved && (alarm_acts || limit_acts)))
  `FV_LEMMA(no_pulse_after_a_cause, !(moved && (alarm_q || limit_q)))
  `FV_LEMMA(no_pulse_without_event, !moved || fire_q)
  `FV_LEMMA(no_pulse_without_a_motion, !fire || output_on)
  // verilog_format: off
  `FV_LEMMA(
      no_start_without_a_motion_code,
      !start || block.code inside {I_ORIGIN, I_ZERO, I_MOVE, I_CONST, I_STEP, I_HIGH, I_CONT})
  // verilog_format: on
  `FV_LEMMA(no_start_while_moving, !start || (!output_on && dut.status == StatusNor))
  `FV_LEMMA(no_pulse_with_wrong_dir, !moved || dir == (ccw_q ^ (zero_q && second_q)))

  // ---- number of pulses: as written by the host, or fewer with a cause ---------------------------------

  logic [31:0] count, wanted_q, left_q, pos_q;
  logic finite;
  logic endless_q, fire_q2, set_pos_q, stop_q, multi_q;  // multi_q: multiple occurrence since the start
  end_cause_t cause_q;
  logic [31:0] value_q;

  // The parameters of a single step are 0.
  assign count  = {block.par[3], block.par[4], block.par[5], block.par[6]} | 32'(block.code == I_STEP);
  assign finite = block.code inside {I_MOVE, I_CONST, I_STEP};

  always_ff @(posedge clk_i or negedge on)
    if (!on) begin
      {wanted_q, pos_q, endless_q, fire_q2, set_pos_q, stop_q, multi_q, cause_q, value_q} <= '0;
    end else begin
      {pos_q, fire_q2, set_pos_q, stop_q, cause_q} <= {pos, fire_q, set_pos, stop, cause};
      value_q <= {block.par[1], block.par[2], block.par[3], block.par[4]};
      multi_q <= multi || (multi_q && !start);
      if (start) begin
        wanted_q  <= count;
        endless_q <= !finite;
      end
    end

  always_ff @(posedge clk_i) left_q <= left;

  `FV_LEMMA(written_count, !on || !launch_q || (endless == endless_q && (endless || left == wanted_q)))
  `FV_LEMMA(count_down, !on || launch_q || left == left_q - 32'(fire_q))
  `FV_LEMMA(count_no_more, !fire || endless || left != '0)
  // verilog_format: off
  `FV_LEMMA(
      count_or_a_cause,
      !on || !stop || ($onehot(cause) && (launched_q ? cause.nos == (!endless && left == '0) : cause.als)))
  // verilog_format: on
  `FV_LEMMA(count_cause_limit, !on || !stop_q || !cause_q.stl || limit_q)
  `FV_LEMMA(count_cause_alarm, !on || !stop_q || !cause_q.als || alarm_q || alarm_acts || multi_q)
  // verilog_format: off
  `FV_LEMMA(
      position_counts_pulses,
      !on || pos == (set_pos_q ? value_q : pos_q + (!fire_q2 ? 32'd0 : dir_q ? '1 : 32'd1)))
  // verilog_format: on

  // ---- lemmas -------------------------------------------------------------------------------------

  // The instruction does not change while it starts a motion; registers of the motion.
  logic idle, held, pulses, last;
  logic [2:0] motion_state, move_state;
  instr_info_t info;
  assign {idle, held, pulses, last} = {
    motion_state == 3'd0, motion_state == 3'd1, motion_state == 3'd2, motion_state == 3'd3
  };
  assign motion_state = dut.u_core.u_axis.u_motion.state_q;
  assign move_state = dut.u_core.u_instr.u_move.state_q;
  assign info = instr_info(block.code);
  end_cause_t decel_cause;
  logic abn, phase2_next, up, fetching, reads_block, checks;
  logic [1:0] by_origin, valid;
  logic [4:0] at, sent, sent_s1;
  logic [5:0] start_delay;
  assign {abn, phase2_next} = {dut.u_core.u_axis.u_motion.abn_q, dut.u_core.u_axis.u_motion.phase2_next_q};
  assign decel_cause = dut.u_core.u_axis.u_motion.decel_cause_q;
  assign by_origin = dut.u_core.u_axis.u_motion.by_origin_q;
  assign start_delay = dut.u_core.u_axis.u_motion.start_delay_q;
  assign up = dut.u_core.u_axis.u_motion.u_interval.up;
  assign fetching = dut.u_core.u_instr.u_exec.u_fetch.run_q;
  assign valid = dut.u_core.u_instr.u_exec.u_fetch.valid_q;
  assign reads_block = fetching && !dut.u_core.u_instr.u_exec.u_fetch.copy_q;
  assign checks = dut.u_core.u_instr.u_exec.state_q inside {[4'd3 : 4'd6]};
  assign at = dut.u_core.u_instr.u_exec.u_fetch.at_q;
  assign sent = dut.u_core.u_instr.u_exec.u_fetch.sent_q;
  assign sent_s1 = dut.u_core.u_instr.u_exec.u_fetch.sent_s1_q;

  // verilog_format: off
  `FV_LEMMA(
      lemma_levels,
      !on || ({dut.inputs.filtered.alm_n, dut.inputs.filtered.fl_n, dut.inputs.filtered.bl_n}
          == {alarm_h[1], cw_h[1], ccw_h[1]}))
  // verilog_format: on
  `FV_LEMMA(lemma_states, !on || motion_state <= 3'd4 && move_state <= 3'd4)
  `FV_LEMMA(lemma_move, !on || (move_state != '0) == (dut.u_core.u_instr.u_exec.state_q == 4'd10))
  // verilog_format: off
  `FV_LEMMA(
      lemma_fetch,
      !on || !dut.u_core.u_instr.u_exec.u_fetch.run_q
          || dut.u_core.u_instr.u_exec.state_q inside {4'd2, 4'd9})
  `FV_LEMMA(
      lemma_copy,
      !on || dut.u_core.u_instr.u_exec.state_q != 4'd9 || !dut.u_core.u_instr.u_exec.u_fetch.run_q
          || dut.u_core.u_instr.u_exec.u_fetch.copy_q)
  `FV_LEMMA(
      lemma_started_code,
      !on || move_state == '0 || (dut.u_core.u_instr.u_move.starts_motion_q == info.starts_motion))
  `FV_LEMMA(
      lemma_started_op,
      !on || move_state == '0 || !info.starts_motion || (dut.u_core.u_instr.u_move.op_o.ccw == block.par[0][6]
          && dut.u_core.u_instr.u_move.op_o.zero == (block.code == I_ZERO)))
  `FV_LEMMA(
      lemma_held_op,
      !on || !(held || pulses || last) || (dut.u_core.u_axis.u_motion.op_q.ccw == ccw_q
          && dut.u_core.u_axis.u_motion.op_q.zero == (zero_q && !second_q)))
  // verilog_format: on
  `FV_LEMMA(lemma_launched, !on || (held ? !launched_q && !second_q : idle || launched_q))
  // verilog_format: off
  `FV_LEMMA(
      lemma_second,
      !on || !(pulses || last) || dir == (ccw_q ^ (zero_q && second_q)) && (zero_q || !second_q))
  // verilog_format: on
  `FV_LEMMA(lemma_phase2, !on || !dut.u_core.u_axis.u_motion.phase2_next_q || (last && zero_q && !second_q))
  // verilog_format: off
  `FV_LEMMA(
      lemma_alarm,
      !on || !alarm_q || start_q || idle || motion_state == 3'd4 || dut.u_core.u_axis.u_motion.abn_q || (last
          && !dut.u_core.u_axis.u_motion.phase2_next_q))
  // verilog_format: on
  `FV_LEMMA(lemma_limit, !on || !((limit_q || (output_q && limit_acts)) && pulses) || launch_q)

  `FV_LEMMA(lemma_written_no_start, !on || !dut.u_core.u_instr.move || (info.starts_motion ? idle : !held))
  // verilog_format: off
  `FV_LEMMA(
      lemma_written_wait,
      !on || dut.u_core.u_instr.u_exec.state_q != 4'd6 || block.code inside {I_AUX_OUT, I_HALT})
  // verilog_format: on
  `FV_LEMMA(lemma_written_zero, !on || !zero_q || endless_q)
  // steps_q: cycles since the last pulse or launch, at most 3. The decision of the sequencer is complete
  // then.
  localparam int unsigned Age = ppmc_lfsr_pkg::width(40 - 1);
  logic [1:0] steps_q;
  logic first, zero;
  assign first = dut.u_core.u_axis.u_motion.first;
  assign zero  = left == '0 && !endless;
  always_ff @(posedge clk_i or negedge on)
    if (!on) steps_q <= '0;
    else if (fire || launch) steps_q <= '0;
    else if (steps_q != '1) steps_q <= steps_q + 2'd1;
  logic [6:0] delays;  // one-hot: start_delay has this number of zeros, and the pulse width has not passed
  for (genvar n = 0; n < 6; n++) begin : g_delay
    assign delays[n] = start_delay == 6'(6'b111111 << n) && first && !up
        && dut.u_core.u_axis.u_motion.u_interval.u_shaper.age_q == Age'(ppmc_lfsr_pkg::after(
        n, Age
    ));
  end
  assign delays[6] = start_delay == '0;
  // verilog_format: off
  `FV_LEMMA(
      lemma_count_zero,
      !on || !pulses || ((steps_q < 2'd1 || dut.u_core.u_axis.u_motion.u_seq.zero_q == zero)
          && (steps_q < 2'd2 || !zero || (dut.u_core.u_axis.u_motion.u_seq.action_q.ends
          && dut.u_core.u_axis.u_motion.u_seq.action_q.count)) && (steps_q < 2'd3 || !zero
          || dut.u_core.u_axis.u_motion.u_seq.action_q2.ends)))
  `FV_LEMMA(
      lemma_count_gap,
      !on || !pulses || first || dut.u_core.u_axis.u_motion.u_interval.age_q == 3'(steps_q) + 3'd1)
  `FV_LEMMA(lemma_count_first, !on || !pulses || !first || steps_q == '1 || delays[3'(steps_q)])
  `FV_LEMMA(
      lemma_count_decel,
      !on || !pulses
          || {decel_cause.als, decel_cause.nos, decel_cause.low, decel_cause.stp, decel_cause.stl} == '0)
  `FV_LEMMA(
      lemma_count_final,
      !on || !pulses || !dut.u_core.u_axis.u_motion.final_decel || $onehot(decel_cause))
  `FV_LEMMA(
      lemma_count_ends,
      !on || !pulses || ((steps_q < 2'd2 || !dut.u_core.u_axis.u_motion.u_seq.action_q.ends
          || dut.u_core.u_axis.u_motion.u_seq.action_q.low || zero || dut.u_core.u_axis.u_motion.final_decel)
          && (steps_q < 2'd3 || !dut.u_core.u_axis.u_motion.u_seq.action_q2.ends
          || dut.u_core.u_axis.u_motion.u_seq.action_q2.low || zero
          || dut.u_core.u_axis.u_motion.final_decel)))
  `FV_LEMMA(
      lemma_count_cause,
      !on || !(last || motion_state == 3'd4) || (phase2_next ? !zero
          : $onehot(dut.u_core.u_axis.u_motion.cause_q) && dut.u_core.u_axis.u_motion.cause_q.nos == zero))
  `FV_LEMMA(
      lemma_count_next,
      !on || !pulses || dut.u_core.u_axis.u_motion.final_decel || ((steps_q < 2'd1
          || !dut.u_core.u_axis.u_motion.u_seq.next_q.final_decel
          || dut.u_core.u_axis.u_motion.u_seq.action_q.final_decel) && (steps_q < 2'd2
          || !dut.u_core.u_axis.u_motion.u_seq.next_q2.final_decel
          || dut.u_core.u_axis.u_motion.u_seq.action_q2.final_decel)))
  `FV_LEMMA(
      lemma_count_cause_limit,
      !on || !(last || motion_state == 3'd4) || !dut.u_core.u_axis.u_motion.cause_q.stl || limit_q
          || (output_q && limit_acts))
  // verilog_format: on
  `FV_LEMMA(lemma_count_abnormal, !on || idle || !abn || (alarm_q && !start_q) || alarm_acts || multi_q)
  // verilog_format: off
  `FV_LEMMA(
      lemma_count_cause_alarm,
      !on || !(last || motion_state == 3'd4) || !dut.u_core.u_axis.u_motion.cause_q.als || alarm_q
          || alarm_acts || multi_q)
  `FV_LEMMA(
      lemma_written_move,
      !on || move_state == '0 || !info.starts_motion || !finite || (dut.u_core.u_instr.u_move.count_q == count
          && !dut.u_core.u_instr.u_move.endless_q))
  `FV_LEMMA(
      lemma_written_endless,
      !on || move_state == '0 || !info.starts_motion || dut.u_core.u_instr.u_move.endless_q == !finite)
  `FV_LEMMA(
      lemma_written_held,
      !on || !held || (dut.u_core.u_instr.u_move.endless_q == endless_q && (endless_q
          || dut.u_core.u_instr.u_move.count_q == wanted_q)))
  // verilog_format: on

  // Delayed signals, the fetch of an instruction, and the beginning of a motion.
  // verilog_format: off
  `FV_LEMMA(
      lemma_delays,
      !on || ((!launch_q || pulses) && (!start_q || held || launch_q) && (launch_q || (dir_q == dir
          && (output_q || !(pulses || last)))) && (!fire_q || pulses || last)))
  `FV_LEMMA(
      lemma_fetch_order,
      !on || !fetching || (at <= sent_s1 && sent_s1 <= sent && sent <= 5'd16 && sent_s1 <= at + 5'd1
          && sent <= sent_s1 + 5'd1 && !(valid[1] && at == 5'd16) && !(valid[0] && sent_s1 == 5'd16)))
  // verilog_format: on
  `FV_LEMMA(lemma_fetch_idle, !on || fetching || valid == '0)
  // verilog_format: off
  `FV_LEMMA(
      lemma_info,
      !on || (!(checks || (reads_block && at >= 5'd5)) || dut.u_core.u_instr.u_exec.info == info) && (!(checks
          || (reads_block && at >= 5'd4)) || dut.u_core.u_instr.u_exec.u_instr_rom.word_q.info == info))
  // verilog_format: on
  `FV_LEMMA(lemma_abnormal, !on || alarm_h[2] || abn)
  `FV_LEMMA(lemma_abnormal_held, !on || !held || !abn || start_q)
  `FV_LEMMA(lemma_abnormal_phase2, !on || !last || !phase2_next || !abn)
  // verilog_format: off
  `FV_LEMMA(
      lemma_origin,
      !on || !(pulses || last) || dut.u_core.u_axis.u_motion.op_q.zero || !(dut.u_core.u_axis.u_motion.org_q
          || decel_cause.org || (by_origin[0] && !start_delay[0]) || (by_origin[1] && !start_delay[1])))
  `FV_LEMMA(
      lemma_slow1,
      !on || !dut.u_core.u_axis.u_motion.u_seq.action_q.final_decel || dut.u_core.u_axis.u_motion.slow_q
          || dut.u_core.u_axis.u_motion.by_decel_q[0] || by_origin[0])
  `FV_LEMMA(
      lemma_slow2,
      !on || !dut.u_core.u_axis.u_motion.u_seq.action_q2.final_decel || dut.u_core.u_axis.u_motion.by_slow_q
          || dut.u_core.u_axis.u_motion.by_decel_q[1] || by_origin[1])
  // verilog_format: on
  `FV_LEMMA(lemma_delay, !on || delays != '0)

  `FV_COVER(seen_limit, limit_q && dir_q && output_q)
  `FV_COVER(seen_end, stop && cause.nos)
  `FV_COVER(seen_pulse, moved && dir)

endmodule

`default_nettype wire
