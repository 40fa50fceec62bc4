// SPDX-License-Identifier: Apache-2.0
// Written by `make boards` from constraints/icebreaker/board.yml and pmc006_carrier.sv; change those, not this.
// board_icebreaker_pmc006: PMC006B4 on iCEBreaker (iCE40UP5K-SG48), clk 24 MHz from the 12 MHz oscillator.
// Rules:  pins, LEDs, wiring: docs/boards.md; constraints/icebreaker/pmc006/pins.pcf. Three of the five inputs and
//         three of the five outputs have pins. The A/D converter has no pins, so there is no analog speed and no
//         stall detection.
// Timing: see pmc006_carrier.
`default_nettype none

module board_icebreaker_pmc006 #(
    parameter              STEP_ACK   = "MANUAL",  // or "ECHO"
    parameter int unsigned BAUD       = 9600,
    parameter int unsigned I2C_HZ     = 400_000,
    parameter int unsigned T_OFF_NS   = 20_000,
    parameter int unsigned T_BLANK_NS = 1_000
) (
    input  wire logic       clk_12m,      // 12 MHz
    input  wire logic       btn_n,        // 0: reset
    // host: USB-UART
    input  wire logic       uart_rxd,
    output logic            uart_txd,
    // host: RS-485 transceiver
    input  wire logic       rs485_rxd,    // receiver output RO of the transceiver
    output logic            rs485_txd,    // driver input DI
    output logic            rs485_de,     // driver enable DE
    // H-bridges of the motor
    output logic            m10,
    output logic            m11,
    output logic            bridge_a_en,
    output logic            m20,
    output logic            m21,
    output logic            bridge_b_en,
    output logic            pwm_a_ref,    // reference of the comparator, before the low-pass filter
    output logic            pwm_b_ref,
    input  wire logic       cmp_a,        // 1: the current has reached the reference
    input  wire logic       cmp_b,
    // switches, inputs, outputs
    input  wire logic       ext1,
    input  wire logic       ext2,
    input  wire logic       fset_n,
    input  wire logic [2:0] gpi,
    output logic      [2:0] gpo,
    // EEPROM bus; *_oe = 1 drives the line low
    inout  wire logic       scl,
    inout  wire logic       sda,
    // LEDs, 0 = on
    output logic            ledg_n,
    output logic            ledr_n
);

  localparam int unsigned ClkHz = 24_000_000;

  logic clk, lock, scl_oe, sda_oe, unused;
  logic [3:0] leds;
  logic [4:0] part_gpo;

  ppmc_clock_icebreaker u_clock (
      .clk_12m_i(clk_12m),
      .clk_o    (clk),
      .lock_o   (lock)
  );

  pmc006_carrier #(
      .CLK_HZ    (ClkHz),
      .STEP_ACK  (STEP_ACK),
      .BAUD      (BAUD),
      .I2C_HZ    (I2C_HZ),
      .T_OFF_NS  (T_OFF_NS),
      .T_BLANK_NS(T_BLANK_NS)
  ) u_carrier (
      .clk,
      .lock,
      .req_n   (btn_n),
      .uart_rxd,
      .uart_txd,
      .rs485_rxd,
      .rs485_txd,
      .rs485_de,
      .m10,
      .m11,
      .bridge_a_en,
      .m20,
      .m21,
      .bridge_b_en,
      .pwm_a_ref,
      .pwm_b_ref,
      .cmp_a,
      .cmp_b,
      .ext1,
      .ext2,
      .ext1_pu (),
      .ext2_pu (),
      .fset_n,
      .gpi     ({2'b11, gpi}),
      .gpo     (part_gpo),
      .conv    ('0),
      .adc_stb (1'b0),
      .bemf_stb(1'b0),
      .scl_i   (scl),
      .scl_oe,
      .sda_i   (sda),
      .sda_oe,
      .mon_step(),
      .mon_dir (),
      .lamps   (leds)
  );

  assign scl    = scl_oe ? 1'b0 : 'z;
  assign sda    = sda_oe ? 1'b0 : 'z;
  assign gpo    = part_gpo[2:0];
  assign ledg_n = ~leds[0];
  assign ledr_n = ~leds[1];

  assign unused = ^{part_gpo[4:3], leds[3:2]};

endmodule

`default_nettype wire
