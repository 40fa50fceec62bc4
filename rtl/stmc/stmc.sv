// SPDX-License-Identifier: Apache-2.0
// stmc: single-axis stepper controller without pulse output; replaces the controller of the J105 STMC.
// Rules:  docs/stmc/README.md, 2.1 (pins) and 3 (parameters); the instantiated blocks implement the STMC
//         rules.
// Timing: a command takes effect 4 cycles after the rising edge at which the end of its write is first
//         sampled. The motor pins follow one cycle later.
`default_nettype none

module stmc
  import stmc_pkg::*;
  import ppmc_code_pkg::*;
  import ppmc_motion_pkg::*;
  import ppmc_single_pkg::*;
#(
    parameter int unsigned CLK_HZ      = 16_000_000,  // clock frequency in Hz, 8e6 .. 200e6
    parameter int unsigned XTAL_HZ     = 16_000_000,  // crystal of the old device in Hz, 1e6 .. 20e6
    parameter              TIMING      = "FAST",      // or "DATASHEET": processing times of the PPMC-104
    parameter              READ_MAP    = "FAMILY",    // read codes 80 .. 83; "SHEET": 80, 82, 83, 84
    parameter bit          PHASE_IDLE  = 1'b0,        // level of s until the first initialisation
    parameter int unsigned HOLD_XT     = 544_000,     // hold delay in crystal periods
    parameter int unsigned CHOP_ON_XT  = 1_040,       // on time of the chopper in crystal periods
    parameter int unsigned CHOP_OFF_XT = 1_740        // off time of the chopper in crystal periods
) (
    input  wire logic       clk,
    input  wire logic       rst_n,
    input  wire logic       ext_clk,  // external step clock, rising edges
    // host bus
    input  wire logic       cs_n,
    input  wire logic       a0,       // 0: data, 1: status or command
    input  wire logic       rd_n,
    input  wire logic       wr_n,
    input  wire logic [7:0] d_i,
    output logic      [7:0] d_o,
    output logic            d_oe,
    output logic            int_n,    // low: a motion has ended
    // switches, active low
    input  wire logic       l1_n,     // CW limit
    input  wire logic       l2_n,     // CCW limit
    input  wire logic       l3_n,     // CW deceleration limit
    input  wire logic       l4_n,     // CCW deceleration limit
    input  wire logic       cnp_n,    // reference point
    input  wire logic       mon,      // low: the motor must not run
    // motor
    output logic      [5:1] s,
    output logic            hold
);

  if (128'(TIMING) != "FAST" && 128'(TIMING) != "DATASHEET") begin : g_check_timing
    $fatal(1, "stmc: TIMING must be FAST or DATASHEET");
  end
  if (128'(READ_MAP) != "SHEET" && 128'(READ_MAP) != "FAMILY") begin : g_check_map
    $fatal(1, "stmc: READ_MAP must be SHEET or FAMILY");
  end
  if (CLK_HZ < 8_000_000 || CLK_HZ > 200_000_000) begin : g_check_clk
    $fatal(1, "stmc: CLK_HZ must be 8e6 .. 200e6");
  end
  if (XTAL_HZ < 1_000_000 || XTAL_HZ > 20_000_000) begin : g_check_xtal
    $fatal(1, "stmc: XTAL_HZ must be 1e6 .. 20e6");
  end
  if (HOLD_XT == 0 || CHOP_ON_XT == 0 || CHOP_OFF_XT == 0) begin : g_check_times
    $fatal(1, "stmc: HOLD_XT, CHOP_ON_XT and CHOP_OFF_XT must be at least 1");
  end

  localparam bit SheetMap = 128'(READ_MAP) == "SHEET";
  // A quantum is at least two cycles. Chopper times that are not a multiple of a quantum are rounded up.
  localparam int unsigned QuantumXtal = (2 * CLK_HZ >= XTAL_HZ) ? 32'd4 : 32'd5;
  localparam int unsigned HoldQuanta = HOLD_XT / QuantumXtal;
  localparam int unsigned HoldRestCycles = ppmc_pkg::cyc(
      HOLD_XT, CLK_HZ, XTAL_HZ
  ) - ppmc_pkg::cyc(
      HoldQuanta * QuantumXtal, CLK_HZ, XTAL_HZ
  );
  localparam int unsigned OnQuanta = (CHOP_ON_XT + QuantumXtal - 1) / QuantumXtal;
  localparam int unsigned OffQuanta = (CHOP_OFF_XT + QuantumXtal - 1) / QuantumXtal;
  localparam int unsigned ChopBits = ppmc_pkg::cnt_width((OnQuanta > OffQuanta) ? OnQuanta : OffQuanta);

  logic rst_core_n;

  ppmc_reset u_reset (
      .clk_i (clk),
      .rst_ni(rst_n),
      .rst_no(rst_core_n)
  );

  // ---- inputs --------------------------------------------------------------------------------------

  logic l1, l2, l3, l4, cnp, mon_s;
  logic [5:0] unused_meta;

  ppmc_sync #(
      .Width(6)
  ) u_sync (
      .clk_i (clk),
      .rst_ni(rst_core_n),
      .d_i   ({l1_n, l2_n, l3_n, l4_n, cnp_n, mon}),
      .q1_o  (unused_meta),
      .q2_o  ({l1, l2, l3, l4, cnp, mon_s})
  );

  switches_t switches;

  always_comb begin
    switches.limit_cw  = !l1;
    switches.limit_ccw = !l2;
    switches.slow_cw   = !l3;
    switches.slow_ccw  = !l4;
    switches.origin    = !cnp;
    switches.alarm     = !mon_s;
  end

  // ---- decoding of the bytes, shared single-axis core ----------------------------------------------

  localparam part_cfg_t PartCfg = '{
      step_bits: STEP_BITS,
      steps_min: 32'd0,
      steps_max: STEPS_MAX,
      quantum_xtal: QuantumXtal,
      fast_quanta: STEP_XTAL / QuantumXtal,
      slow_quanta: STEP_XTAL / QuantumXtal,
      extra_quanta: 0,
      hold_quanta: HoldQuanta,
      hold_rest_cycles: HoldRestCycles,
      chop_unit: 0,
      chop_bits: ChopBits,
      stmc_stop_rules: 1'b1
  };
  localparam chop_time_t Chop = '{on_base: OnQuanta, off_base: OffQuanta, on_units: '0, off_units: '0};

  rx_byte_t rx_byte;
  decoded_byte_t decoded_byte;
  command_req_t command_req;
  check_result_t check_result;
  cmd_error_e param_error;
  logic [31:0] unused_params;
  logic slow, unused_bits;
  setup_t setup;
  action_t unused_act;
  motion_t unused_motion;
  logic [RATE_BITS-1:0] unused_rate;
  motor_t motor;
  base_clock_t base;

  assign unused_bits = &{1'b0, command_req, setup, motor, rx_byte};

  assign decoded_byte = '{
          decoded: decode(SheetMap, rx_byte.data),
          data:
          rx_byte.data
          - 8'(
          is_divisor(rx_byte.code_held[6], rx_byte.code_held[2:0], rx_byte.params_left)
          )
      };
  assign param_error = check_params(
      rx_byte.code_held[6],
      rx_byte.code_held[2:0],
      command_req.params[7:0],
      command_req.params[15:8],
      command_req.params[31:24]
  );
  assign check_result = '{
          error: param_error,
          is_checked: 1'b1,
          select: read_select(SheetMap, command_req.code[2:0]),
          setup: normalise_rates(rx_byte.params)
      };
  assign base = '{external: setup.external, default: 1'b0};

  ppmc_single #(
      .ClkHz    (CLK_HZ),
      .XtalHz   (XTAL_HZ),
      .Datasheet(128'(TIMING) == "DATASHEET"),
      .PhaseIdle(PHASE_IDLE),
      .PartCfg  (PartCfg)
  ) u_single (
      .clk_i         (clk),
      .rst_ni        (rst_core_n),
      .cs_ni         (cs_n),
      .rd_ni         (rd_n),
      .wr_ni         (wr_n),
      .a0_i          (a0),
      .d_i,
      .d_o,
      .d_oe_o        (d_oe),
      .int_no        (int_n),
      .rx_byte_o     (rx_byte),
      .decoded_byte_i(decoded_byte),
      .command_req_o (command_req),
      .check_result_i(check_result),
      .stops_only_i  (1'b0),
      .act_o         (unused_act),
      .params_late_o (unused_params),
      .base_i        (base),
      .setup_o       (setup),
      .clock_pin_i   (ext_clk),
      .switches_i    (switches),
      .slow_i        (slow),
      .slow_seen_o   (slow),
      .motion_o      (unused_motion),
      .rate_o        (unused_rate),
      .inputs_i      ({cnp, mon_s, 2'b00, l1, l2, l3, l4}),
      .auxi_i        ('0),
      .chop_i        (Chop),
      .motor_o       (motor)
  );

  assign s = motor.s;
  assign hold = motor.hold;

endmodule

`default_nettype wire
