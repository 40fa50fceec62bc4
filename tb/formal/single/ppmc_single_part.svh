// SPDX-License-Identifier: Apache-2.0
// verilog_syntax: parse-as-module-body
// Signals of a part with the core ppmc_single, for ppmc_axis_part.svh. The modules ppmc104_fv and stmc_fv
// include this file, then ppmc_axis_part.svh.

  localparam int unsigned Age = ppmc_lfsr_pkg::width(40 - 1);
  logic on;  // 1: the part is out of reset
  motion_t motion;
  motion_event_t now;
  stop_cause_t cause;
  logic ibf, obf, building, wr, wr_a0, take, load, rd_done, start, exc_off, phase_init, low;
  logic [7:0] wr_data;
  logic [23:0] left;
  logic [Age-1:0] shaper_age;
  logic limit_cw_n, limit_ccw_n, alarm_n, moved, is_idle, pins_at_rest,
      addressed, is_read, must_answer, positive_now;

  assign on         = dut.rst_core_n;
  assign motion     = dut.u_single.motion_o;
  assign now        = dut.u_single.event_now;
  assign cause      = dut.u_single.cause;
  assign start      = dut.u_single.act_o.start;
  assign exc_off    = dut.u_single.act_o.exc_off;
  assign phase_init = dut.u_single.phase_init;
  assign building   = dut.u_single.building;
  assign left       = dut.u_single.remaining;
  assign low        = dut.u_single.u_axis.u_shaper.low_o;
  assign shaper_age = dut.u_single.u_axis.u_shaper.age_q;
  assign ibf        = dut.u_single.u_host.ibf;
  assign obf        = dut.u_single.u_host.obf;
  assign wr         = dut.u_single.u_host.wr;
  assign wr_a0      = dut.u_single.u_host.wr_a0;
  assign wr_data    = dut.u_single.u_host.wr_data;
  assign rd_done    = dut.u_single.u_host.rd_done;
  assign take       = dut.u_single.take;
  assign load       = dut.u_single.act_req.read;

  assign addressed    = 1'b1;
  assign must_answer  = !motion.busy;
  assign is_idle = pins_at_rest && !motion.busy && !ibf && !obf && !building && dut.u_single.status == '0 &&
      !dut.u_single.initialised;
