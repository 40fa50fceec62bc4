// SPDX-License-Identifier: Apache-2.0
// stmc: single-axis stepper controller without pulse output, a replacement for the controller of the J105 STMC.
// Rules:  STMC section 1 and, through its blocks, all other STMC rules. Manual: docs/stmc/README.md.
// Timing: a command acts 4 clk after the clk edge that first samples the end of its write; motor pins follow
//         one clk later.
`default_nettype none

module stmc
  import stmc_pkg::*;
  import ppmc_code_pkg::*;
  import ppmc_motion_pkg::*;
#(
    parameter int unsigned CLK_HZ      = 16_000_000,  // frequency of clk in Hz, 8e6 .. 200e6
    parameter int unsigned XTAL_HZ     = 16_000_000,  // crystal of the old part in Hz, 1e6 .. 20e6
    parameter string       TIMING      = "FAST",      // or "DATASHEET": with borrowed processing times
    parameter string       READ_MAP    = "SHEET",     // or "FAMILY": read codes of the sister parts
    parameter bit          PHASE_IDLE  = 1'b0,        // level of s until the first initialisation
    parameter int unsigned HOLD_XT     = 544_000,     // hold delay, crystal periods
    parameter int unsigned CHOP_ON_XT  = 1_040,       // on time of the chopper, crystal periods
    parameter int unsigned CHOP_OFF_XT = 1_740        // off time of the chopper, crystal periods
) (
    input  wire logic       clk,
    input  wire logic       rst_n,
    input  wire logic       ext_clk,  // external step clock, rising edges
    // host bus
    input  wire logic       cs_n,
    input  wire logic       a0,       // 0 data, 1 status or command
    input  wire logic       rd_n,
    input  wire logic       wr_n,
    input  wire logic [7:0] d_i,
    output logic      [7:0] d_o,
    output logic            d_oe,
    output logic            int_n,    // L: a motion has ended
    // switches, L = active
    input  wire logic       l1_n,     // cw limit
    input  wire logic       l2_n,     // ccw limit
    input  wire logic       l3_n,     // cw deceleration limit
    input  wire logic       l4_n,     // ccw deceleration limit
    input  wire logic       cnp_n,    // reference point
    input  wire logic       mon,      // L: the motor must not run
    // motor
    output logic      [5:1] s,
    output logic            hold
);

  if (TIMING != "FAST" && TIMING != "DATASHEET") begin : g_check_timing
    $fatal(1, "stmc: TIMING must be FAST or DATASHEET");
  end
  if (READ_MAP != "SHEET" && READ_MAP != "FAMILY") begin : g_check_map
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

  localparam bit Sheet = READ_MAP == "SHEET";
  // A quantum lasts at least two clk. Times of the chopper that are no multiple of it are rounded up.
  localparam int unsigned QuantumXtal = (2 * CLK_HZ >= XTAL_HZ) ? 4 : 5;
  localparam int unsigned HoldQuanta = HOLD_XT / QuantumXtal;
  localparam int unsigned HoldRest = ppmc_pkg::cyc(
      HOLD_XT, CLK_HZ, XTAL_HZ
  ) - ppmc_pkg::cyc(
      HoldQuanta * QuantumXtal, CLK_HZ, XTAL_HZ
  );
  localparam int unsigned OnQuanta = (CHOP_ON_XT + QuantumXtal - 1) / QuantumXtal;
  localparam int unsigned OffQuanta = (CHOP_OFF_XT + QuantumXtal - 1) / QuantumXtal;
  localparam int unsigned ChopBits = ppmc_pkg::cnt_width((OnQuanta > OffQuanta) ? OnQuanta : OffQuanta);

  logic rst;

  ppmc_reset u_reset (
      .clk_i (clk),
      .rst_ni(rst_n),
      .rst_no(rst)
  );

  // ---- inputs --------------------------------------------------------------------------------------

  logic l1, l2, l3, l4, cnp, mon_s;
  logic [5:0] unused_meta;

  ppmc_sync #(
      .Width(6)
  ) u_sync (
      .clk_i (clk),
      .rst_ni(rst),
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

  // ---- meaning of the bytes, everything else -------------------------------------------------------

  logic [7:0] in_byte, code, code_held;
  logic [2:0] left;
  logic [31:0] params, unused_params;
  logic slow, unused_moving, unused_running, unused_top, unused_pout, unused_dir, unused_bits;
  setup_t setup;
  action_t unused_act;
  op_t unused_op;
  base_t base, unused_base;
  logic [RATE_BITS-1:0] unused_rate;

  assign unused_bits = &{1'b0, code, code_held, setup};

  always_comb begin
    base          = '0;
    base.external = setup.external;
  end

  ppmc_single #(
      .ClkHz      (CLK_HZ),
      .XtalHz     (XTAL_HZ),
      .Datasheet  (TIMING == "DATASHEET"),
      .PhaseIdle  (PHASE_IDLE),
      .StepBits   (STEP_BITS),
      .StepsMin   (0),
      .StepsMax   (STEPS_MAX),
      .PulsePin   (1'b0),
      .QuantumXtal(QuantumXtal),
      .FastQuanta (STEP_XTAL / QuantumXtal),
      .SlowQuanta (STEP_XTAL / QuantumXtal),
      .ExtraQuanta(0),
      .HoldQuanta (HoldQuanta),
      .HoldRest   (HoldRest),
      .ChopUnit   (1),
      .ChopBits   (ChopBits)
  ) u_single (
      .clk_i         (clk),
      .rst_ni        (rst),
      .cs_ni         (cs_n),
      .rd_ni         (rd_n),
      .wr_ni         (wr_n),
      .a0_i          (a0),
      .d_i,
      .d_o,
      .d_oe_o        (d_oe),
      .int_no        (int_n),
      .byte_o        (in_byte),
      .left_o        (left),
      .code_o        (code),
      .code_held_o   (code_held),
      .params_o      (params),
      .decoded_i     (decode(Sheet, in_byte)),
      .data_i        (in_byte - 8'(is_divisor(code_held[6], code_held[2:0], left))),
      .value_i       (judge(code_held[6], code_held[2:0], params[7:0], params[15:8], params[31:24])),
      .judged_i      (1'b1),
      .select_i      (selected(Sheet, code[2:0])),
      .setup_params_i(levelled(params)),
      .stops_only_i  (1'b0),
      .act_o         (unused_act),
      .params_late_o (unused_params),
      .base_i        (base),
      .setup_o       (setup),
      .clock_pin_i   (ext_clk),
      .switches_i    (switches),
      .slow_i        (slow),
      .slow_seen_o   (slow),
      .moving_o      (unused_moving),
      .running_o     (unused_running),
      .top_o         (unused_top),
      .op_o          (unused_op),
      .base_o        (unused_base),
      .rate_o        (unused_rate),
      .inputs_i      ({cnp, mon_s, 2'b00, l1, l2, l3, l4}),
      .auxi_i        ('0),
      .on_base_i     (ChopBits'(OnQuanta)),
      .off_base_i    (ChopBits'(OffQuanta)),
      .on_units_i    ('0),
      .off_units_i   ('0),
      .s_o           (s),
      .hold_o        (hold),
      .pout_no       (unused_pout),
      .dir_o         (unused_dir)
  );

endmodule

`default_nettype wire
