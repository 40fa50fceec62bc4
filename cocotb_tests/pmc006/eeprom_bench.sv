// SPDX-License-Identifier: Apache-2.0
// pmc006_eeprom_bench: a PMC006B4 and its EEPROM on two open-drain lines. Ports and parameters are those of
//         pmc006, but the lines are outputs, and ee_on switches the power of the EEPROM.
`default_nettype none

module pmc006_eeprom_bench #(
    parameter int unsigned CLK_HZ     = 16_000_000,
    parameter int unsigned XTAL_HZ    = 16_000_000,
    parameter              TIMING     = "FAST",
    parameter              STEP_ACK   = "MANUAL",
    parameter int unsigned BAUD       = 9600,
    parameter int unsigned I2C_HZ     = 400_000,
    parameter int unsigned EE_DEV     = 'h50,
    parameter int unsigned T_OFF_NS   = 20_000,
    parameter int unsigned T_BLANK_NS = 1_000,
    parameter int unsigned FW_VERSION = 32'h0000_0123
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
    // levels of the I2C lines, driven by part and EEPROM; ee_on = 1: the EEPROM has power
    input  wire logic       ee_on,
    output logic            scl_i,
    output logic            scl_o,
    output logic            scl_oe,
    output logic            sda_i,
    output logic            sda_o,
    output logic            sda_oe,
    // monitoring
    output logic            mon_step,
    output logic            mon_dir,
    output logic            mon_busy
);

  logic scl_device, sda_device, scl_pin, sda_pin;

  assign scl_i = !(scl_oe || scl_device);
  assign sda_i = !(sda_oe || sda_device);

  // The EEPROM has no clock in common with the part, so the pins of the part change while clk is low.
  always_latch if (!clk) {scl_pin, sda_pin} = {scl_i, sda_i};

  eeprom_24c32 u_eeprom (
      .clk_i   (clk),
      .on_i    (ee_on),
      .scl_i,
      .sda_i,
      .scl_oe_o(scl_device),
      .sda_oe_o(sda_device)
  );

  pmc006 #(
      .CLK_HZ    (CLK_HZ),
      .XTAL_HZ   (XTAL_HZ),
      .TIMING    (TIMING),
      .STEP_ACK  (STEP_ACK),
      .BAUD      (BAUD),
      .I2C_HZ    (I2C_HZ),
      .EE_DEV    (EE_DEV),
      .T_OFF_NS  (T_OFF_NS),
      .T_BLANK_NS(T_BLANK_NS),
      .FW_VERSION(FW_VERSION)
  ) u_part (
      .clk,
      .rst_n,
      .rxd,
      .txd,
      .de,
      .ext1,
      .ext2,
      .ext1_pu,
      .ext2_pu,
      .fset_n,
      .gpi,
      .gpo,
      .adc_data,
      .adc_valid,
      .bemf_level,
      .bemf_valid,
      .phase_a_ref,
      .phase_a_sign,
      .phase_b_ref,
      .phase_b_sign,
      .pwm_a_ref,
      .pwm_b_ref,
      .cmp_a,
      .cmp_b,
      .bridge_a_en,
      .bridge_b_en,
      .m10,
      .m11,
      .m20,
      .m21,
      .scl_i(scl_pin),
      .scl_o,
      .scl_oe,
      .sda_i(sda_pin),
      .sda_o,
      .sda_oe,
      .mon_step,
      .mon_dir,
      .mon_busy
  );

endmodule

`default_nettype wire
