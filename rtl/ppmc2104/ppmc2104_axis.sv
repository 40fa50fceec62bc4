// SPDX-License-Identifier: Apache-2.0
// ppmc2104_axis: one axis of a PPMC-2104. Contains settings, motion, motor pins, end status and answers to
//         read instructions.
// Rules:  P2104-OPR-01..10, P2104-END-01..08, P2104-RD-01..07, P2104-BCK-05; the instantiated blocks
//         implement the motion.
// Timing: the actions of act_i take effect at the next rising edge. The motor pins follow one cycle later.
// Note:   this module has no input from the other axis.
`include "ppmc_assert.svh"
`default_nettype none

module ppmc2104_axis
  import ppmc2104_pkg::*;
  import ppmc_op_pkg::*;
  import ppmc_motion_pkg::*;
#(
    parameter int unsigned ClkHz     = 16_000_000,
    parameter int unsigned XtalHz    = 16_000_000,
    parameter bit          Datasheet = 1'b0
) (
    input  wire logic                         clk_i,
    input  wire logic                         rst_ni,
    // instructions
    input  wire axis_action_t                 act_i,          // actions, effective at the next rising edge
    input  wire logic         [          7:0] code_i,         // code of act_i.init and act_i.start
    input  wire logic         [         31:0] params_i,       // parameters of code_i
    input  wire logic         [          7:0] code_late_i,    // code of all other actions
    input  wire logic         [         31:0] params_late_i,  // parameters of code_late_i
    input  wire logic                         ready_i,        // 0: table build or processing time in progress
    output axis_summary_t                     state_o,        // state of this axis, for the command unit
    output logic                              end_o,          // strobe: operation with interrupt (I = 0) ends
    input  wire cmd_error_e                   error_i,        // error register
    output logic              [         23:0] answer_o,       // answer to the read instruction code_late_i
    // ramp table
    output logic              [RATE_BITS-1:0] lut_addr_o,     // rate r, which is the address of lut_data_i
    input  wire logic         [STEP_BITS-1:0] lut_data_i,     // threshold of r, two cycles after lut_addr_o
    // processing times
    input  wire logic                         run_open_i,     // 1: RUN is sampled
    input  wire logic                         poll_i,         // 1: limits and alarm are sampled
    input  wire logic                         end_delay_i,    // 1: a stopped operation must not end yet
    // pins
    input  wire pin_levels_t                  levels_i,       // inputs of this axis, synchronised
    input  wire logic                         extck_i,        // external base clock, asynchronous
    output logic              [          5:1] s_no,           // phases
    output logic                              hold_o,         // high: standstill for the hold delay
    output logic                              pout_no,        // pulse, active low
    output logic                              dir_o           // 0: CW, 1: CCW
);

  op_code_t op_code;
  motion_t motion;
  motion_event_t event_now;
  switches_t switches;
  stop_cause_t cause;
  setup_t setup;
  logic phase_init, chop, low, quantum, restart, slow_seen;
  logic [23:0] count, remaining;
  logic [5:1] levels;

  assign op_code = op_code_t'(code_i);
  assign state_o = '{
          busy: motion.busy,
          moving: motion.moving,
          decel_ok: motion.moving && !motion.gated && motion.op.ramp && !motion.dec,
          setup: setup
      };

  always_comb begin
    unique case (op_code.op)
      OP_ACC_DEC, OP_CONSTANT: count = params_i[31:8];
      default:                 count = '1;
    endcase
  end

  assign switches = '{
          limit_cw: poll_i && !levels_i.fl,
          limit_ccw: poll_i && !levels_i.bl,
          slow_cw: poll_i && !levels_i.fhl,
          slow_ccw: poll_i && !levels_i.bhl,
          alarm: poll_i && !levels_i.alm,
          origin: !levels_i.org
      };

  ppmc2104_setup u_setup (
      .clk_i,
      .rst_ni,
      .act_i,
      .code_i(init_code_t'(code_i)),
      .params_i,
      .params_late_i,
      .ready_i,
      .setup_o(setup),
      .phase_init_o(phase_init),
      .chop_o(chop)
  );

  ppmc_tick_gen #(
      .ClkHz   (ClkHz),
      .XtalHz  (XtalHz),
      .TickXtal(QUANTUM_XTAL)
  ) u_quantum (
      .clk_i,
      .rst_ni,
      .restart_i(restart),
      .tick_o   (quantum)
  );

  // Outputs of the motion core that this device does not use.
  logic unused_bits;
  logic [RATE_BITS-1:0] unused_rate;

  assign unused_bits = &{1'b0, op_code, params_i, act_i, motion, event_now, code_late_i};

  ppmc_axis #(
      .ClkHz        (ClkHz),
      .XtalHz       (XtalHz),
      .CountBits    (COUNT_BITS),
      .RateBits     (RATE_BITS),
      .StepBits     (STEP_BITS),
      .WidthXtal    (WIDTH_XTAL),
      .ExtraQuanta  (0),
      .StopAtSlow   (1'b1),
      .SlowAlways   (1'b1),
      .OriginAtPulse(Datasheet)
  ) u_axis (
      .clk_i,
      .rst_ni,
      .start_i    (act_i.start),
      .op_i       (motion_op(op_code.pout_only, op_code.ccw, op_code.op)),
      .count_i    (count),
      .rate_i     ((op_code.op == OP_CONSTANT) ? params_i[7:0] : params_i[31:24]),
      .base_i     ('{external: setup.external, slow: !levels_i.csel, extra: 1'b0}),
      .rate_slow_i(setup.slow),
      .rate_fast_i(setup.fast),
      .lut_addr_o,
      .lut_data_i,
      .halt_i     (act_i.halt),
      .decel_i    (act_i.decel),
      .switches_i (switches),
      .slow_i     (slow_seen),
      .slow_seen_o(slow_seen),
      .run_i      (levels_i.run && run_open_i),
      .go_i       (1'b1),
      .end_delay_i,
      .quantum_i  (quantum),
      .clock_pin_i(extck_i),
      .restart_o  (restart),
      .motion_o   (motion),
      .rate_o     (unused_rate),
      .low_o      (low),
      .event_o    (event_now),
      .cause_o    (cause),
      .left_o     (remaining)
  );

  ppmc_motor_port #(
      .HoldQuanta(HOLD_QUANTA),
      .HoldBits  (8),
      .UnitQuanta(0)
  ) u_motor (
      .clk_i,
      .rst_ni,
      .busy_i        (motion.busy),
      .low_i         (low),
      .step_i        (event_now.pulse && !motion.op.pout_only),
      .ccw_i         (motion.op.ccw),
      .quantum_i     (quantum),
      .motor_i       (motor_e'(setup.motor)),
      .half_i        (setup.half),
      .positive_i    (1'b0),
      .phase_init_i  (phase_init),
      .off_i         (act_i.exc_off),
      .chop_i        (chop),
      .chop_restart_i(1'b0),
      .on_base_i     ({setup.on, 1'b0}),
      .off_base_i    ({setup.off, 1'b0}),
      .on_units_i    ('0),
      .off_units_i   ('0),
      .hold_units_i  (setup.hold_delay),
      .levels_o      (levels),
      .s_o           (s_no),
      .hold_o,
      .pout_no,
      .dir_o
  );

  // ---- end status, answers ------------------------------------------------------------------------

  logic unread_q, silent_q;  // unread_q: end status is unread; silent_q: no interrupt requested
  logic [2:0] op_q;

  assign end_o = event_now.done && !silent_q;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      unread_q <= 1'b0;
      silent_q <= 1'b0;
      op_q     <= '0;
    end else begin
      if (act_i.start) begin
        silent_q <= op_code.silent;
        op_q     <= op_code.op;
      end
      if (event_now.done) unread_q <= 1'b1;
      else if (act_i.read && code_late_i[2:0] == SEL_END) unread_q <= 1'b0;
    end
  end

  // The causes are valid until the next operation starts. While an operation runs, a read of the end status
  // is rejected.
  always_comb begin
    answer_o = remaining;  // only the remaining pulses have more than one byte
    unique case (code_late_i[2:0])
      SEL_END:   answer_o[7:0] = {unread_q, cause, op_q};
      SEL_INPUTS: begin
        answer_o[7:0] = {
          levels_i.org, levels_i.alm, 2'b00, levels_i.fl, levels_i.fhl, levels_i.bl, levels_i.bhl
        };
      end
      SEL_OUTPUTS: begin
        answer_o[7:0] = {levels[1], levels[2], levels[3], levels[4], levels[5], hold_o, dir_o, 1'b0};
      end
      SEL_ERROR: answer_o[7:0] = {4'b0000, error_i};
      default:   ;
    endcase
  end

`ifndef SYNTHESIS
  `PPMC_ASSERT(p2104_rd_08, !(act_i.read && motion.busy && code_late_i[2:0] != SEL_ERROR))
  `PPMC_ASSERT(p2104_aux_01,
               !(motion.busy && (act_i.init || act_i.exc_off || act_i.switching || act_i.hold_delay)))
`endif

endmodule

`default_nettype wire
