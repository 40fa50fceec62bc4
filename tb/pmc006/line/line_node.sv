// SPDX-License-Identifier: Apache-2.0
// line_node: a PMC006B4 on the virtual line: pmc006_carrier with an EEPROM, and with ports for the motor
//         and the switches. Each line_node has the ports clk, rst_n, uart_rxd, line and busy.
// Timing: see pmc006_carrier. While busy is 0 and the line is idle, only the line and the inputs can cause
//         a change.
`default_nettype none

module line_node #(
    parameter int unsigned CLK_HZ   = 8_000_000,
    parameter              STEP_ACK = "MANUAL",
    parameter int unsigned BAUD     = 9600
) (
    input  wire logic       clk,
    input  wire logic       rst_n,
    // line
    input  wire logic       uart_rxd,
    output logic            line,      // output of the driver; 1 while the driver is off
    // switches, inputs, outputs
    input  wire logic       ext1,
    input  wire logic       ext2,
    input  wire logic [4:0] gpi,
    output logic      [4:0] gpo,
    // motor
    output logic      [8:0] angle,     // electrical angle, 128 per full step
    // status
    output logic            busy,
    output logic      [7:0] address,
    output logic            booting,
    output logic            moving,
    output logic            free,      // 1: no current
    output logic            locked     // 1: EXT1 or EXT2 has stopped the motor
);

  logic txd, de, scl_oe, sda_oe, ee_scl, ee_sda, scl, sda, unused;
  logic uart_txd, m10, m11, m20, m21, bridge_a_en, bridge_b_en, pwm_a_ref, pwm_b_ref, ext1_pu, ext2_pu;
  logic mon_step, mon_dir;
  logic [3:0] lamps;

  assign scl = !(scl_oe || ee_scl);
  assign sda = !(sda_oe || ee_sda);

  pmc006_carrier #(
      .CLK_HZ  (CLK_HZ),
      .STEP_ACK(STEP_ACK),
      .BAUD    (BAUD)
  ) u_carrier (
      .clk,
      .lock     (1'b1),
      .req_n    (rst_n),
      .uart_rxd (1'b1),
      .uart_txd,
      .rs485_rxd(uart_rxd),
      .rs485_txd(txd),
      .rs485_de (de),
      .m10,
      .m11,
      .bridge_a_en,
      .m20,
      .m21,
      .bridge_b_en,
      .pwm_a_ref,
      .pwm_b_ref,
      .cmp_a    (1'b0),
      .cmp_b    (1'b0),
      .ext1,
      .ext2,
      .ext1_pu,
      .ext2_pu,
      .fset_n   (1'b1),
      .gpi,
      .gpo,
      .conv     ('0),
      .adc_stb  (1'b0),
      .bemf_stb (1'b0),
      .scl_i    (scl),
      .scl_oe,
      .sda_i    (sda),
      .sda_oe,
      .mon_step,
      .mon_dir,
      .lamps
  );

  eeprom_24c32 #(
      .WriteCycles(CLK_HZ / 200)  // 5 ms
  ) u_eeprom (
      .clk_i   (clk),
      .on_i    (1'b1),
      .scl_i   (scl),
      .sda_i   (sda),
      .scl_oe_o(ee_scl),
      .sda_oe_o(ee_sda)
  );

  assign line = txd || !de;
  assign angle = u_carrier.u_part.u_drive.angle_q;
  assign address = u_carrier.u_part.addr;
  assign booting = !u_carrier.rst_n || u_carrier.u_part.boot;
  assign moving = u_carrier.mon_busy;
  assign free = u_carrier.u_part.settings.free;
  assign locked = |u_carrier.u_part.u_control.flags;
  assign busy = booting || moving || de || !u_carrier.u_part.u_control.ee_idle ||
                |u_carrier.u_part.u_control.u_program.state_q ||
                !(u_carrier.u_part.u_serial.timeout || u_carrier.u_part.u_serial.u_frame.index_q == '0);
  assign unused = ^{uart_txd, m10, m11, m20, m21, bridge_a_en, bridge_b_en, pwm_a_ref, pwm_b_ref, ext1_pu,
                    ext2_pu, mon_step, mon_dir, lamps};

endmodule

`default_nettype wire
