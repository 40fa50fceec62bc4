// SPDX-License-Identifier: Apache-2.0
// ppmc2104_fv: proves a whole PPMC-2104 from its bus pins to its motor pins, with TIMING = "FAST", a clock of
// 8 MHz and a crystal of 16 MHz (a pulse has 40 cycles, a quantum 2 cycles). A word of the ramp tables may
// have any value in every cycle, and a table build takes five cycles. Host, bus style, switches, RUN, clock
// pins and reset pin are unconstrained. The properties of an axis hold for an arbitrary axis, while the other
// axis moves in any way.
// Bit 0 of an input is the pin of axis 1, because a trace needs ranges that begin with 0.
`include "ppmc_fv.svh"
`default_nettype none

module ppmc2104_fv
  import ppmc2104_pkg::*;
  import ppmc_motion_pkg::*;
(
    input wire logic       clk_i,
    input wire logic       pin_rst_n,
    input wire logic       second_i,   // arbitrary axis, 1: axis 2
    input wire logic       cs_n,
    input wire logic       a0,
    input wire logic       busc,
    input wire logic       ds_wrs_n,
    input wire logic       rw_rds_n,
    input wire logic [7:0] d_i,
    input wire logic       errint_n,
    input wire logic [1:0] run,
    input wire logic [1:0] extck,
    input wire logic [1:0] csel,
    input wire logic [1:0] fl_n,
    input wire logic [1:0] bl_n,
    input wire logic [1:0] fhl_n,
    input wire logic [1:0] bhl_n,
    input wire logic [1:0] org_n,
    input wire logic [1:0] alm_n,
    input wire logic [1:0] auxi
);

  localparam bit IdleLevel = 1'b1;
  logic [7:0] d_o;
  logic d_oe, int_n, clk_o;
  logic [2:1] pout_n, dir, hold;
  logic [5:1] s1_n, s2_n;
  logic [1:0] auxo;

  `FV_RESET

  ppmc2104 #(
      .CLK_HZ (8_000_000),
      .XTAL_HZ(16_000_000)
  ) dut (
      .clk  (clk_i),
      .rst_n(rst_ni && pin_rst_n),
      .*
  );

  `FV_ASSUME(one_axis, second_i == $past(second_i))

  // ---- signals for ppmc_axis_part.svh --------------------------------------------------------------

  localparam int unsigned Age = ppmc_lfsr_pkg::width(40 - 1);
  logic on;  // 1: the part is out of reset
  motion_t motion;
  motion_event_t now;
  motion_event_t [2:1] events;
  motion_t [2:1] motions;
  stop_cause_t cause;
  axis_action_t act;
  logic ibf, obf, building, wr, wr_a0, take, load, rd_done, start, exc_off, phase_init, low;
  logic [7:0] wr_data;
  logic [23:0] left;
  logic [Age-1:0] shaper_age;
  logic
      limit_cw_n,
      limit_ccw_n,
      slow_cw_n,
      slow_ccw_n,
      alarm_n,
      moved,
      is_idle,
      addressed,
      is_read,
      must_answer;
  logic positive_now, pout_nq;
  logic [5:1] s;

  assign on = dut.rst_core_n;
  assign motions = {dut.g_axis[2].u_axis.motion, dut.g_axis[1].u_axis.motion};
  assign events = {dut.g_axis[2].u_axis.event_now, dut.g_axis[1].u_axis.event_now};
  assign motion = second_i ? motions[2] : motions[1];
  assign now = second_i ? events[2] : events[1];
  assign cause = second_i ? dut.g_axis[2].u_axis.cause : dut.g_axis[1].u_axis.cause;
  assign phase_init = second_i ? dut.g_axis[2].u_axis.phase_init : dut.g_axis[1].u_axis.phase_init;
  assign left = second_i ? dut.g_axis[2].u_axis.remaining : dut.g_axis[1].u_axis.remaining;
  assign low = second_i ? dut.g_axis[2].u_axis.low : dut.g_axis[1].u_axis.low;
  assign shaper_age =
      second_i ? dut.g_axis[2].u_axis.u_axis.u_shaper.age_q : dut.g_axis[1].u_axis.u_axis.u_shaper.age_q;
  assign act = second_i ? dut.act.axis[2] : dut.act.axis[1];
  assign start = act.start;
  assign exc_off = act.exc_off;
  assign building = dut.building != '0;
  assign ibf = dut.u_host.ibf;
  assign obf = dut.u_host.obf;
  assign wr = dut.u_host.wr;
  assign wr_a0 = dut.u_host.wr_a0;
  assign wr_data = dut.u_host.wr_data;
  assign rd_done = dut.u_host.rd_done;
  assign take = dut.take;
  assign load = dut.read_axis || dut.act.aux_in;

  assign s = second_i ? s2_n : s1_n;
  assign limit_cw_n = second_i ? fl_n[1] : fl_n[0];
  assign limit_ccw_n = second_i ? bl_n[1] : bl_n[0];
  assign slow_cw_n = second_i ? fhl_n[1] : fhl_n[0];
  assign slow_ccw_n = second_i ? bhl_n[1] : bhl_n[0];
  assign alarm_n = second_i ? alm_n[1] : alm_n[0];

  `include "single/ppmc_axis_part.svh"

  logic own_pout_n, own_dir, run_now, gated_q;
  logic [1:0] run_h;

  assign own_pout_n = second_i ? pout_n[2] : pout_n[1];
  assign own_dir = second_i ? dir[2] : dir[1];
  assign run_now = run_h[1];  // level that the synchroniser outputs in this cycle
  assign moved = pout_nq && !own_pout_n;
  assign positive_now = 1'b0;
  assign addressed = code[5] == second_i;
  assign is_read = wr_a0 && ((wr_data[7:6] == 2'b10 && wr_data[4:3] == 2'b00 &&
      wr_data[2:0] inside {3'd0, 3'd1, 3'd2, 3'd3, 3'd6}) || wr_data == 8'hC2);
  // A read code that is accepted while data bytes are expected, or for a busy axis, is an error.
  assign must_answer = !dut.u_command.collecting && (code[6] || code[2:0] == 3'd6 ||
      !(code[5] ? motions[2].busy : motions[1].busy));
  assign is_idle = pout_n == '1 && s1_n == '1 && s2_n == '1 && dir == '0 && hold == '1 && int_n && !d_oe &&
      auxo == '1 && dut.busy == '0 && !ibf && !obf && !building && dut.errors == '0 && dut.collecting == '0 &&
      !dut.state[1].setup.initialised && !dut.state[2].setup.initialised;

  always_ff @(posedge clk_i or negedge on)
    if (!on) {pout_nq, run_h, gated_q} <= {1'b1, 2'b11, 1'b0};
    else begin
      pout_nq <= own_pout_n;
      run_h   <= {run_h[0], second_i ? run[1] : run[0]};
      if (start || run_now) gated_q <= !run_now;
    end

  `FV_ASSERT(no_pulse_at_standstill, own_pout_n || busy_h[0])
  `FV_ASSERT(no_pulse_with_wrong_dir, own_pout_n || own_dir == ccw_q)
  `FV_ASSERT(no_pulse_before_run, !(now.pulse && gated_q))
  `FV_ASSERT(no_start_at_a_cause, !start || (alarm_h[1] && (code[3] ? ccw_h[1] : cw_h[1])))

  // ---- causes of an early end ----------------------------------------------------------------------

  logic [1:0] slow_cw_h, slow_ccw_h;
  stop_cause_t seen_q;  // causes at the pins and in the bytes since the start

  always_ff @(posedge clk_i or negedge on)
    if (!on) {slow_cw_h, slow_ccw_h, seen_q} <= '0;
    else begin
      slow_cw_h  <= {slow_cw_h[0], slow_cw_n};
      slow_ccw_h <= {slow_ccw_h[0], slow_ccw_n};
      if (start) seen_q <= '0;
      else begin
        if (!alarm_h[1]) seen_q.alarm <= 1'b1;
        if (ccw_q ? !ccw_h[1] : !cw_h[1]) seen_q.limit <= 1'b1;
        if (ccw_q ? !slow_ccw_h[1] : !slow_cw_h[1]) seen_q.slow <= 1'b1;
        if (take && command_q && addressed && byte_q[7:6] == 2'b01 && byte_q[2:0] <= 3'd1)
          seen_q.stop <= 1'b1;
      end
    end

  `FV_ASSERT(count_cause_seen, !now.done || (cause & ~seen_q) == '0)

  // ---- bus styles ----------------------------------------------------------------------------------

  typedef struct packed {
    logic       cs_n;
    logic       style;
    logic       ds_wrs_n;
    logic       rw_rds_n;
    logic       a0;
    logic [7:0] data;
  } bus_t;

  // The manual: busc high, DS low and R/W low is a write; busc low, WRS low and RDS high is a write.
  function automatic logic is_write(bus_t p);
    return !p.cs_n && !p.ds_wrs_n && p.rw_rds_n != p.style;
  endfunction

  function automatic logic is_read_strobe(bus_t p);
    return !p.cs_n && (p.style ? !p.ds_wrs_n && p.rw_rds_n : !p.rw_rds_n && p.ds_wrs_n);
  endfunction

  bus_t [3:0] bus_h;  // bus_h[n]: pins n + 1 cycles ago
  logic [3:0] known_h;  // bus_h[n] was sampled after the reset
  logic same_style;

  always_comb begin
    same_style = known_h == '1;
    for (int unsigned n = 1; n < 4; n++) if (bus_h[n].style != bus_h[0].style) same_style = 1'b0;
  end

  always_ff @(posedge clk_i or negedge on)
    if (!on) {bus_h, known_h} <= '0;
    else begin
      bus_h   <= {bus_h[2:0], {cs_n, busc, ds_wrs_n, rw_rds_n, a0, d_i}};
      known_h <= {known_h[2:0], 1'b1};
    end

  `FV_ASSERT(bus_write, !same_style || wr == (is_write(bus_h[2]) && !is_write(bus_h[1])))
  `FV_ASSERT(bus_byte, !same_style || !wr || {wr_a0, wr_data} == {bus_h[2].a0, bus_h[2].data})
  `FV_ASSERT(bus_drive, !same_style || d_oe == is_read_strobe(bus_h[0]))

  // ---- errors and interrupt ------------------------------------------------------------------------

  logic [2:1] end_q, error_q, silent_q;  // end_q, error_q: pending causes of an interrupt
  cmd_error_e [2:1] register_q;  // error registers
  logic errint_q, errint_q2, pending_q, released;
  logic [5:0] release_age_q;  // cycles since a pending cause was cleared
  logic [2:0] needed_q;  // data bytes that the host must still write
  logic [2:1] reads_end, reads_error;

  function automatic logic [2:0] needed(logic [7:0] c);
    if (c[7:6] == 2'b00) return 3'd4;
    if (c[7:6] == 2'b10) return (c[2:0] == 3'd4) ? 3'd2 : (c[2:0] == 3'd5) ? 3'd1 : 3'd0;
    unique case (c[2:0])
      3'd3:       return 3'd3;
      3'd4:       return c[7] ? 3'd0 : 3'd4;
      3'd5, 3'd7: return c[7] ? 3'd0 : 3'd1;
      default:    return 3'd0;
    endcase
  endfunction

  for (genvar n = 1; n <= 2; n++) begin : g_reads
    assign reads_end[n]   = take && load && code == {2'b10, 1'(n - 1), 5'd0};
    assign reads_error[n] = take && load && code == {2'b10, 1'(n - 1), 5'd6};
  end
  assign released = ((reads_end & end_q) | (reads_error & error_q)) != '0;

  always_ff @(posedge clk_i or negedge on)
    if (!on) begin
      {end_q, error_q, silent_q, register_q, pending_q, needed_q} <= '0;
      {errint_q, errint_q2} <= '1;
      release_age_q <= '1;
    end else begin
      {errint_q2, errint_q} <= {errint_q, errint_n};
      for (int n = 1; n <= 2; n++) begin
        if (dut.act.axis[n].start) silent_q[n] <= code[4];
        if (dut.error_report.axis[n]) register_q[n] <= dut.error_report.number;
        else if (reads_error[n]) register_q[n] <= ErrNone;
        end_q[n]   <= (events[n].done && !silent_q[n]) || (end_q[n] && !reads_end[n]);
        error_q[n] <= (dut.error_report.axis[n] && !errint_q2) || (error_q[n] && !reads_error[n]);
      end
      pending_q     <= {end_q, error_q} != '0;
      release_age_q <= released ? '0 : (release_age_q == '1) ? '1 : release_age_q + 6'd1;
      if (take && command_q) needed_q <= (dut.error_report.axis != '0) ? '0 : needed(byte_q);
      else if (take && needed_q != '0) needed_q <= needed_q - 3'd1;
    end

  error_report_t report;
  logic data_wrong, code_wrong;

  assign report     = dut.error_report;
  assign data_wrong = take && !command_q && needed_q == '0;
  assign code_wrong = take && command_q && needed_q != '0;

  `FV_ASSERT(error_has_its_byte, report.axis == '0 || take)
  `FV_ASSERT(error_registers, !on || dut.errors == register_q)
  `FV_ASSERT(error_without_action, report.axis == '0 || report.number == ErrAbandoned || dut.act == '0)
  `FV_ASSERT(error_data_needed, !on || dut.u_command.params_left_q == needed_q)
  `FV_ASSERT(error_of_data, !data_wrong || (report.axis == 2'b01 && report.number == ErrData))
  `FV_ASSERT(error_of_code,
             !code_wrong || (report.axis != '0 && report.number inside {ErrAbandoned, ErrDecel}))
  `FV_ASSERT(int_has_a_cause, !on || int_n || pending_q)
  `FV_ASSERT(int_after_a_cause, !on || !int_n || !pending_q || release_age_q < 6'd42)

  `FV_COVER(seen_limit, blocked_q && ccw_q && busy_h[1])
  `FV_COVER(seen_answer, load && complete_q)
  `FV_COVER(seen_step, moved && index_q == 4'd2)
  `FV_COVER(seen_style, wr && byte_q == 8'h41 && bus_h[2].style && same_style)
  `FV_COVER(seen_error, dut.errors[2] == ErrBusy && !int_n && error_q == 2'b10)
  `FV_COVER(ready_seen, alarm_age_q > 6'd40 && busy_h[0] && !motion.busy && complete_q)

endmodule

`default_nettype wire
