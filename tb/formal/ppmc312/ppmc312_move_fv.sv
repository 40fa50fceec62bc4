// SPDX-License-Identifier: Apache-2.0
// ppmc312_move_fv: proves when an instruction starts or changes a motion, and with which values.
`include "ppmc_fv.svh"
`default_nettype none

module ppmc312_move_fv
  import ppmc312_pkg::*;
  import ppmc312_link_pkg::*;
  import ppmc312_instr_pkg::*;
  import ppmc312_stage_pkg::*;
(
    input wire logic                 clk_i,
    input wire logic                 begin_i,
    input wire block_t               block_i,
    input wire status_e              status_i,
    input wire table_t               table_i,
    input wire motor_inputs_t        levels_i,
    input wire logic          [15:0] limit_rate_i,
    input wire logic                 gate_i,
    input wire logic                 elapsed_i,
    input wire logic                 plan_busy_i,
    input wire logic          [ 7:0] plan_kind_i,
    input wire profile_t             profile_i
);

  move_status_t result_o;
  logic start_o, change_o, single_pulse_o;
  operation_t op_o;
  profile_t profile_o;
  profile_req_t profile_req_o;

  `FV_RESET

  ppmc312_move dut (.*);

  logic moves_q;  // an instruction is being executed
  logic changes, single, counts, hit, hit_q, ccw;
  logic [15:0] rate, rate_q;
  logic [7:0] code;
  logic [2:0] age_q;  // cycles since begin_i, at most 7
  logic plans_q, begun_q;  // plans_q: the planner was started; begun_q: an instruction has begun

  assign code = block_i.code;
  assign ccw = block_i.par[0][6];
  assign changes = code inside {I_RAMP, I_SPEED};
  assign single = code == I_STEP;
  assign counts = code inside {I_MOVE, I_CONST};
  assign rate    = single ? table_i.rate_acc :
      ({block_i.par[1], block_i.par[2]} == '0) ? table_i.high_rate : {block_i.par[1], block_i.par[2]};
  // The limit switches of the direction; a high-speed limit prevents rates as fast as HSL or faster.
  assign hit = ccw ? !levels_i.bl_n || (!levels_i.bhl_n && rate_q <= limit_rate_i) :
      !levels_i.fl_n || (!levels_i.fhl_n && rate_q <= limit_rate_i);

  always_ff @(posedge clk_i) begin
    if (!rst_ni) {moves_q, age_q, plans_q, begun_q} <= '0;
    else begin
      if (begin_i) {moves_q, age_q, plans_q, begun_q} <= {1'b1, 3'd0, 2'b01};
      else begin
        if (result_o.done) moves_q <= 1'b0;
        if (age_q != '1) age_q <= age_q + 3'd1;
        if (profile_req_o.start) plans_q <= 1'b1;
      end
    end
    if (begin_i) rate_q <= rate;
    if (age_q == '0) hit_q <= hit;
  end

  `FV_ASSUME(begins_when_idle, !begin_i || !moves_q)
  `FV_ASSUME(
      a_motion_code,
      !begin_i || code inside {I_ORIGIN, I_ZERO, I_MOVE, I_CONST, I_STEP, I_HIGH, I_CONT, I_RAMP, I_SPEED})
  `FV_ASSUME(stands, !moves_q || block_i == $past(block_i))
  `FV_ASSUME(short_form,
             code != I_STEP || {block_i.par[6], block_i.par[5], block_i.par[4], block_i.par[3]} == '0)
  `FV_ASSUME(a_status, $onehot(status_i))

  `FV_ASSERT(p312_inp_11_limit, !result_o.done || result_o.at_limit == (!changes && hit_q))
  `FV_ASSERT(p312_sta_04_starts, start_o == (result_o.done && !changes && !hit_q && status_i == StatusNor))
  `FV_ASSERT(p312_cmd_87_changes, change_o == (result_o.done && changes))
  `FV_ASSERT(p312_blk_01_8_rejected,
             !result_o.done || result_o.rejected == (!changes && !hit_q && status_i != StatusNor))
  `FV_ASSERT(once, !result_o.done || moves_q)
  `FV_ASSERT(not_before_the_plan, !(start_o || change_o) || (!plan_busy_i || $past(!plan_busy_i)
             ) && (single || plans_q))
  `FV_ASSERT(plans_once, !profile_req_o.start || (moves_q && !plans_q && !single && !(hit_q && !changes)))
  `FV_ASSERT(plan_stands, !moves_q || age_q == '0 || profile_req_o.rate == rate_q)
  // verilog_format: off
  `FV_ASSERT(
      p312_mot_07_count,
      !start_o || profile_req_o.count == (single ? 32'd1
          : {block_i.par[3], block_i.par[4], block_i.par[5], block_i.par[6]}))
  // verilog_format: on
  `FV_ASSERT(p312_mot_13_endless, !start_o || profile_req_o.endless == !(counts || single))
  // verilog_format: off
  `FV_ASSERT(
      p312_cmd_82_operation,
      !start_o || (op_o.ccw == ccw && op_o.zero == (code == I_ZERO) && op_o.origin == (code == I_ORIGIN)
          && op_o.index == block_i.par[0][4]))
  // verilog_format: on
  `FV_ASSERT(p312_cmd_84_single,
             !start_o || (single_pulse_o == single && !(single && profile_o.starts_with_accel)))
  // verilog_format: off
  `FV_ASSERT(
      held_after_the_start,
      begin_i || $past(begin_i) || !begun_q
          || ({profile_req_o.count, profile_req_o.endless, profile_req_o.rate, single_pulse_o}
              == $past({profile_req_o.count, profile_req_o.endless, profile_req_o.rate, single_pulse_o})))
  // verilog_format: on

  // With a planner that ends and elapsed processing times, an instruction ends.
  logic [1:0] ready_q;  // cycles for which the planner is idle and the time has elapsed
  always_ff @(posedge clk_i)
    if (!(rst_ni && moves_q && !plan_busy_i && elapsed_i && age_q >= 3'd3)) ready_q <= '0;
    else ready_q <= ready_q + 2'(ready_q != '1);
  `FV_ASSERT(ends, ready_q < 2'd2 || !moves_q)

  `FV_COVER(seen_start, start_o && code == I_MOVE && ccw && age_q > 3'd5)
  `FV_COVER(seen_limit, result_o.done && result_o.at_limit)

endmodule

`default_nettype wire
