// SPDX-License-Identifier: Apache-2.0
// pmc006_fv: proves a complete PMC006B4 from its pins, with a clock of 8 MHz and 100 000 baud (a µs has 8
// cycles, a bit 80). The results of the planner, each word that is read from a RAM or from a table, and the
// commands of the EEPROM bus may have any value in every cycle. All pins are unconstrained.
`include "ppmc_fv.svh"
`include "common/ppmc_lemma.svh"
`default_nettype none

module pmc006_fv
  import pmc006_pkg::*;
(
    input wire logic       clk_i,
    input wire logic       pin_rst_n,
    input wire logic       rxd,
    input wire logic       ext1,
    input wire logic       ext2,
    input wire logic       fset_n,
    input wire logic [4:0] gpi,
    input wire logic [9:0] adc_data,
    input wire logic       adc_valid,
    input wire logic [9:0] bemf_level,
    input wire logic       bemf_valid,
    input wire logic       cmp_a,
    input wire logic       cmp_b,
    input wire logic       scl_i,
    input wire logic       sda_i
);

  logic txd, de, ext1_pu, ext2_pu;
  logic [4:0] gpo;
  logic [7:0] phase_a_ref, phase_b_ref;
  logic phase_a_sign, phase_b_sign, pwm_a_ref, pwm_b_ref, bridge_a_en, bridge_b_en, m10, m11, m20, m21;
  logic scl_o, scl_oe, sda_o, sda_oe, mon_step, mon_dir, mon_busy;

  `FV_RESET
  `FV_ANY_START(pin_rst_n)

  pmc006 #(
      .CLK_HZ(8_000_000),
      .BAUD  (100_000)
  ) dut (
      .clk  (clk_i),
      .rst_n(rst_dut_n),
      .*
  );

  logic on;
  assign on = dut.rst_core_n;

  motor_settings_t set_q;  // registers that the instructions have written
  control_settings_t ctl_q;
  logic begins;  // a motion begins in the next cycle

  // ---- frames: the bytes that the host has sent ---------------------------------------------------------

  logic take;  // a byte is received
  logic timeout, go, mine_q;
  logic [7:0] char, sum_q;
  logic [6:0][7:0] bytes_q;  // bytes of the frame, [0]: the first
  logic [2:0] place, place_q;  // place of the next byte in its frame; 0: the byte must be A5
  logic [3:0] frame_q;  // cycles since the end of a frame whose reply is not sampled; 0: no frame
  logic reply_sample;

  assign take = dut.u_serial.valid && dut.u_serial.rx_on;
  assign char = dut.u_serial.char;
  assign timeout = dut.u_serial.timeout;
  assign reply_sample = dut.u_control.reply_sample;
  assign place = timeout ? 3'd0 : place_q;
  assign go = take && place == 3'd7 && mine_q && char == sum_q;

  always_ff @(posedge clk_i) begin
    if (take && place != 3'd7) bytes_q[place] <= char;
    if (take) sum_q <= (place == '0) ? char : sum_q + char;
    if (take && place == 3'd1) mine_q <= char == ctl_q.addr;
  end

  always_ff @(posedge clk_i or negedge on)
    if (!on) {place_q, frame_q} <= '0;
    else begin
      if (dut.u_serial.error) place_q <= '0;
      else if (take) place_q <= (place == '0 && char != 8'hA5) ? '0 : place + 3'd1;
      if (go || (frame_q != '0 && !reply_sample)) frame_q <= frame_q + 1'b1;
      else frame_q <= '0;
    end

  // ---- instruction in progress --------------------------------------------------------------------------

  localparam logic [2:0] ExIdle = 3'd0, ExFirst = 3'd1, ExSecond = 3'd2, ExDecode = 3'd3, ExCheck = 3'd4;
  localparam logic [2:0] ExExec = 3'd5, ExReply = 3'd6;

  exec_cmd_t cmd;
  logic [2:0] ex;
  logic exec, set_position, legal, pending, of_frame, of_program;
  logic [7:0] op;
  logic [31:0] data, data_q;

  assign cmd = dut.u_control.cmd;
  assign ex = dut.u_control.u_exec.state_q;
  assign pending = dut.u_control.u_exec.frame_pending_q;
  assign exec = dut.u_control.exec;
  assign set_position = dut.u_control.set_position;
  assign of_frame = cmd.source == FromFrame;
  assign of_program = cmd.source == FromProgram || cmd.source == FromTry;
  assign op = !of_frame ? cmd.op : bytes_q[2][7] ? I_NONE : bytes_q[2];
  assign data = of_frame ? bytes_q[6:3] : cmd.data;
  always_ff @(posedge clk_i) data_q <= cmd.data;

  // The registers that set_q and ctl_q have.
  function automatic logic [48:0] motor_key(motor_settings_t s);
    return {s.mstep, s.autodec, s.dir, s.free, s.vstart, s.vstop, s.vmax};
  endfunction
  function automatic logic [31:0] control_key(control_settings_t c);
    return {c.addr, c.trigm, c.exten, c.offline, c.stlen, c.stcfg, c.stlvl};
  endfunction
  function automatic logic legal_mstep(logic [7:0] mstep);
    return mstep inside {8'd0, 8'd2, 8'd4, 8'd8, 8'd16, 8'd32, 8'd64, 8'd128};
  endfunction

  // Data that the rules accept, for the instructions that this proof uses.
  function automatic logic accepts(exec_cmd_t c, logic [7:0] code, logic [31:0] d);
    logic program_code;
    program_code = c.source == FromProgram || c.source == FromTry;
    unique case (code)
      I_STEP: return d != '0 && !d[31];
      I_MSTEP: return legal_mstep(d[7:0]) && d[31:8] == '0;
      I_RUN, I_DIR, I_FREE, I_OFFLINE, I_AUTODEC: return d <= 32'd1;
      I_EXTEN: return d <= (program_code ? 32'd1 : 32'd3);
      I_TRIGGER: return d <= 32'd3;
      I_VSTART, I_VSTOP: return d inside {[32'd65 : 32'd3000]};
      I_VMAX: return d <= 32'd16_000 && (program_code || d != '0) && c.option <= 4'd1;
      I_STCFG: return d <= 32'd7;
      I_STLEN: return d <= 32'd63;
      I_STLVL: return d <= 32'd511;
      I_ADDR: return d inside {[32'd1 : 32'd120]} || (c.source == FromBoot && d[15:0] == 16'h00FF);
      default: return 1'b1;
    endcase
  endfunction

  assign legal = accepts(cmd, op, data);

  // Word of the program and parameter of the EEPROM do not change while an instruction is executed.
  `FV_ASSUME(word_stands, ex != ExExec || of_frame || cmd.data == data_q)

  // ---- registers that the instructions have written -----------------------------------------------------

  always_ff @(posedge clk_i or negedge dut.u_control.rst_settings_n)
    if (!dut.u_control.rst_settings_n) {set_q, ctl_q} <= {SETTINGS_RESET, CONTROL_RESET};
    else if (exec && legal) begin
      unique case (op)
        I_MSTEP:   set_q.mstep <= data[7:0];
        I_DIR:     set_q.dir <= data[0];
        I_FREE:    set_q.free <= data[0];
        I_VSTART:  set_q.vstart <= data[11:0];
        I_VSTOP:   set_q.vstop <= data[11:0];
        I_VMAX:    set_q.vmax <= data[13:0];
        I_EXTEN:   ctl_q.exten <= of_frame ? data[1:0] : {2{data[0]}};
        I_TRIGGER: ctl_q.trigm <= data[1:0];
        I_STCFG:   ctl_q.stcfg <= data[2:0];
        I_STLEN:   ctl_q.stlen <= data[6:0];
        I_STLVL:   ctl_q.stlvl <= data[8:0];
        I_ADDR:    ctl_q.addr <= data[7:0];
        I_AUTODEC: set_q.autodec <= data[0];
        I_OFFLINE: ctl_q.offline <= data[0];
        default:   ;
      endcase
    end

  // ---- causes that stop a motion ------------------------------------------------------------------------

  logic [2:0][1:0] ext_h;  // [n]: levels of EXT2 and EXT1, n + 1 cycles ago
  logic [1:0] edges, flags_q;
  logic key, cause;
  logic sampled_q, low_q, counts, stalls, stall_q;  // as in pmc006_stall_fv
  logic [7:0] row_q, needed;

  assign edges = ctl_q.exten & (ext_h[1] ^ ext_h[2]) & ~(ext_h[1] ^ ctl_q.trigm);
  assign key = dut.u_control.key_stop;
  assign counts = sampled_q && low_q && ctl_q.stcfg[0] && !stall_q && mon_busy && dut.motion.steady;
  assign needed = (ctl_q.stlen == '0) ? 8'd1 : {1'b0, ctl_q.stlen};
  assign stalls = counts && row_q >= needed - 8'd1;
  // verilog_format: off
  assign cause = edges != '0 || key || (ctl_q.stcfg[1] && mon_busy && (stall_q || stalls)) || (exec && op
      == I_ABORT) || (exec && legal && op == I_FREE && data[0]);
  // verilog_format: on

  always_ff @(posedge clk_i or negedge on)
    if (!on) {ext_h, flags_q, sampled_q, stall_q} <= {6'b111111, 4'd0};
    else begin
      ext_h <= {ext_h[1:0], ext2, ext1};
      flags_q <= edges | (flags_q & ~{exec && op == I_CLEAR2, exec && op == I_CLEAR1});
      sampled_q <= bemf_valid;
      stall_q <= stalls || (stall_q && !(exec && op == I_STALL) && !begins);
    end

  always_ff @(posedge clk_i) begin
    if (bemf_valid) low_q <= bemf_level < 10'(ctl_q.stlvl);
    if (!mon_busy) row_q <= '0;
    else if (sampled_q) row_q <= !counts ? '0 : (row_q == '1) ? row_q : row_q + 8'd1;
  end

  // ---- motion -------------------------------------------------------------------------------------------

  logic may_start, starts, runs, resumes;
  logic limits_q;  // in the last cycle, VSTART and VSTOP were at most VMAX
  logic going_q, going_q2, cause_q, busy_q, began_q, endless_q;  // …_q2: one cycle later
  logic speed_q, speed_q2;  // register SPEED_MODE; resumed in this cycle counts in speed_q2
  logic [30:0] left_q;
  logic step, step_q;  // step_q: at the pin
  logic [31:0] pos_q, stpos_q;
  logic [8:0] angle_q, turn_q;  // turn_q: angle of a step of the motion

  assign may_start = exec && legal && !mon_busy && !set_q.free && flags_q == '0 && edges == '0 && !key;
  assign starts = may_start && op == I_STEP && limits_q;
  assign runs = may_start && op == I_RUN && data[0] && set_q.vmax != '0;
  assign begins = starts || runs;
  assign resumes = exec && legal && op == I_RUN && data[0] && mon_busy && endless_q && edges == '0 && !key;
  assign step = dut.step;

  always_ff @(posedge clk_i or negedge on)
    if (!on) begin
      {going_q, going_q2, cause_q, busy_q, began_q, speed_q, speed_q2, step_q, pos_q, stpos_q} <= '0;
      angle_q <= 9'd64;
    end else begin
      going_q  <= begins || (going_q && !cause);
      going_q2 <= going_q && !cause;
      cause_q  <= cause;
      busy_q   <= mon_busy;
      began_q  <= begins;
      speed_q2 <= speed_q || resumes;
      if (cause || (exec && legal && op == I_RUN && !data[0])) speed_q <= 1'b0;
      else if (runs || resumes) speed_q <= 1'b1;
      step_q <= step;
      if (set_position) pos_q <= data;
      else if (step) pos_q <= pos_q + (mon_dir ? 32'd1 : '1);
      if (step) angle_q <= mon_dir ? angle_q + turn_q : angle_q - turn_q;
      if (stalls) stpos_q <= pos_q;
    end

  always_ff @(posedge clk_i) begin
    limits_q <= 14'(set_q.vstart) <= set_q.vmax && 14'(set_q.vstop) <= set_q.vmax;
    if (begins) {endless_q, left_q} <= {runs, data[30:0]};
    else if (step) left_q <= left_q - 31'd1;
    if (begins) begin
      turn_q <= 9'd128;
      for (int unsigned n = 1; n < 8; n++) if (set_q.mstep == 8'(1 << n)) turn_q <= 9'(128 >> n);
    end
  end

  logic forward_q;
  always_ff @(posedge clk_i or negedge on)
    if (!on) forward_q <= 1'b1;
    else if (begins) forward_q <= set_q.dir;

  logic [2:0] us_phase;  // cycles since the last µs tick
  logic us, first, run, due;
  assign us_phase = dut.u_us.g_phase.phase_q;
  assign us = dut.us;
  assign first = dut.u_motion.start_q;  // first cycle of a motion
  assign run = dut.u_motion.u_rate.run_q;
  assign due = dut.u_motion.u_rate.step_pending_q;

  // ---- lemmas: frames -----------------------------------------------------------------------------------

  logic boot, of_boot, in_frame;  // in_frame: the frame is executed
  logic [3:0] ee;
  logic rx_off;
  logic [6:0] bit_phase;

  assign boot = dut.boot;
  assign ee = dut.u_control.u_eeprom.state_q;
  assign of_boot = cmd.source == FromBoot;
  assign in_frame = of_frame && ex inside {ExCheck, ExExec, ExReply};
  assign rx_off = dut.u_serial.rx_off_q;
  assign bit_phase = dut.u_serial.phase_q;

  // The reply, as in pmc006_serial_fv, with a bit of 80 cycles.
  logic active_q, next_bit;
  logic [3:0] byte_q, bit_q;
  logic [6:0] units_q;
  logic lead, last, first_half, tail, rx_idle;
  logic [7:0] phase;

  logic [1:0] rx_state;
  logic [6:0] rx_phase;
  assign rx_state = dut.u_serial.u_rx.state_q;
  assign rx_phase = dut.u_serial.u_rx.phase_q;
  assign next_bit = units_q == 7'd79;
  assign lead = active_q && byte_q == '0 && bit_q == 4'd8;
  assign last = active_q && byte_q == 4'd8 && bit_q == 4'd9;
  assign first_half = last && units_q < 7'd40;
  assign tail = last && units_q >= 7'd40;
  assign phase = 8'(units_q) + (first_half ? 8'd41 : 8'd1);
  assign rx_idle = rx_state == 2'd0 && rx_phase == 7'd88 && !dut.u_serial.u_rx.g_modulus.wrapped_q;

  always_ff @(posedge clk_i) begin
    units_q <= (next_bit || go) ? 7'(go) : units_q + 7'd1;
    if (go) {byte_q, bit_q} <= {4'd0, 4'd8};
    else if (next_bit) begin
      bit_q <= bit_q + 1'b1;
      if (bit_q == 4'd9) {bit_q, byte_q} <= {4'd0, byte_q + 1'b1};
    end
  end

  always_ff @(posedge clk_i or negedge on)
    if (!on) active_q <= 1'b0;
    else active_q <= go || (active_q && !(next_bit && byte_q == 4'd8 && bit_q == 4'd9));

  // verilog_format: off
  `FV_LEMMA(
      lemma_range,
      !active_q || (byte_q <= 4'd8 && bit_q <= 4'd9 && (byte_q != '0 || bit_q >= 4'd8) && units_q < 7'd80))
  // verilog_format: on
  `FV_LEMMA(lemma_tick, !active_q || dut.u_serial.bit_tick_q == (phase >= 8'd80))
  `FV_LEMMA(lemma_phase, !active_q || bit_phase == (phase >= 8'd80 ? 7'(phase - 8'd80) : 7'(phase + 8'd48)))
  `FV_LEMMA(lemma_byte, !active_q || dut.u_serial.byte_index_q == byte_q)
  `FV_LEMMA(lemma_bit, !active_q || dut.u_serial.bits_left_q == (byte_q == '0 ? 4'd0 : 4'd9 - bit_q))
  `FV_LEMMA(lemma_driver, de == (active_q && (byte_q != '0 || bit_q == 4'd9)))
  `FV_LEMMA(lemma_rx_off, rx_off == (active_q && !tail))
  // verilog_format: off
  `FV_LEMMA(
      lemma_valid,
      !(dut.u_serial.valid || dut.u_serial.error) || (rx_state != 2'd1 && rx_state != 2'd2 && rx_phase
          == 7'd88 && !dut.u_serial.u_rx.g_modulus.wrapped_q))
  // verilog_format: on
  `FV_LEMMA(lemma_no_valid, !(dut.u_serial.valid && active_q))
  // verilog_format: off
  `FV_LEMMA(
      lemma_rx_start,
      !lead || rx_idle || (rx_state == 2'd1 && !dut.u_serial.u_rx.g_modulus.wrapped_q
          && 8'(rx_phase) <= 8'd88 + 8'(units_q) && rx_phase >= 7'd89 && (units_q < 7'd4
          || 8'(rx_phase) >= 8'd85 + 8'(units_q))))
  `FV_LEMMA(
      lemma_rx_tail,
      !tail || rx_idle || (rx_state == 2'd1 && !dut.u_serial.u_rx.g_modulus.wrapped_q
          && 8'(rx_phase) <= 8'd48 + 8'(units_q) && rx_phase >= 7'd89))
  // verilog_format: on
  `FV_LEMMA(lemma_rx_idle, !active_q || lead || tail || rx_idle)
  // verilog_format: off
  `FV_LEMMA(
      lemma_gate,
      !active_q || (lead && units_q < 7'd2) || (tail && units_q >= 7'd41) || !dut.u_serial.line_high_q)
  `FV_LEMMA(
      lemma_first,
      !active_q || (lead && units_q < 7'd3) || (tail && units_q >= 7'd42) || dut.u_serial.u_rx.u_sync.q1_o)
  `FV_LEMMA(
      lemma_second,
      !active_q || (lead && units_q < 7'd4) || (tail && units_q >= 7'd43) || dut.u_serial.u_rx.line)
  // verilog_format: on

  `FV_LEMMA(lemma_place, dut.u_serial.u_frame.index_q == place_q)
  `FV_LEMMA(lemma_head, place_q < 1 || bytes_q[0] == 8'hA5)
  `FV_LEMMA(lemma_sum, place_q < 1 || dut.u_serial.u_frame.sum_q == sum_q)
  `FV_LEMMA(lemma_address, place_q < 2 || dut.u_serial.u_frame.addr_match_q == mine_q)
  `FV_LEMMA(lemma_code, place_q < 3 || dut.u_serial.u_frame.code_q == bytes_q[2])
  logic [3:0] same;  // [n]: byte n of the data, from the last one on
  always_comb
    for (int unsigned n = 0; n < 4; n++)
      same[n] = place_q < 4 + n || dut.u_serial.u_frame.data_q[31-8*n-:8] == bytes_q[place_q-1-3'(n)];
  `FV_LEMMA(lemma_data, same == '1)
  // verilog_format: off
  `FV_LEMMA(
      lemma_frame,
      frame_q == '0 || (bytes_q[0] == 8'hA5 && dut.u_serial.u_frame.code_q == bytes_q[2]
          && dut.u_serial.u_frame.data_q == bytes_q[6:3]))
  // verilog_format: on
  `FV_LEMMA(lemma_no_byte, frame_q == '0 || (lead && units_q == 7'(frame_q)))
  `FV_LEMMA(lemma_in_frame, !on || (frame_q != '0) == (pending || in_frame))
  // verilog_format: off
  `FV_LEMMA(
      lemma_pending,
      !pending || (frame_q != '0 && ex <= ExExec && frame_q <= (ex == ExIdle ? 4'd6 : 4'(ex)) && (ex == ExIdle
          || cmd.source == FromProgram)))
  `FV_LEMMA(
      lemma_age,
      !in_frame || (!pending && frame_q <= (ex == ExCheck ? 4'd7 : ex == ExReply ? 4'd10 : us_phase == 3'd3
          ? 4'd9 : 4'd8)))
  `FV_LEMMA(
      lemma_try,
      cmd.source != FromTry || !(ex inside {ExFirst, ExSecond, ExDecode, ExCheck, ExExec}) || (lead
          && units_q <= 7'd11 + 7'(ex)))
  // verilog_format: on
  `FV_LEMMA(lemma_exec, ex <= ExReply && (ex != ExReply || of_frame))
  `FV_LEMMA(lemma_word_states, !(ex inside {ExFirst, ExSecond, ExDecode}) || of_program)
  `FV_LEMMA(lemma_try_next, !dut.u_control.u_exec.try_next_q || !on || (ex == ExReply && of_frame))
  // verilog_format: off
  `FV_LEMMA(
      lemma_of_boot,
      !of_boot || ex == ExIdle || (boot && ee == 4'd11 && dut.u_control.u_eeprom.phase_q == (ex == ExCheck
          ? 3'd4 : 3'd5) && ex inside {ExCheck, ExExec}))
  // verilog_format: on
  `FV_LEMMA(lemma_boot, !boot || (frame_q == '0 && !rx_off && !de && place_q == '0))
  // verilog_format: off
  `FV_LEMMA(
      lemma_read,
      !dut.u_control.u_eeprom.read_q || (boot && !dut.u_control.u_eeprom.factory_q && ee inside {[4'd2
          : 4'd9]}))
  // verilog_format: on
  `FV_LEMMA(lemma_load, !(ee inside {4'd10, 4'd11}) || (boot && !dut.u_control.u_eeprom.factory_q))
  // verilog_format: off
  `FV_LEMMA(
      lemma_bus,
      !(dut.u_control.u_eeprom.done || dut.u_control.u_eeprom.fail) || ee inside {[4'd1 : 4'd9]})
  // verilog_format: on

  // ---- lemmas: instruction ------------------------------------------------------------------------------

  logic [7:0] rom_op;
  logic [29:0] limits, limits_of_op;
  assign rom_op = dut.u_control.u_exec.op_q;
  assign limits = dut.u_control.u_exec.u_data_check.limits_q;
  assign limits_of_op = dut.u_control.u_exec.u_data_check.rom[{of_program, rom_op}];
  `FV_LEMMA(lemma_limits, !(ex inside {ExCheck, ExExec, ExReply}) || limits == limits_of_op)
  `FV_LEMMA(lemma_op, !in_frame || (rom_op == op && cmd.data == data && cmd.option == '0))
  // verilog_format: off
  `FV_LEMMA(
      lemma_no_host_op,
      !(ex inside {ExCheck, ExExec}) || of_frame
          || !(rom_op inside {I_POS_SET, I_TRY, I_START, I_PUT, I_GET, I_BURN, I_SAVE, I_POINTER}))
  `FV_LEMMA(
      lemma_boot_op,
      !(of_boot && ex inside {ExCheck, ExExec})
          || !(rom_op inside {I_STEP, I_RUN, P_OUT, P_WAIT, P_RESET_EN, P_PAUSE_EN}))
  `FV_LEMMA(
      lemma_legal,
      !(exec || set_position) || dut.u_control.legal == legal
          || !(op inside {I_STEP, I_MSTEP, I_RUN, I_DIR, I_FREE, I_OFFLINE, I_AUTODEC, I_EXTEN, I_TRIGGER,
          I_VSTART, I_VSTOP, I_VMAX, I_STCFG, I_STLEN, I_STLVL, I_ADDR}))
  // verilog_format: on
  `FV_LEMMA(lemma_settings, motor_key(dut.settings) == motor_key(set_q))
  `FV_LEMMA(lemma_mstep, legal_mstep(set_q.mstep))
  `FV_LEMMA(lemma_control, control_key(dut.u_control.control) == control_key(ctl_q))

  // ---- lemmas: motion -----------------------------------------------------------------------------------

  `FV_LEMMA(lemma_us, us == (us_phase == '0))
  // verilog_format: off
  `FV_LEMMA(
      lemma_us_times,
      (!dut.u_motion.u_rate.accumulate_q || us_phase == 3'd1) && (!due || us_phase == 3'd2) && (!mon_step
          || us_phase == 3'd3))
  // verilog_format: on
  `FV_LEMMA(lemma_run, !mon_busy || run || !(dut.u_motion.u_rate.accumulate_q || due))
  `FV_LEMMA(lemma_pins, dut.ext_sync == ext_h[1] && dut.u_control.u_ext_stop.ext_prev_q == ext_h[2])
  `FV_LEMMA(lemma_flags, dut.u_control.flags == flags_q)
  `FV_LEMMA(lemma_stall, dut.u_control.stall == stall_q && dut.u_control.u_stall.sample_q == sampled_q)
  `FV_LEMMA(lemma_low, !sampled_q || dut.u_control.u_stall.low_q == low_q)
  `FV_LEMMA(lemma_row, !mon_busy || dut.u_control.u_stall.count_q == (row_q[7] ? 7'd127 : row_q[6:0]))
  `FV_LEMMA(lemma_limits_of_speed, !exec || dut.u_control.u_start_check.limits_q == limits_q)
  `FV_LEMMA(lemma_speed_mode, dut.u_control.speed_mode == speed_q && (!speed_q || (mon_busy && endless_q)))
  // verilog_format: off
  `FV_LEMMA(
      lemma_kind,
      !mon_busy || (dut.u_control.u_start_check.endless_q == endless_q && dut.u_motion.speed_q == endless_q))
  `FV_LEMMA(
      lemma_begin,
      first == began_q && (!first || (mon_busy && !due && !run && !dut.u_motion.u_rate.planned)))
  // verilog_format: on
  `FV_LEMMA(lemma_left, !mon_busy || dut.u_motion.u_rate.left_o == left_q)
  `FV_LEMMA(lemma_left_some, !mon_busy || endless_q || left_q != '0)
  // verilog_format: off
  `FV_LEMMA(
      lemma_last,
      !mon_busy || first || (run && us_phase == 3'd3) || dut.u_motion.u_rate.last_step_q == (left_q == 31'd1))
  // verilog_format: on
  `FV_LEMMA(lemma_turn, !mon_busy || 9'(dut.u_motion.increment_q) == turn_q)
  `FV_LEMMA(lemma_direction, mon_dir == forward_q)

  // ---- properties of a motion ---------------------------------------------------------------------------

  `FV_LEMMA(stop_no_step, !on || !mon_step || (going_q2 && !cause_q))
  `FV_LEMMA(stop_not_busy, !on || !mon_busy || going_q)
  `FV_LEMMA(stop_in_the_cycle, !on || dut.halt == cause)
  `FV_LEMMA(stop_before_the_position, !(set_position && step))
  `FV_LEMMA(start_in_the_cycle, !on || {dut.motion_start.start, dut.motion_start.run} == {starts, runs})
  `FV_LEMMA(start_begins, !on || (mon_busy && !busy_q) == began_q)
  `FV_LEMMA(count_pin, mon_step == step_q)
  `FV_LEMMA(count_no_more, !step || endless_q || left_q != '0)
  // verilog_format: off
  `FV_LEMMA(
      count_or_a_cause,
      !on || !busy_q || mon_busy || cause_q || (endless_q ? !speed_q2 : mon_step && left_q == '0))
  // verilog_format: on
  `FV_LEMMA(count_position, !on || dut.u_control.position == pos_q)
  `FV_LEMMA(count_angle, !on || dut.u_drive.angle_q == angle_q)

  // ---- the planner ends in time -------------------------------------------------------------------------

  logic [9:0] motion_age_q, plan_left;
  logic [9:0] since;  // cycles of the motion since t = 0 or the last update tick
  logic [6:0] ticks;
  assign ticks = dut.u_motion.u_rate.ticks_q;
  assign since = 10'(ticks) * 10'd8 + (us_phase == '0 ? 10'd8 : 10'(us_phase));
  assign plan_left = dut.u_motion.u_calc.left_q;
  always_ff @(posedge clk_i) begin
    if (!mon_busy) motion_age_q <= '0;
    else if (motion_age_q != '1) motion_age_q <= motion_age_q + 10'd1;
  end

  // verilog_format: off
  `FV_LEMMA(
      lemma_planned,
      !mon_busy || dut.u_motion.u_rate.u_plan.count_q == (motion_age_q < 10'd799 ? motion_age_q : 10'd799))
  `FV_LEMMA(
      lemma_plan,
      plan_left <= 10'd785 && (!mon_busy || run || ((motion_age_q == '0) == first && (first || plan_left == '0
          || 11'(plan_left) + 11'(motion_age_q) <= 11'd786))))
  `FV_LEMMA(
      lemma_advance,
      !(mon_busy && run) || (ticks <= 7'd99 && motion_age_q >= 10'd799 && (since < 10'd4 ? plan_left == '0
          : plan_left == '0 || 11'(plan_left) + 11'(since) <= 11'd594)))
  `FV_LEMMA(
      lemma_advance_times,
      (!dut.u_motion.u_rate.update_dly_q[0] || since == 10'd1) && (!dut.u_motion.u_rate.update_dly_q[1]
          || since == 10'd2) && (!dut.u_motion.advance || since == 10'd3) && (!mon_busy || run
          || {dut.u_motion.u_rate.update_dly_q, dut.u_motion.advance} == '0))
  `FV_LEMMA(
      ready_planner,
      plan_left == '0 || !(dut.u_motion.t0 || dut.u_motion.update || (dut.u_motion.advance && mon_busy)))
  // verilog_format: on

  // ---- boot ---------------------------------------------------------------------------------------------

  logic stored, page_bad;
  assign stored   = dut.u_control.u_eeprom.store_q;
  assign page_bad = dut.u_control.u_eeprom.page_bad_q;

  // A parameter that was accepted when the page was checked is also accepted when it is loaded.
  // verilog_format: off
  `FV_ASSUME(
      page_stands,
      !(stored && ee == 4'd11 && dut.u_control.u_eeprom.phase_q == 3'd5) || dut.u_control.u_eeprom.load_op_o
          == I_NONE || dut.u_control.legal)
  // verilog_format: on

  `FV_LEMMA(lemma_stored, !stored || (boot && (ee == 4'd12 || (ee == 4'd11 && !page_bad))))
  `FV_LEMMA(lemma_offline, !boot || !ctl_q.offline || (stored && !page_bad))
  `FV_LEMMA(lemma_factory, !(boot && dut.u_control.u_eeprom.factory_q) || !dut.u_control.rst_settings_n)
  // verilog_format: off
  `FV_LEMMA(
      boot_no_motion,
      !boot || (!mon_busy && dut.u_control.u_program.state_q == 0 && !dut.u_control.u_program.rsten_q && (ex
          == ExIdle || of_boot)))
  // verilog_format: on

  // ---- reply --------------------------------------------------------------------------------------------

  logic known, known_q, accepted_q, sampled_reply_q;
  logic exec_q, set_position_q;
  logic [31:0] expected, expected_q, reply_q;
  logic [7:0] reply_sum_q, char_q, next_char;
  logic line;
  logic [4:0] gpo_q, gpo_pins_q;
  logic [1:0][4:0] gpi_h;

  // Reply of the instructions that have no register of their own.
  always_comb begin
    known = 1'b1;
    unique case (op)
      I_ABORT, I_POS_SET: expected = data;
      I_STEP: expected = accepted_q ? 32'd3 : 32'd0;
      I_POS: expected = pos_q;
      I_STPOS: expected = stpos_q;
      I_RUN: expected = 32'(speed_q);
      I_STATUS1: expected = 32'({stall_q, set_q.autodec, flags_q, mon_busy});
      I_STATUS2: expected = 32'({ctl_q.offline, set_q.dir, speed_q, ctl_q.exten, set_q.free});
      I_PORTS: expected = 32'({ext_h[1], gpi_h[1][4:3], gpo, gpi_h[1][2:0]});
      I_OUT: expected = 32'({gpo_q, 3'd0});
      I_CLEAR1, I_CLEAR2, I_STALL, I_NONE: expected = '0;
      default: {known, expected} = '0;
    endcase
  end

  always_comb begin
    unique case (byte_q)
      4'd0: next_char = 8'hA5;
      4'd1: next_char = 8'h7A;
      4'd2: next_char = ctl_q.addr;
      4'd3: next_char = reply_q[7:0];
      4'd4: next_char = reply_q[15:8];
      4'd5: next_char = reply_q[23:16];
      4'd6: next_char = reply_q[31:24];
      default: next_char = reply_sum_q;
    endcase
  end

  assign line = !active_q || byte_q == '0 || bit_q == 4'd9 || (bit_q != '0 && char_q[3'(bit_q-1'b1)]);

  always_ff @(posedge clk_i) begin
    accepted_q <= starts;
    {known_q, expected_q} <= {known, expected};
    if (sampled_reply_q) reply_q <= dut.reply;
    if (go) reply_sum_q <= '0;
    else if (active_q && next_bit && bit_q == 4'd9) begin
      char_q <= next_char;
      reply_sum_q <= reply_sum_q + next_char;
    end
  end

  always_ff @(posedge clk_i or negedge on)
    if (!on) {exec_q, set_position_q, sampled_reply_q, gpo_q, gpo_pins_q, gpi_h} <= {13'd0, 10'h3FF};
    else begin
      {exec_q, set_position_q, sampled_reply_q} <= {exec, set_position, reply_sample};
      gpi_h <= {gpi_h[0], gpi};
      gpo_pins_q <= gpo_q | {stall_q && ctl_q.stcfg[2], 4'd0};
      if (exec && op == I_OUT) gpo_q <= data[7:3];
      for (int unsigned n = 0; n < 5; n++)
      if (exec && op == P_OUT && cmd.option == 4'(n + 1)) gpo_q[n] <= data[0];
    end

  `FV_LEMMA(lemma_stall_position, dut.u_control.stall_position == stpos_q)
  `FV_LEMMA(lemma_accepted, ex != ExReply || op != I_STEP || dut.u_control.accepted_q == accepted_q)
  `FV_LEMMA(lemma_inputs, dut.gpi_sync == gpi_h[1])
  `FV_LEMMA(lemma_outputs, dut.u_control.gpo_reg == gpo_q)
  `FV_LEMMA(lemma_sampled, !sampled_reply_q || (lead && frame_q == '0 && units_q <= 7'd11))
  `FV_LEMMA(lemma_reply, !active_q || frame_q != '0 || sampled_reply_q || dut.reply == reply_q)
  `FV_LEMMA(lemma_bits, !active_q || byte_q == '0 || dut.u_serial.bits_q == 8'({9'h1FF, char_q} >> bit_q))
  // verilog_format: off
  `FV_LEMMA(
      lemma_reply_sum,
      !active_q || dut.u_serial.sum_q == ((byte_q == '0 || bit_q != '0) ? reply_sum_q : reply_sum_q - char_q))
  // verilog_format: on

  `FV_LEMMA(reply_after_execution, !reply_sample || (op == I_POS_SET ? set_position_q : exec_q))
  `FV_LEMMA(reply_data, !sampled_reply_q || !known_q || dut.reply == expected_q)
  `FV_LEMMA(reply_bits, txd == line)
  `FV_LEMMA(reply_of_a_frame, !de || active_q)
  `FV_LEMMA(reply_once, !go || (!active_q && frame_q == '0 && !boot))
  `FV_LEMMA(ports_outputs, gpo == gpo_pins_q && {ext2_pu, ext1_pu} == ~ctl_q.trigm)

  // ---- no lock-up ---------------------------------------------------------------------------------------

  logic [ 9:0] rest_q;  // cycles in which the line is at rest, at most 1023
  logic [ 6:0] rx_now;  // phase of the bit, 48 .. 127
  logic [10:0] rx_left;  // cycles to the middle of the stop bit
  assign rx_now  = rx_phase + (dut.u_serial.u_rx.g_modulus.wrapped_q ? 7'd48 : 7'd0);
  // verilog_format: off
  assign rx_left = 11'd128 - 11'(rx_now) + 11'd80 * (rx_state == 2'd1 ? 11'd9
      : 11'(dut.u_serial.u_rx.bits_left_q));
  // verilog_format: on

  always_ff @(posedge clk_i or negedge on)
    if (!on) rest_q <= '0;
    else rest_q <= !rxd ? '0 : (rest_q == '1) ? rest_q : rest_q + 10'd1;

  // verilog_format: off
  `FV_LEMMA(
      lemma_rx,
      !(rx_state inside {2'd1, 2'd2}) || (rx_now >= (rx_state == 2'd1 ? 7'd88 : 7'd48) && rx_left <= 11'd760
          && (rest_q < 10'd4 || 11'(rest_q) + rx_left <= 11'd764)))
  `FV_LEMMA(
      lemma_rx_wrapped,
      !on || !dut.u_serial.u_rx.g_modulus.wrapped_q || (rx_state == 2'd2 && rx_phase == '0))
  `FV_LEMMA(
      lemma_rx_line,
      (rest_q < 10'd1 || dut.u_serial.u_rx.u_sync.q1_o) && (rest_q < 10'd2 || (dut.u_serial.u_rx.line
          && dut.u_serial.line)) && (rest_q < 10'd1 || dut.u_serial.u_line.q1_o))
  // verilog_format: on
  `FV_LEMMA(lemma_rx_idle_phase, rx_state != 2'd0 || rx_phase inside {[7'd88 : 7'd89]})

  `FV_LEMMA(ready_instruction, frame_q <= 4'd10)
  `FV_LEMMA(ready_receiver, !on || rest_q < 10'd765 || rx_state == 2'd0)

  // ---- bridges and excitation ---------------------------------------------------------------------------

  logic off, bridge_q;
  logic [5:0] off_age_q;  // consecutive cycles without current, at most 63
  logic [1:0] a_q, b_q;  // {m11, m10}, {m21, m20}
  logic [4:0] refs_cycle;
  assign off = boot || set_q.free;
  assign refs_cycle = dut.u_drive.u_refs.cycle_q;

  always_ff @(posedge clk_i or negedge on)
    if (!on) {bridge_q, off_age_q, a_q, b_q} <= '0;
    else begin
      bridge_q   <= !off;
      off_age_q  <= !off ? '0 : (off_age_q == '1) ? off_age_q : off_age_q + 6'd1;
      {a_q, b_q} <= {m11, m10, m21, m20};
    end

  `FV_LEMMA(lemma_bridge_a, dut.u_drive.u_bridge_a.state_q != 0 || {m11, m10} == '0)
  `FV_LEMMA(lemma_bridge_b, dut.u_drive.u_bridge_b.state_q != 0 || {m21, m20} == '0)
  // verilog_format: off
  `FV_LEMMA(
      lemma_refs_off,
      (refs_cycle == '0 ? off_age_q < 6'd32 : off_age_q < 6'(refs_cycle)) || dut.u_drive.u_refs.off_q)
  `FV_LEMMA(
      lemma_refs_zero,
      !dut.u_drive.u_refs.off_q || refs_cycle == '0 || ((refs_cycle < 5'd3 || dut.u_drive.u_refs.reduced_q
          == '0) && (refs_cycle < 5'd9 || dut.u_drive.u_refs.product_q
          == 9'(9'd256 >> (refs_cycle - 5'd8)) >> 1 || refs_cycle > 5'd16) && (refs_cycle < 5'd17
          || dut.u_drive.u_refs.a_q == '0) && (refs_cycle < 5'd17 || refs_cycle > 5'd24
          || dut.u_drive.u_refs.product_q == 9'(9'd128 >> (refs_cycle - 5'd16)))))
  `FV_LEMMA(
      lemma_refs,
      !(off_age_q >= 6'd32 + 6'(refs_cycle) || (refs_cycle >= 5'd25 && off_age_q >= 6'(refs_cycle)))
          || {phase_a_ref, phase_b_ref, phase_a_sign, phase_b_sign} == '0)
  `FV_LEMMA(
      bridge_off,
      bridge_a_en == bridge_q && bridge_b_en == bridge_q && (bridge_q || {m10, m11, m20, m21} == '0))
  // verilog_format: on
  `FV_LEMMA(bridge_legal, {m10, m11} != '1 && {m20, m21} != '1)
  `FV_LEMMA(bridge_off_between, !(m10 && a_q[1]) && !(m11 && a_q[0]) && !(m20 && b_q[1]) && !(m21 && b_q[0]))
  // verilog_format: off
  `FV_LEMMA(
      bridge_no_current,
      off_age_q < 6'd56 || {phase_a_ref, phase_b_ref, phase_a_sign, phase_b_sign} == '0)
  // verilog_format: on

  // ---- reset --------------------------------------------------------------------------------------------

  // verilog_format: off
  `FV_ASSERT(
      reset_pins,
      pin_rst_n
          || ({de, gpo, phase_a_ref, phase_a_sign, phase_b_ref, phase_b_sign, pwm_a_ref, pwm_b_ref,
          bridge_a_en, bridge_b_en, m10, m11, m20, m21, scl_oe, sda_oe, mon_step, mon_busy}
          == '0 && txd && ext1_pu && ext2_pu && mon_dir))
  `FV_ASSERT(
      reset_state,
      pin_rst_n || (boot && dut.u_control.position == '0 && dut.u_control.flags == '0 && !dut.u_control.stall
          && !pending && ex == ExIdle))
  // verilog_format: on

  `FV_COVER(seen_reset, !on && !later_q)
  `FV_COVER(seen_step, mon_step && !mon_dir && left_q == 31'd3 && $past(on))
  `FV_COVER(seen_stop, busy_q && !mon_busy && cause_q && flags_q != '0)
  `FV_COVER(seen_end, busy_q && !mon_busy && !cause_q && !endless_q)
  `FV_COVER(seen_reply, tail && units_q == 7'd79 && rx_state == 2'd1)
  `FV_COVER(seen_data, sampled_reply_q && known_q && expected_q == 32'd3 && $past(on))
  `FV_COVER(seen_rest, rest_q == '1 && rx_state == 2'd0 && !boot)

endmodule

`default_nettype wire
