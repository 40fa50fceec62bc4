// SPDX-License-Identifier: Apache-2.0
// pmc006_line: a PMC006B4 with its EEPROM, for the test of the C driver.
// Timing: see pmc006.
`default_nettype none

module pmc006_line #(
    parameter int unsigned CLK_HZ = 8_000_000,
    parameter int unsigned BAUD   = 115_200
) (
    input  wire logic       clk,
    input  wire logic       rst_n,
    input  wire logic       rxd,
    output logic            line,       // level of the line; 1 while the driver is off
    input  wire logic       ext1,
    input  wire logic       ext2,
    input  wire logic       eeprom_on,
    output logic      [4:0] gpo,
    output logic            step,
    output logic            forward
);

  logic txd, de, scl_oe, sda_oe, ee_scl, ee_sda, scl, sda;

  assign scl  = !(scl_oe || ee_scl);
  assign sda  = !(sda_oe || ee_sda);
  assign line = txd || !de;

  pmc006 #(
      .CLK_HZ(CLK_HZ),
      .BAUD  (BAUD)
  ) u_part (
      .clk,
      .rst_n,
      .rxd,
      .txd,
      .de,
      .ext1,
      .ext2,
      .ext1_pu     (),
      .ext2_pu     (),
      .fset_n      (1'b1),
      .gpi         ('1),
      .gpo,
      .adc_data    ('0),
      .adc_valid   (1'b0),
      .bemf_level  ('0),
      .bemf_valid  (1'b0),
      .phase_a_ref (),
      .phase_a_sign(),
      .phase_b_ref (),
      .phase_b_sign(),
      .pwm_a_ref   (),
      .pwm_b_ref   (),
      .cmp_a       (1'b0),
      .cmp_b       (1'b0),
      .bridge_a_en (),
      .bridge_b_en (),
      .m10         (),
      .m11         (),
      .m20         (),
      .m21         (),
      .scl_i       (scl),
      .scl_o       (),
      .scl_oe,
      .sda_i       (sda),
      .sda_o       (),
      .sda_oe,
      .mon_step    (step),
      .mon_dir     (forward),
      .mon_busy    ()
  );

  eeprom_24c32 #(
      .WriteCycles(CLK_HZ / 200)  // 5 ms
  ) u_eeprom (
      .clk_i   (clk),
      .on_i    (eeprom_on),
      .scl_i   (scl),
      .sda_i   (sda),
      .scl_oe_o(ee_scl),
      .sda_oe_o(ee_sda)
  );

endmodule

`default_nettype wire
