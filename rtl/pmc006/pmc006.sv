// SPDX-License-Identifier: Apache-2.0
// pmc006: integrated microstepping controller with a serial line; replaces the PMC006B4.
// Rules:  P006-PORT-01..04; the instantiated blocks implement all others. Pins, parameters:
//         docs/pmc006/README.md, 2.
// Timing: the input synchronisers have a latency of two cycles. All outputs are registered. From reset to
//         the end of the boot, the device does not receive frames and does not drive the motor.
`default_nettype none

module pmc006
  import pmc006_pkg::*;
#(
    parameter int unsigned CLK_HZ     = 16_000_000,    // clock frequency in Hz, 8e6 .. 200e6
    parameter int unsigned XTAL_HZ    = 16_000_000,    // no effect
    parameter              TIMING     = "FAST",        // or "DATASHEET", which has the same effect
    parameter              STEP_ACK   = "MANUAL",      // or "ECHO": instruction s returns its data, not 3
    parameter int unsigned BAUD       = 9600,          // baud rate of the line, 1200 .. 115 200
    parameter int unsigned I2C_HZ     = 400_000,       // clock of the EEPROM in Hz, 10e3 .. 400e3
    parameter int unsigned EE_DEV     = 'h50,          // address of the EEPROM, 0 .. 127
    parameter int unsigned T_OFF_NS   = 20_000,        // off time of the chopper in ns, 1_000 .. 100_000
    parameter int unsigned T_BLANK_NS = 1_000,         // blanking time in ns, 100 .. 10_000
    parameter int unsigned FW_VERSION = 32'h0000_0123  // 32 bits; reply to instruction R
) (
    input  wire logic       clk,
    input  wire logic       rst_n,
    // host
    input  wire logic       rxd,
    output logic            txd,
    output logic            de,
    // switches, general inputs and outputs, converters
    input  wire logic       ext1,
    input  wire logic       ext2,
    output logic            ext1_pu,
    output logic            ext2_pu,
    input  wire logic       fset_n,
    input  wire logic [4:0] gpi,
    output logic      [4:0] gpo,
    input  wire logic [9:0] adc_data,
    input  wire logic       adc_valid,
    input  wire logic [9:0] bemf_level,
    input  wire logic       bemf_valid,
    // motor
    output logic      [7:0] phase_a_ref,
    output logic            phase_a_sign,
    output logic      [7:0] phase_b_ref,
    output logic            phase_b_sign,
    output logic            pwm_a_ref,
    output logic            pwm_b_ref,
    input  wire logic       cmp_a,
    input  wire logic       cmp_b,
    output logic            bridge_a_en,
    output logic            bridge_b_en,
    output logic            m10,
    output logic            m11,
    output logic            m20,
    output logic            m21,
    // EEPROM, open drain
    input  wire logic       scl_i,
    output logic            scl_o,
    output logic            scl_oe,
    input  wire logic       sda_i,
    output logic            sda_o,
    output logic            sda_oe,
    // monitor of the motion
    output logic            mon_step,
    output logic            mon_dir,
    output logic            mon_busy
);

  if (128'(TIMING) != "FAST" && 128'(TIMING) != "DATASHEET") begin : g_check_timing
    $fatal(1, "pmc006: TIMING must be FAST or DATASHEET");
  end
  if (128'(STEP_ACK) != "MANUAL" && 128'(STEP_ACK) != "ECHO") begin : g_check_ack
    $fatal(1, "pmc006: STEP_ACK must be MANUAL or ECHO");
  end
  if (CLK_HZ < 8_000_000 || CLK_HZ > 200_000_000) begin : g_check_clk
    $fatal(1, "pmc006: CLK_HZ must be 8e6 .. 200e6");
  end
  if (BAUD < 1200 || BAUD > 115_200) begin : g_check_baud
    $fatal(1, "pmc006: BAUD must be 1200 .. 115200");
  end
  if (I2C_HZ < 10_000 || I2C_HZ > 400_000) begin : g_check_i2c
    $fatal(1, "pmc006: I2C_HZ must be 10000 .. 400000");
  end
  if (EE_DEV > 'h7f) begin : g_check_device
    $fatal(1, "pmc006: EE_DEV must be 0 .. 127");
  end
  if (T_OFF_NS < 1_000 || T_OFF_NS > 100_000) begin : g_check_off
    $fatal(1, "pmc006: T_OFF_NS must be 1000 .. 100000");
  end
  if (T_BLANK_NS < 100 || T_BLANK_NS > 10_000) begin : g_check_blank
    $fatal(1, "pmc006: T_BLANK_NS must be 100 .. 10000");
  end

  // ---- reset, time, inputs --------------------------------------------------------------------------------

  logic rst_core_n, us, unused_crystal;
  logic fset_sync_n, scl_sync, sda_sync;
  logic [1:0] ext_sync;
  logic [4:0] gpi_sync;
  logic [9:0] unused_meta;

  assign unused_crystal = &{1'b0, XTAL_HZ};

  ppmc_reset u_reset (
      .clk_i (clk),
      .rst_ni(rst_n),
      .rst_no(rst_core_n)
  );

  ppmc_tick_gen #(
      .ClkHz   (CLK_HZ),
      .XtalHz  (1_000_000),
      .TickXtal(1)
  ) u_us (
      .clk_i    (clk),
      .rst_ni   (rst_core_n),
      .restart_i(1'b0),
      .tick_o   (us)
  );

  ppmc_sync #(
      .Width(10)
  ) u_pins (
      .clk_i (clk),
      .rst_ni(rst_core_n),
      .d_i   ({fset_n, scl_i, sda_i, ext2, ext1, gpi}),
      .q1_o  (unused_meta),
      .q2_o  ({fset_sync_n, scl_sync, sda_sync, ext_sync, gpi_sync})
  );

  // ---- host -----------------------------------------------------------------------------------------------

  logic boot;
  logic [7:0] addr;
  logic [31:0] reply;
  frame_t frame;

  pmc006_serial #(
      .ClkHz(CLK_HZ),
      .Baud (BAUD)
  ) u_serial (
      .clk_i  (clk),
      .rst_ni (rst_core_n),
      .ready_i(!boot),
      .addr_i (addr),
      .rxd_i  (rxd),
      .txd_o  (txd),
      .de_o   (de),
      .frame_o(frame),
      .reply_i(reply)
  );

  // ---- control, motion, drive -----------------------------------------------------------------------------

  motor_settings_t settings;
  motion_start_t motion_start;
  motion_status_t motion;
  drive_cmd_t drive_cmd;
  logic halt, step;
  logic [7:0] base;

  pmc006_control #(
      .ClkHz  (CLK_HZ),
      .I2cHz  (I2C_HZ),
      .Device (7'(EE_DEV)),
      .Echo   (128'(STEP_ACK) == "ECHO"),
      .Version(FW_VERSION)
  ) u_control (
      .clk_i         (clk),
      .rst_ni        (rst_core_n),
      .us_i          (us),
      .boot_o        (boot),
      .frame_i       (frame),
      .reply_o       (reply),
      .addr_o        (addr),
      .fset_ni       (fset_sync_n),
      .ext_i         (ext_sync),
      .gpi_i         (gpi_sync),
      .pull_up_o     ({ext2_pu, ext1_pu}),
      .gpo_o         (gpo),
      .bemf_i        ({bemf_valid, bemf_level}),
      .scl_i         (scl_sync),
      .sda_i         (sda_sync),
      .scl_oe_o      (scl_oe),
      .sda_oe_o      (sda_oe),
      .settings_o    (settings),
      .motion_start_o(motion_start),
      .halt_o        (halt),
      .motion_i      (motion),
      .step_i        (step)
  );

  pmc006_base_rom u_base (
      .clk_i    (clk),
      .current_i(settings.cur),
      .base_o   (base)
  );

  pmc006_motion u_motion (
      .clk_i         (clk),
      .rst_ni        (rst_core_n),
      .us_i          (us),
      .settings_i    (settings),
      .base_i        (base),
      .motion_start_i(motion_start),
      .halt_i        (halt),
      .adc_i         ({adc_valid, adc_data}),
      .motion_o      (motion),
      .step_o        (step),
      .drive_cmd_o   (drive_cmd)
  );

  pmc006_drive #(
      .ClkHz   (CLK_HZ),
      .TOffNs  (T_OFF_NS),
      .TBlankNs(T_BLANK_NS)
  ) u_drive (
      .clk_i         (clk),
      .rst_ni        (rst_core_n),
      .us_i          (us),
      .boot_i        (boot),
      .settings_i    (settings),
      .base_i        (base),
      .busy_i        (motion.busy),
      .step_i        (step),
      .forward_i     (motion.forward),
      .increment_i   (drive_cmd.increment),
      .current_comp_i(drive_cmd.current_comp),
      .lead_angle_i  (drive_cmd.lead_angle),
      .cmp_a_i       (cmp_a),
      .cmp_b_i       (cmp_b),
      .phase_a_ref_o (phase_a_ref),
      .phase_a_sign_o(phase_a_sign),
      .phase_b_ref_o (phase_b_ref),
      .phase_b_sign_o(phase_b_sign),
      .pwm_a_ref_o   (pwm_a_ref),
      .pwm_b_ref_o   (pwm_b_ref),
      .bridge_a_en_o (bridge_a_en),
      .bridge_b_en_o (bridge_b_en),
      .m10_o         (m10),
      .m11_o         (m11),
      .m20_o         (m20),
      .m21_o         (m21)
  );

  always_ff @(posedge clk or negedge rst_core_n) begin
    if (!rst_core_n) mon_step <= 1'b0;
    else mon_step <= step;
  end

  assign mon_dir = motion.forward;
  assign mon_busy = motion.busy;
  assign scl_o = 1'b0;
  assign sda_o = 1'b0;

endmodule

`default_nettype wire
