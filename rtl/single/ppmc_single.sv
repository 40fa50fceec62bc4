// SPDX-License-Identifier: Apache-2.0
// ppmc_single: all that the parts with one axis (PPMC-104BFP, J105 STMC) have in common, from host port to motor
// pins. What differs comes in by parameters and by the meaning of the bytes, which the part works out itself.
// Rules:  those of its blocks.
// Timing: a command acts 4 clk after the clk edge that first samples the end of its write; motor pins follow
//         one clk later. decoded_i, data_i, value_i, select_i and setup_params_i are combinational.
`default_nettype none

module ppmc_single
  import ppmc_code_pkg::*;
  import ppmc_op_pkg::*;
  import ppmc_motion_pkg::*;
#(
    parameter int unsigned ClkHz       = 16_000_000,
    parameter int unsigned XtalHz      = 16_000_000,
    parameter bit          Datasheet   = 1'b0,
    parameter bit          PhaseIdle   = 1'b1,        // level of s_o until the first initialisation
    parameter int unsigned StepBits    = 14,          // of PA
    parameter int unsigned StepsMin    = 4,           // smallest PA
    parameter int unsigned StepsMax    = 11_220,
    parameter bit          PulsePin    = 1'b1,        // 0: the J105 STMC's rules of stops and ends
    parameter int unsigned QuantumXtal = 4,           // crystal cycles a quantum
    parameter int unsigned FastQuanta  = 8,           // fast internal base clock
    parameter int unsigned SlowQuanta  = 32,
    parameter int unsigned ExtraQuanta = 30,
    parameter int unsigned HoldQuanta  = 136_000,
    parameter int unsigned HoldRest    = 0,           // clk more
    parameter int unsigned ChopUnit    = 12,          // quanta a unit of the chopper's times
    parameter int unsigned ChopBits    = 9
) (
    input wire logic clk_i,
    input wire logic rst_ni,
    // host bus
    input wire logic cs_ni,
    input wire logic rd_ni,
    input wire logic wr_ni,
    input wire logic a0_i,
    input wire logic [7:0] d_i,
    output logic [7:0] d_o,
    output logic d_oe_o,
    output logic int_no,
    // meaning of a byte
    output logic [7:0] byte_o,
    output logic [2:0] left_o,  // parameters to come, this byte included
    output logic [7:0] code_o,  // code that act_o belongs to, FAST or at its C-event
    output logic [7:0] code_held_o,  // code that parameters are collected for
    output logic [31:0] params_o,
    input wire decoded_t decoded_i,  // byte_o as a code
    input wire logic [7:0] data_i,  // byte_o as a parameter is kept
    input wire error_e value_i,  // what is wrong with params_o
    input wire logic judged_i,  // value_i counts for the code code_held_o
    input wire logic [2:0] select_i,  // what the read code code_o shows
    input wire logic [31:0] setup_params_i,  // params_o as an initialisation sets them
    input wire logic stops_only_i,
    // what happens
    output action_t act_o,
    output logic [31:0] params_late_o,  // with act_o
    input wire base_t base_i,  // base clock of the next operation
    output setup_t setup_o,
    // motion
    input wire logic clock_pin_i,
    input wire switches_t switches_i,
    input wire logic slow_i,  // act on a slow-down limit; slow_seen_o, or later
    output logic slow_seen_o,
    output logic moving_o,
    output logic running_o,
    output logic top_o,
    output op_t op_o,
    output base_t base_o,
    output logic [7:0] rate_o,
    // answers
    input wire logic [7:0] inputs_i,
    input wire logic [3:0] auxi_i,
    // chopper
    input wire logic [ChopBits-1:0] on_base_i,
    input wire logic [ChopBits-1:0] off_base_i,
    input wire logic [7:0] on_units_i,
    input wire logic [7:0] off_units_i,
    // pins
    output logic [5:1] s_o,
    output logic hold_o,
    output logic pout_no,
    output logic dir_o
);

  // ---- host ----------------------------------------------------------------------------------------

  logic ready, is_command, take, open, busy, decelerating, initialised, building;
  logic [ 7:0] code_late;
  logic [31:0] params_held;
  logic [ 3:0] judgement;
  logic [23:0] answer, remaining;
  action_t act_taken;  // what a byte asks for at its C-event; act_o: when it happens

  assign left_o = judgement[2:0];

  ppmc_host_port u_host (
      .clk_i,
      .rst_ni,
      .style_i  (1'b0),
      .cs_ni,
      .rd_ni,
      .wr_ni,
      .a0_i,
      .d_i,
      .d_o,
      .d_oe_o,
      .state_i  ({judgement, 1'b0, busy}),
      .ready_o  (ready),
      .command_o(is_command),
      .byte_o,
      .take_i   (take),
      .load_i   (act_taken.read),
      .long_i   (select_i == SEL_REMAINING),
      .answer_i (answer)
  );

  ppmc_command u_command (
      .clk_i,
      .rst_ni,
      .ready_i       (ready),
      .command_i     (is_command),
      .byte_i        (byte_o),
      .open_i        (open),
      .stops_only_i,
      .take_o        (take),
      .decoded_i,
      .data_i,
      .value_i,
      .judged_i,
      .busy_i        (busy),
      .ramp_i        (op_o.ramp),
      .decelerating_i(decelerating || !moving_o),
      .initialised_i (initialised),
      .status_o      (judgement),
      .act_o         (act_taken),
      .code_o,
      .params_o,
      .code_held_o,
      .params_held_o (params_held)
  );

  // ---- set-up, ramp table, motion ------------------------------------------------------------------

  op_code_t   op_code;
  init_code_t init_late;
  logic home, ready_init, unused_bits;
  logic [StepBits-1:0] steps, lut_data;
  logic [7:0] lut_addr;

  assign op_code     = op_code_t'(code_late);  // a code, read as one or as the other
  assign init_late   = init_code_t'(code_late);
  assign steps       = setup_o.steps[StepBits-1:0];
  assign unused_bits = &{1'b0, op_code, init_late};

  ppmc_setup #(
      .StepBits (StepBits),
      .PhaseIdle(PhaseIdle)
  ) u_setup (
      .clk_i,
      .rst_ni,
      .init_i       (act_o.init),
      .code_i       (init_code_t'(code_o)),
      .params_i     (setup_params_i),
      .home_i       (home),
      .positive_i   (init_late.positive),
      .ready_i      (ready_init),
      .off_i        (act_o.exc_off),
      .setup_o,
      .initialised_o(initialised)
  );

  ppmc_ramp_table #(
      .StepBits(StepBits)
  ) u_table (
      .clk_i,
      .rst_ni,
      .start_i(act_o.init),
      .slow_i (setup_o.slow),
      .fast_i (setup_o.fast),
      .steps_i(steps),
      .busy_o (building),
      .addr_i (lut_addr),
      .data_o (lut_data)
  );

  logic [23:0] count;

  always_comb begin
    unique case (op_code.op)
      OP_ACC_DEC, OP_CONSTANT: count = params_late_o[31:8];
      default:                 count = '1;
    endcase
  end

  logic quantum, restart, low, pulse, last, final_pulse, stop, done, go, linger, unused_gated;
  base_t base_late;
  cause_t cause;
  logic [5:1] levels;

  ppmc_tick_gen #(
      .ClkHz   (ClkHz),
      .XtalHz  (XtalHz),
      .TickXtal(QuantumXtal)
  ) u_quantum (
      .clk_i,
      .rst_ni,
      .restart_i(restart),
      .tick_o   (quantum)
  );

  ppmc_axis #(
      .ClkHz      (ClkHz),
      .XtalHz     (XtalHz),
      .StepBits   (StepBits),
      .ClimbBits  (ppmc_pkg::cnt_width(StepsMax + 1)),
      .FastQuanta (FastQuanta),
      .SlowQuanta (SlowQuanta),
      .ExtraQuanta(ExtraQuanta),
      .StopAtSlow (!PulsePin),
      .SlowOrigin (!PulsePin),
      .PulsePin   (PulsePin)
  ) u_axis (
      .clk_i,
      .rst_ni,
      .start_i    (act_o.start),
      .op_i       (op_of(op_code.pout_only, op_code.ccw, op_code.op)),
      .count_i    (count),
      .rate_i     ((op_code.op == OP_CONSTANT) ? params_late_o[7:0] : params_late_o[31:24]),
      .base_i     (base_late),
      .rate_slow_i(setup_o.slow),
      .rate_fast_i(setup_o.fast),
      .steps_i    (steps),
      .lut_addr_o (lut_addr),
      .lut_data_i (lut_data),
      .halt_i     (act_o.halt),
      .decel_i    (act_o.decel),
      .switches_i,
      .slow_i,
      .slow_seen_o,
      .run_i      (1'b1),
      .go_i       (go),
      .linger_i   (linger),
      .quantum_i  (quantum),
      .clock_pin_i,
      .restart_o  (restart),
      .busy_o     (busy),
      .moving_o,
      .gated_o    (unused_gated),
      .decel_o    (decelerating),
      .top_o,
      .op_o,
      .base_o,
      .rate_o,
      .running_o,
      .low_o      (low),
      .pulse_o    (pulse),
      .last_o     (last),
      .final_o    (final_pulse),
      .stop_o     (stop),
      .done_o     (done),
      .cause_o    (cause),
      .left_o     (remaining)
  );

  ppmc_pace #(
      .Datasheet(Datasheet),
      .ClkHz    (ClkHz),
      .XtalHz   (XtalHz),
      .StepBits (StepBits),
      .StepsMin (StepsMin),
      .StepsMax (StepsMax),
      .RampTimes(PulsePin)
  ) u_pace (
      .clk_i,
      .rst_ni,
      .act_i        (act_taken),
      .code_i       (code_o),
      .params_i     (params_o),
      .code_held_i  (code_held_o),
      .params_held_i(params_held),
      .base_i,
      .open_o       (open),
      .act_o,
      .code_o       (code_late),
      .params_o     (params_late_o),
      .base_o       (base_late),
      .initialised_i(initialised),
      .building_i   (building),
      .steps_i      (steps),
      .home_o       (home),
      .ready_o      (ready_init),
      .ramp_i       (op_o.ramp),
      .single_i     (op_o.single),
      .stop_i       (stop),
      .pulse_i      (pulse),
      .last_i       (last),
      .final_i      (final_pulse),
      .go_o         (go),
      .linger_o     (linger)
  );

  // ---- end of a motion, answers, pins --------------------------------------------------------------

  ppmc_finish #(
      .Fresh(PulsePin)
  ) u_finish (
      .clk_i,
      .rst_ni,
      .start_i    (act_o.start),
      .op_code_i  (op_code),
      .done_i     (done),
      .cause_i    (cause),
      .read_i     (act_taken.read),
      .select_i,
      .remaining_i(remaining),
      .inputs_i,
      .outputs_i  ({levels[1], levels[2], levels[3], levels[4], levels[5], hold_o, dir_o, 1'b0}),
      .auxi_i,
      .answer_o   (answer),
      .int_no
  );

  ppmc_motor_port #(
      .HoldQuanta(HoldQuanta),
      .HoldRest  (HoldRest),
      .UnitQuanta(ChopUnit),
      .BaseBits  (ChopBits),
      .PhaseIdle (PhaseIdle)
  ) u_motor (
      .clk_i,
      .rst_ni,
      .busy_i        (busy),
      .low_i         (low),
      .step_i        (pulse && !op_o.pout_only),
      .ccw_i         (op_o.ccw),
      .quantum_i     (quantum),
      .motor_i       (motor_e'(setup_o.motor)),
      .half_i        (setup_o.half),
      .positive_i    (setup_o.positive),
      .home_i        (home),
      .off_i         (act_o.exc_off),
      .chop_i        (setup_o.chop),
      .chop_restart_i(ready_init),
      .on_base_i,
      .off_base_i,
      .on_units_i,
      .off_units_i,
      .hold_units_i  (1'b0),
      .levels_o      (levels),
      .s_o,
      .hold_o,
      .pout_no,
      .dir_o
  );

endmodule

`default_nettype wire
