// SPDX-License-Identifier: Apache-2.0
// ppmc_single: core that the single-axis devices (PPMC-104BFP, J105 STMC) share, from host port to motor
//         pins. The devices differ in the parameters of this block and in the decoding of the bytes, which
//         is outside this block.
// Rules:  see the instantiated blocks.
// Timing: a command takes effect 4 cycles after the rising edge of clk_i at which the end of its write is
//         first sampled. The motor pins follow one cycle later.
// Assumes: decoded_byte_i and check_result_i are combinational functions of rx_byte_o and command_req_o.
`default_nettype none

module ppmc_single
  import ppmc_code_pkg::*;
  import ppmc_op_pkg::*;
  import ppmc_motion_pkg::*;
  import ppmc_single_pkg::*;
#(
    parameter int unsigned ClkHz     = 16_000_000,
    parameter int unsigned XtalHz    = 16_000_000,
    parameter bit          Datasheet = 1'b0,        // 1: processing times of the old chip
    parameter bit          PhaseIdle = 1'b1,        // level of the phases until the first initialisation
    parameter part_cfg_t   PartCfg                  // configuration of the device
) (
    input wire logic clk_i,
    input wire logic rst_ni,
    // host bus: pins of the device
    input wire logic cs_ni,  // chip select
    input wire logic rd_ni,  // read strobe
    input wire logic wr_ni,  // write strobe
    input wire logic a0_i,  // 0: data, 1: status or command
    input wire logic [7:0] d_i,  // data written by the host
    output logic [7:0] d_o,  // data read by the host
    output logic d_oe_o,  // 1: drive d_o, because the host reads
    output logic int_no,  // low: a motion has ended
    // decoding of the bytes by the device
    output rx_byte_t rx_byte_o,  // current byte from the host
    input wire decoded_byte_t decoded_byte_i,  // rx_byte_o.data, decoded
    output command_req_t command_req_o,  // command that the host requests with the current byte
    input wire check_result_t check_result_i,  // result of the check of command_req_o
    input wire logic stops_only_i,  // 1: only stop commands may be accepted
    // actions
    output action_t act_o,  // actions, effective at the next edge
    output logic [31:0] params_late_o,  // parameters of act_o
    input wire base_clock_t base_i,  // base clock of the next operation
    output setup_t setup_o,  // settings of the initialisation
    // motion
    input wire logic clock_pin_i,  // external base clock, asynchronous
    input wire switches_t switches_i,  // switches, synchronised
    input wire logic slow_i,  // slow_seen_o, directly or delayed; 1: act on a slow-down limit
    output logic slow_seen_o,  // 1: a slow-down limit is active and effective
    output motion_t motion_o,  // state of the motion
    output logic [7:0] rate_o,  // rate of the running interval
    // read data
    input wire logic [7:0] inputs_i,  // levels of the inputs, in the format of SEL_INPUTS
    input wire logic [3:0] auxi_i,  // auxiliary inputs
    // motor
    input wire chop_time_t chop_i,  // times of the chopper at standstill
    output motor_t motor_o  // motor pins
);

  // ---- host ----------------------------------------------------------------------------------------

  logic ready, is_command, take, open, initialised, building;
  logic [7:0] code_late;
  logic [3:0] status;
  logic [23:0] answer, remaining;
  action_t act_req;  // act_req: actions requested by the accepted byte; act_o: actions that take effect

  assign rx_byte_o.params_left = status[2:0];

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
      .state_i  ({status, 1'b0, motion_o.busy}),
      .ready_o  (ready),
      .command_o(is_command),
      .byte_o   (rx_byte_o.data),
      .take_i   (take),
      .load_i   (act_req.read),
      .long_i   (check_result_i.select == SEL_REMAINING),
      .answer_i (answer)
  );

  ppmc_command u_command (
      .clk_i,
      .rst_ni,
      .ready_i       (ready),
      .command_i     (is_command),
      .byte_i        (rx_byte_o.data),
      .open_i        (open),
      .stops_only_i,
      .take_o        (take),
      .decoded_i     (decoded_byte_i.decoded),
      .data_i        (decoded_byte_i.data),
      .param_error_i (check_result_i.error),
      .is_checked_i  (check_result_i.is_checked),
      .busy_i        (motion_o.busy),
      .ramp_i        (motion_o.op.ramp),
      .decelerating_i(motion_o.dec || !motion_o.moving),
      .initialised_i (initialised),
      .status_o      (status),
      .act_o         (act_req),
      .code_o        (command_req_o.code),
      .params_o      (command_req_o.params),
      .code_held_o   (rx_byte_o.code_held),
      .params_held_o (rx_byte_o.params)
  );

  // ---- set-up, ramp table, motion ------------------------------------------------------------------

  op_code_t   op_code;
  init_code_t init_late;
  logic phase_init, ready_init, unused_bits;
  logic [PartCfg.step_bits-1:0] steps, lut_data;
  logic [7:0] slow, fast, lut_addr;

  assign op_code     = op_code_t'(code_late);  // code_late as an operation code
  assign init_late   = init_code_t'(code_late);  // code_late as an initialisation code
  assign unused_bits = &{1'b0, op_code, init_late, chop_i, check_result_i};

  ppmc_setup #(
      .PhaseIdle(PhaseIdle)
  ) u_setup (
      .clk_i,
      .rst_ni,
      .init_i       (act_o.init),
      .code_i       (init_code_t'(command_req_o.code)),
      .phase_init_i (phase_init),
      .positive_i   (init_late.positive),
      .ready_i      (ready_init),
      .off_i        (act_o.exc_off),
      .setup_o,
      .initialised_o(initialised)
  );

  ppmc_ramp_table #(
      .StepBits(PartCfg.step_bits)
  ) u_table (
      .clk_i,
      .rst_ni,
      .start_i(act_o.init),
      .slow_i (check_result_i.setup[7:0]),
      .fast_i (check_result_i.setup[15:8]),
      .steps_i(check_result_i.setup[16+:PartCfg.step_bits]),
      .busy_o (building),
      .slow_o (slow),
      .fast_o (fast),
      .steps_o(steps),
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

  logic quantum, restart, low, go, end_delay;
  motion_event_t event_now;
  base_clock_t base_late;
  stop_cause_t cause;
  logic [5:1] levels;

  ppmc_tick_gen #(
      .ClkHz   (ClkHz),
      .XtalHz  (XtalHz),
      .TickXtal(PartCfg.quantum_xtal)
  ) u_quantum (
      .clk_i,
      .rst_ni,
      .restart_i(restart),
      .tick_o   (quantum)
  );

  ppmc_axis #(
      .ClkHz      (ClkHz),
      .XtalHz     (XtalHz),
      .StepBits   (PartCfg.step_bits),
      .LevelBits  (ppmc_pkg::cnt_width(PartCfg.steps_max + 1)),
      .FastQuanta (PartCfg.fast_quanta),
      .SlowQuanta (PartCfg.slow_quanta),
      .ExtraQuanta(PartCfg.extra_quanta),
      .StopAtSlow (PartCfg.stmc_stop_rules),
      .SlowOrigin (PartCfg.stmc_stop_rules),
      .PulsePin   (!PartCfg.stmc_stop_rules)
  ) u_axis (
      .clk_i,
      .rst_ni,
      .start_i    (act_o.start),
      .op_i       (motion_op(op_code.pout_only, op_code.ccw, op_code.op)),
      .count_i    (count),
      .rate_i     ((op_code.op == OP_CONSTANT) ? params_late_o[7:0] : params_late_o[31:24]),
      .base_i     (base_late),
      .rate_slow_i(slow),
      .rate_fast_i(fast),
      .lut_addr_o (lut_addr),
      .lut_data_i (lut_data),
      .halt_i     (act_o.halt),
      .decel_i    (act_o.decel),
      .switches_i,
      .slow_i,
      .slow_seen_o,
      .run_i      (1'b1),
      .go_i       (go),
      .end_delay_i(end_delay),
      .quantum_i  (quantum),
      .clock_pin_i,
      .restart_o  (restart),
      .motion_o,
      .rate_o,
      .low_o      (low),
      .event_o    (event_now),
      .cause_o    (cause),
      .left_o     (remaining)
  );

  ppmc_proc_time #(
      .Datasheet(Datasheet),
      .ClkHz    (ClkHz),
      .XtalHz   (XtalHz),
      .StepBits (PartCfg.step_bits),
      .StepsMin (PartCfg.steps_min),
      .StepsMax (PartCfg.steps_max),
      .RampTimes(!PartCfg.stmc_stop_rules)
  ) u_proc_time (
      .clk_i,
      .rst_ni,
      .act_i        (act_req),
      .code_i       (command_req_o.code),
      .params_i     (command_req_o.params),
      .code_held_i  (rx_byte_o.code_held),
      .params_held_i(rx_byte_o.params),
      .base_i,
      .open_o       (open),
      .act_o,
      .code_o       (code_late),
      .params_o     (params_late_o),
      .base_o       (base_late),
      .initialised_i(initialised),
      .building_i   (building),
      .steps_i      (steps),
      .phase_init_o (phase_init),
      .ready_o      (ready_init),
      .ramp_i       (motion_o.op.ramp),
      .single_i     (motion_o.op.single),
      .stop_i       (event_now.stop),
      .pulse_i      (event_now.pulse),
      .last_i       (event_now.last),
      .final_i      (event_now.complete),
      .go_o         (go),
      .end_delay_o  (end_delay)
  );

  // ---- end of a motion, read data, pins ------------------------------------------------------------

  ppmc_finish_status #(
      .UnreadFlag(!PartCfg.stmc_stop_rules)
  ) u_finish (
      .clk_i,
      .rst_ni,
      .start_i    (act_o.start),
      .op_code_i  (op_code),
      .done_i     (event_now.done),
      .cause_i    (cause),
      .read_i     (act_req.read),
      .select_i   (check_result_i.select),
      .remaining_i(remaining),
      .inputs_i,
      .outputs_i  ({levels[1], levels[2], levels[3], levels[4], levels[5], motor_o.hold, motor_o.dir, 1'b0}),
      .auxi_i,
      .answer_o   (answer),
      .int_no
  );

  ppmc_motor_port #(
      .HoldQuanta(PartCfg.hold_quanta),
      .HoldRestCycles(PartCfg.hold_rest_cycles),
      .UnitQuanta(PartCfg.chop_unit),
      .BaseBits(PartCfg.chop_bits),
      .PhaseIdle(PhaseIdle)
  ) u_motor (
      .clk_i,
      .rst_ni,
      .busy_i        (motion_o.busy),
      .low_i         (low),
      .step_i        (event_now.pulse && !motion_o.op.pout_only),
      .ccw_i         (motion_o.op.ccw),
      .quantum_i     (quantum),
      .motor_i       (motor_e'(setup_o.motor)),
      .half_i        (setup_o.half),
      .positive_i    (setup_o.positive),
      .phase_init_i  (phase_init),
      .off_i         (act_o.exc_off),
      .chop_i        (setup_o.chop),
      .chop_restart_i(ready_init),
      .on_base_i     (chop_i.on_base[PartCfg.chop_bits-1:0]),
      .off_base_i    (chop_i.off_base[PartCfg.chop_bits-1:0]),
      .on_units_i    (chop_i.on_units),
      .off_units_i   (chop_i.off_units),
      .hold_units_i  (1'b0),
      .levels_o      (levels),
      .s_o           (motor_o.s),
      .hold_o        (motor_o.hold),
      .pout_no       (motor_o.pout_n),
      .dir_o         (motor_o.dir)
  );

endmodule

`default_nettype wire
