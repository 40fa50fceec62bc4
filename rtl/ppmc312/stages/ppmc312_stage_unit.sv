// SPDX-License-Identifier: Apache-2.0
// ppmc312_stage_unit: stage table with its builder, its planner, the arithmetic that both share, and the
//         description of the active table.
// Rules:  P312-TBL-01..06, P312-CMD-FC-3/10, P312-MOT-10..13.
// Timing: busy_o is high from build_i or close_i until the table can be used. plan_busy_o is high from
//         profile_req_i.start until the plan is valid; the plan remains valid until the next start.
//         Read-back: read_stage_o is valid two cycles after read_addr_i, while busy_o and plan_busy_o are
//         0.
`default_nettype none

module ppmc312_stage_unit
  import ppmc312_stage_pkg::*;
(
    input wire logic clk_i,  // clock
    input wire logic rst_ni,  // reset, asynchronous
    // set-up
    input wire logic drop_i,  // strobe: the table becomes invalid
    input wire logic build_i,  // strobe: build the table of curve_i
    input wire curve_t curve_i,  // ramp; stable while busy_o = 1
    output logic busy_o,  // 1: the table cannot be used yet
    output logic too_few_pulses_o,  // a stage has at most 1 pulse: no table
    // free curve
    input wire logic open_i,  // strobe: a transfer begins; latch the first stages, split and base clock
    input wire logic [6:0] open_acc_i,  // first stage of the acceleration side
    input wire logic [6:0] open_dec_i,  // first stage of the deceleration side
    input wire table_write_t table_write_i,  // word of the free curve
    input wire logic close_i,  // strobe: the transfer is complete; latch curve_i.acc, .dec
    // active table
    output table_t table_o,  // description of the table
    output target_t start_target_o,  // look-up result for table_o.rate_acc
    input wire table_addr_t read_addr_i,  // read-back address
    output stage_t read_stage_o,  // stage at read_addr_i, two cycles later; not valid while busy
    // planning
    input wire profile_req_t profile_req_i,  // operation to be planned
    output logic plan_busy_o,  // 1: the plan is not valid yet
    output logic [7:0] plan_kind_o,  // status byte: 00, 10, 20 or 40
    output profile_t profile_o,  // plan, valid until the next start
    // read port of the motion
    input wire table_addr_t table_addr_i,  // address
    output stage_t stage_o  // stage at table_addr_i, two cycles later
);

  typedef enum logic [1:0] {
    StIdle,
    StBuild,
    StStartRate  // looks up the rate of stage first_acc
  } state_e;

  state_e state_q;
  logic begin_q, build_busy, plan_busy, plan_start, start_found;
  logic [15:0] find_rate;
  table_write_t builder_write, table_write;
  logic [6:0] plan_addr;
  logic [1:0] build_begins, begins;
  target_t target;
  logic plan_owns_port, plan_accel, plan_both, ramp_q;
  logic [23:0] plan_dec;
  ramp_pos_t plan_decel_start;

  // ---- arithmetic ---------------------------------------------------------------------------------

  logic op_start, op_busy, build_op, plan_op, op_mul, build_mul, plan_mul;
  logic [5:0] op_steps, build_steps;
  logic [39:0] word, hi;
  logic [24:0] plan_operand;
  logic [23:0] op_lo, build_lo, plan_lo, lo;

  assign op_start = build_op || plan_op;
  assign op_mul   = build_busy ? build_mul : plan_mul;
  assign op_steps = build_busy ? build_steps : 6'd24;
  assign op_lo    = build_busy ? build_lo : plan_lo;

  ppmc312_muldiv #(
      .HiBits(40),
      .LoBits(24)
  ) u_arithmetic (
      .clk_i,
      .rst_ni,
      .start_i  (op_start),
      .mul_i    (op_mul),
      .steps_i  (op_steps),
      .keep_i   (!op_mul),
      .lo_i     (op_lo),
      .operand_i(word | 40'(plan_operand)),  // an idle block outputs the operand 0
      .busy_o   (op_busy),
      .hi_o     (hi),
      .lo_o     (lo)
  );

  // ---- builder and table --------------------------------------------------------------------------

  ppmc312_stage_builder u_builder (
      .clk_i,
      .rst_ni,
      .start_i      (build_i),
      .curve_i,
      .busy_o       (build_busy),
      .too_few_pulses_o,
      .table_write_o(builder_write),
      .begins_o     (build_begins),
      .first_acc_i  (table_o.first_acc),
      .first_dec_i  (table_o.first_dec),
      .op_start_o   (build_op),
      .op_mul_o     (build_mul),
      .op_steps_o   (build_steps),
      .op_lo_o      (build_lo),
      .word_o       (word),
      .op_busy_i    (op_busy),
      .hi_i         (hi),
      .lo_i         (lo)
  );

  assign table_write = build_busy ? builder_write : table_write_i;

  // At standstill, the motion does not need its read port, so a plan may use it. While instruction 87 or 88
  // looks up a rate (plan_both = 0), and after a plan (plan_busy = 0), the motion uses the port.
  assign plan_owns_port = plan_busy && plan_both;

  ppmc312_stage_table u_table (
      .clk_i,
      .we_rate_i  (table_write.we_rate),
      .we_pulses_i(table_write.we_acc || table_write.we_dec),
      .wside_i    (!table_write.we_acc),
      .waddr_i    (table_write.stage),
      .wdata_i    (table_write.data),
      .side_a_i   ((plan_owns_port || table_addr_i.side) && table_o.split),
      .addr_a_i   (plan_owns_port ? plan_addr : table_addr_i.stage),
      .rate_a_o   (stage_o.rate),
      .pulses_a_o (stage_o.pulses),
      .side_b_i   (!plan_busy && read_addr_i.side && table_o.split),
      .addr_b_i   (plan_busy ? plan_addr : read_addr_i.stage),
      .rate_b_o   (read_stage_o.rate),
      .pulses_b_o (read_stage_o.pulses)
  );

  // ---- planner ------------------------------------------------------------------------------------

  assign find_rate   = (state_q == StStartRate) ? table_o.rate_acc : profile_req_i.rate;
  assign plan_start  = (profile_req_i.start && state_q == StIdle) || begin_q;
  assign start_found = state_q == StStartRate && !begin_q && !plan_busy;

  ppmc312_stage_plan u_plan (
      .clk_i,
      .rst_ni,
      .start_i            (plan_start),
      .ramp_i             (profile_req_i.ramp && state_q == StIdle),
      .endless_i          (profile_req_i.endless),
      .rate_i             (find_rate),
      .count_i            (profile_req_i.count),
      .first_acc_i        (table_o.first_acc),
      .first_dec_i        (table_o.first_dec),
      .busy_o             (plan_busy),
      .both_o             (plan_both),
      .addr_o             (plan_addr),
      .table_rate_i       (read_stage_o.rate),
      .table_acc_i        (read_stage_o.pulses),
      .table_dec_i        (stage_o.pulses),
      .target_o           (target),
      .starts_with_accel_o(plan_accel),
      .kind_o             (plan_kind_o),
      .dec_pulses_o       (plan_dec),
      .decel_start_o      (plan_decel_start),
      .op_start_o         (plan_op),
      .op_mul_o           (plan_mul),
      .op_lo_o            (plan_lo),
      .operand_o          (plan_operand),
      .op_busy_i          (op_busy),
      .lo_i               (lo)
  );

  assign plan_busy_o = plan_busy;
  assign profile_o = '{
          endless: profile_req_i.endless,
          starts_with_accel: ramp_q && plan_accel,
          count: profile_req_i.count,
          dec_pulses: plan_dec,
          decel_start : plan_decel_start,
          target: target
      };

  always_ff @(posedge clk_i) if (profile_req_i.start) ramp_q <= profile_req_i.ramp;

  // ---- active table -------------------------------------------------------------------------------

  assign busy_o = state_q != StIdle;
  // Stages are written upward, and the last stage that qualifies is used.
  assign begins = build_busy ? build_begins :
      {2{table_write.we_rate}} &
      {table_write.stage == table_o.first_dec, table_write.stage == table_o.first_acc};

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      state_q <= StIdle;
      begin_q <= 1'b0;
      table_o <= '0;
    end else begin
      begin_q <= 1'b0;
      unique case (state_q)
        StIdle: begin
          if (build_i) state_q <= StBuild;
          else if (close_i) begin
            state_q <= StStartRate;
            begin_q <= 1'b1;
          end
        end
        StBuild:
        if (!build_busy) begin
          state_q <= too_few_pulses_o ? StIdle : StStartRate;
          begin_q <= !too_few_pulses_o;
        end
        StStartRate:
        if (start_found) begin
          state_q       <= StIdle;
          table_o.valid <= 1'b1;
        end
        default: state_q <= StIdle;
      endcase
      if (drop_i || open_i || build_i) table_o.valid <= 1'b0;
      if (open_i) begin
        table_o.first_acc <= open_acc_i;
        table_o.first_dec <= open_dec_i;
      end else begin
        if (begins[0]) table_o.first_acc <= table_write.stage;
        if (begins[1]) table_o.first_dec <= table_write.stage;
      end
      if (begins[0]) table_o.rate_acc <= table_write.data[15:0];
      if (begins[1]) table_o.rate_dec <= table_write.data[15:0];
      if (table_write.we_rate && table_write.stage == 7'd126) table_o.high_rate <= table_write.data[15:0];
      if (open_i || build_i) begin
        table_o.split <= curve_i.split;
        table_o.base  <= curve_i.base;
      end
      if (close_i || build_i) begin
        table_o.acc <= curve_i.acc;
        table_o.dec <= curve_i.dec;
      end
    end
  end

  // No reset: start_target_o is used only while table_o.valid = 1.
  always_ff @(posedge clk_i) if (start_found) start_target_o <= target;

endmodule

`default_nettype wire
