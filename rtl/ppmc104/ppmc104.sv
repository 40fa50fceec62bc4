// SPDX-License-Identifier: Apache-2.0
// ppmc104: single-axis stepper controller, a replacement for the Ampere PPMC-104BFP.
// Rules:  P104-PORT-01..04, P104-PAR-01 and, through its blocks, all others. Manual: docs/ppmc104.md.
// Timing: a command acts 4 clk after the clk edge that first samples the end of its write; motor pins follow
//         one clk later.
`default_nettype none

module ppmc104
  import ppmc104_pkg::*;
  import ppmc_op_pkg::*;
  import ppmc_motion_pkg::*;
#(
    parameter int unsigned CLK_HZ     = 16_000_000,  // 8e6 .. 200e6
    parameter int unsigned XTAL_HZ    = 16_000_000,  // crystal of the old chip, 1e6 .. 16e6
    parameter string       TIMING     = "FAST",      // or "DATASHEET": with the old chip's processing times
    parameter bit          PHASE_IDLE = 1'b1         // level of s until the first initialisation
) (
    input  wire logic       clk,
    input  wire logic       rst_n,
    // host bus
    input  wire logic       a0,      // 0 data, 1 status or command
    input  wire logic       cs_n,
    input  wire logic       rd_n,
    input  wire logic       wr_n,
    input  wire logic [7:0] d_i,
    output logic      [7:0] d_o,
    output logic            d_oe,
    output logic            int_n,   // L: a motion has ended
    // clock selection
    input  wire logic       csel,    // internal base clock: H 500 kHz, L 125 kHz
    input  wire logic       vsel,    // L: 7.5 us more in every interval
    input  wire logic       clock,   // external base clock, rising edges
    // switches, L = active
    input  wire logic       l1_n,    // CW limit
    input  wire logic       l2_n,    // CCW limit
    input  wire logic       l3_n,    // CW slow-down limit
    input  wire logic       l4_n,    // CCW slow-down limit
    input  wire logic       cnp_n,   // origin
    input  wire logic       alm_n,   // alarm
    // auxiliary
    input  wire logic [3:0] auxi,
    output logic      [3:0] auxo,
    output logic            aux_n,
    // motor
    output logic      [5:1] s,
    output logic            hold,
    output logic            pout_n,
    output logic            dir      // 0 = CW
);

  if (TIMING != "FAST" && TIMING != "DATASHEET") begin : g_check_timing
    $fatal(1, "ppmc104: TIMING must be FAST or DATASHEET");
  end
  if (CLK_HZ < 8_000_000 || CLK_HZ > 200_000_000) begin : g_check_clk
    $fatal(1, "ppmc104: CLK_HZ must be 8e6 .. 200e6");
  end
  if (XTAL_HZ < 1_000_000 || XTAL_HZ > 16_000_000) begin : g_check_xtal
    $fatal(1, "ppmc104: XTAL_HZ must be 1e6 .. 16e6");
  end

  logic rst;

  ppmc_reset u_reset (
      .clk_i (clk),
      .rst_ni(rst_n),
      .rst_no(rst)
  );

  // ---- inputs --------------------------------------------------------------------------------------

  logic l1, l2, l3, l4, cnp, alm, csel_s, vsel_s;
  logic [3:0] auxi_s;
  logic [11:0] unused_meta;
  switches_t switches;

  ppmc_sync #(
      .Width(12)
  ) u_sync (
      .clk_i (clk),
      .rst_ni(rst),
      .d_i   ({l1_n, l2_n, l3_n, l4_n, cnp_n, alm_n, csel, vsel, auxi}),
      .q1_o  (unused_meta),
      .q2_o  ({l1, l2, l3, l4, cnp, alm, csel_s, vsel_s, auxi_s})
  );

  assign switches = '{
          limit_cw: !l1,
          limit_ccw: !l2,
          slow_cw: !l3,
          slow_ccw: !l4,
          origin: !cnp,
          alarm: !alm
      };

  // ---- host ----------------------------------------------------------------------------------------

  logic ready, is_command, take, open, stops_only;
  logic busy, moving, decelerating, initialised, building;
  op_t op_run;
  logic [7:0] in_byte, code, code_held, code_late;
  logic [31:0] params, params_held, params_late;
  logic [ 3:0] judgement;
  logic [23:0] answer;
  action_t act_taken, act;  // what a byte asks for at its C-event, and when it happens

  ppmc_host_port #(
      .QueueBytes(3)
  ) u_host (
      .clk_i    (clk),
      .rst_ni   (rst),
      .style_i  (1'b0),
      .cs_ni    (cs_n),
      .rd_ni    (rd_n),
      .wr_ni    (wr_n),
      .a0_i     (a0),
      .d_i      (d_i),
      .d_o      (d_o),
      .d_oe_o   (d_oe),
      .state_i  ({judgement, 1'b0, busy}),
      .ready_o  (ready),
      .command_o(is_command),
      .byte_o   (in_byte),
      .take_i   (take),
      .load_i   (act_taken.read),
      .long_i   (code[2:0] == SEL_REMAINING),
      .answer_i (answer)
  );

  ppmc104_command u_command (
      .clk_i         (clk),
      .rst_ni        (rst),
      .ready_i       (ready),
      .command_i     (is_command),
      .byte_i        (in_byte),
      .open_i        (open),
      .stops_only_i  (stops_only),
      .take_o        (take),
      .busy_i        (busy),
      .ramp_i        (op_run.ramp),
      .decelerating_i(decelerating || !moving),
      .initialised_i (initialised),
      .status_o      (judgement),
      .act_o         (act_taken),
      .code_o        (code),
      .params_o      (params),
      .code_held_o   (code_held),
      .params_held_o (params_held)
  );

  // ---- what the host has set -----------------------------------------------------------------------

  setup_t setup;
  op_code_t op_code;
  init_code_t init_late;
  logic home, ready_init, unused_bits;

  assign init_late   = init_code_t'(code_late);  // a code, read as one or as the other
  assign op_code     = op_code_t'(code_late);
  assign unused_bits = &{1'b0, act.read, init_late, op_code, op_run};

  ppmc104_setup #(
      .PhaseIdle(PHASE_IDLE)
  ) u_setup (
      .clk_i        (clk),
      .rst_ni       (rst),
      .act_i        (act),
      .code_i       (init_code_t'(code)),
      .params_i     (params),
      .aux_i        (params_late[27:24]),
      .home_i       (home),
      .positive_i   (init_late.positive),
      .ready_i      (ready_init),
      .vsel_i       (vsel_s),
      .setup_o      (setup),
      .initialised_o(initialised),
      .auxo_o       (auxo),
      .aux_no       (aux_n)
  );

  // ---- ramp table ----------------------------------------------------------------------------------

  logic [RATE_BITS-1:0] lut_addr;
  logic [STEP_BITS-1:0] lut_data;

  ppmc_ramp_table #(
      .RateBits(RATE_BITS),
      .StepBits(STEP_BITS)
  ) u_table (
      .clk_i  (clk),
      .rst_ni (rst),
      .start_i(act.init),
      .slow_i (setup.slow),
      .fast_i (setup.fast),
      .steps_i(setup.steps),
      .busy_o (building),
      .addr_i (lut_addr),
      .data_o (lut_data)
  );

  // ---- motion --------------------------------------------------------------------------------------

  op_t op;
  logic [23:0] count;
  logic quantum, restart, low, pulse, done;
  logic top, running, last, final_pulse, stop, slow_seen, slow_take, go, linger;
  base_t base_run, base_now, base_late;
  logic [RATE_BITS-1:0] rate_run;
  cause_t cause;
  logic [23:0] remaining;
  logic unused_gated;

  assign base_now = '{external: setup.external, slow: !csel_s, extra: !vsel_s};
  assign op = op_of(op_code.pout_only, op_code.ccw, op_code.op);

  always_comb begin
    unique case (op_code.op)
      OP_ACC_DEC, OP_CONSTANT: count = params_late[31:8];
      default:                 count = '1;
    endcase
  end

  ppmc_tick_gen #(
      .ClkHz   (CLK_HZ),
      .XtalHz  (XTAL_HZ),
      .TickXtal(QUANTUM_XTAL)
  ) u_quantum (
      .clk_i    (clk),
      .rst_ni   (rst),
      .restart_i(restart),
      .tick_o   (quantum)
  );

  ppmc_axis #(
      .ClkHz    (CLK_HZ),
      .XtalHz   (XTAL_HZ),
      .CountBits(COUNT_BITS),
      .RateBits (RATE_BITS),
      .StepBits (STEP_BITS)
  ) u_axis (
      .clk_i      (clk),
      .rst_ni     (rst),
      .start_i    (act.start),
      .op_i       (op),
      .count_i    (count),
      .rate_i     ((op_code.op == OP_CONSTANT) ? params_late[7:0] : params_late[31:24]),
      .base_i     (base_late),
      .rate_slow_i(setup.slow),
      .rate_fast_i(setup.fast),
      .steps_i    (setup.steps),
      .lut_addr_o (lut_addr),
      .lut_data_i (lut_data),
      .halt_i     (act.halt),
      .decel_i    (act.decel),
      .switches_i (switches),
      .slow_i     (slow_take),
      .slow_seen_o(slow_seen),
      .run_i      (1'b1),
      .go_i       (go),
      .linger_i   (linger),
      .quantum_i  (quantum),
      .clock_pin_i(clock),
      .restart_o  (restart),
      .busy_o     (busy),
      .moving_o   (moving),
      .gated_o    (unused_gated),
      .decel_o    (decelerating),
      .top_o      (top),
      .op_o       (op_run),
      .base_o     (base_run),
      .rate_o     (rate_run),
      .running_o  (running),
      .low_o      (low),
      .pulse_o    (pulse),
      .last_o     (last),
      .final_o    (final_pulse),
      .stop_o     (stop),
      .done_o     (done),
      .cause_o    (cause),
      .left_o     (remaining)
  );

  // ---- processing times ----------------------------------------------------------------------------

  ppmc104_pace #(
      .Datasheet(TIMING == "DATASHEET"),
      .ClkHz    (CLK_HZ),
      .XtalHz   (XTAL_HZ)
  ) u_pace (
      .clk_i        (clk),
      .rst_ni       (rst),
      .act_i        (act_taken),
      .code_i       (code),
      .params_i     (params),
      .code_held_i  (code_held),
      .params_held_i(params_held),
      .base_i       (base_now),
      .open_o       (open),
      .stops_only_o (stops_only),
      .act_o        (act),
      .code_o       (code_late),
      .params_o     (params_late),
      .base_o       (base_late),
      .initialised_i(initialised),
      .building_i   (building),
      .steps_i      (setup.steps),
      .home_o       (home),
      .ready_o      (ready_init),
      .moving_i     (moving),
      .running_i    (running),
      .top_i        (top),
      .op_run_i     (op_run),
      .base_run_i   (base_run),
      .rate_i       (rate_run),
      .slow_seen_i  (slow_seen),
      .stop_i       (stop),
      .pulse_i      (pulse),
      .last_i       (last),
      .final_i      (final_pulse),
      .slow_o       (slow_take),
      .go_o         (go),
      .linger_o     (linger)
  );

  // ---- end of a motion, answers --------------------------------------------------------------------

  logic [5:1] levels;

  ppmc104_finish u_finish (
      .clk_i      (clk),
      .rst_ni     (rst),
      .start_i    (act.start),
      .op_code_i  (op_code),
      .done_i     (done),
      .cause_i    (cause),
      .read_i     (act_taken.read),
      .select_i   (code[2:0]),
      .remaining_i(remaining),
      .inputs_i   ({cnp, alm, 2'b00, l1, l2, l3, l4}),
      .outputs_i  ({levels[1], levels[2], levels[3], levels[4], levels[5], hold, dir, 1'b0}),
      .auxi_i     (auxi_s),
      .answer_o   (answer),
      .int_no     (int_n)
  );

  // ---- motor pins ----------------------------------------------------------------------------------

  ppmc_motor_port #(
      .HoldQuanta(HOLD_QUANTA),
      .UnitQuanta(CHOP_UNIT),
      .PhaseIdle (PHASE_IDLE)
  ) u_motor (
      .clk_i         (clk),
      .rst_ni        (rst),
      .busy_i        (busy),
      .low_i         (low),
      .step_i        (pulse && !op_run.pout_only),
      .ccw_i         (op_run.ccw),
      .quantum_i     (quantum),
      .motor_i       (motor_e'(setup.motor)),
      .half_i        (setup.half),
      .positive_i    (setup.positive),
      .home_i        (home),
      .off_i         (act.exc_off),
      .chop_i        (setup.chop),
      .chop_restart_i(ready_init),
      .on_base_i     (setup.on_base),
      .off_base_i    (setup.off_base),
      .on_units_i    (setup.on_units),
      .off_units_i   (setup.off_units),
      .hold_units_i  (1'b0),
      .levels_o      (levels),
      .s_o           (s),
      .hold_o        (hold),
      .pout_no       (pout_n),
      .dir_o         (dir)
  );

endmodule

`default_nettype wire
