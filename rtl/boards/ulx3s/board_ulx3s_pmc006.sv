// SPDX-License-Identifier: Apache-2.0
// Written by `make boards` from constraints/ulx3s/board.yml and pmc006_carrier.sv; change those, not this.
// board_ulx3s_pmc006: PMC006B4 on ULX3S v2.0 … v3.0 (LFE5U-25F, -85F, CABGA381), clk 50 MHz from the 25 MHz
//         oscillator.
// Rules:  pins, LEDs, wiring: docs/boards.md; constraints/ulx3s/pmc006/pins.lpf.
// Timing: see pmc006_carrier.
`default_nettype none

module board_ulx3s_pmc006 #(
    parameter              STEP_ACK   = "MANUAL",  // or "ECHO"
    parameter int unsigned BAUD       = 9600,
    parameter int unsigned I2C_HZ     = 400_000,
    parameter int unsigned T_OFF_NS   = 20_000,
    parameter int unsigned T_BLANK_NS = 1_000
) (
    input  wire logic       clk_25m,      // 25 MHz
    input  wire logic       btn_f1,       // 1: reset
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
    output logic            ext1_pu,
    output logic            ext2_pu,
    input  wire logic       fset_n,
    input  wire logic [4:0] gpi,
    output logic      [4:0] gpo,
    // A/D converter: one bus, two strobes
    input  wire logic [9:0] conv,
    input  wire logic       adc_stb,      // rising edge: conv is the voltage of GPI1
    input  wire logic       bemf_stb,     // rising edge: conv is the back EMF
    // EEPROM bus; *_oe = 1 drives the line low
    inout  wire logic       scl,
    inout  wire logic       sda,
    // monitor
    output logic            mon_step,
    output logic            mon_dir,
    // LEDs, 1 = on
    output logic      [3:0] led,
    // constant
    output logic            wifi_gpio0    // boot pin of the ESP32
);

  localparam int unsigned ClkHz = 50_000_000;

  logic clk, lock, scl_oe, sda_oe;
  logic [3:0] leds;

  ppmc_clock_ulx3s #(
      .Divisor(12)
  ) u_clock (
      .clk_25m_i(clk_25m),
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
      .req_n(!btn_f1),
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
      .ext1_pu,
      .ext2_pu,
      .fset_n,
      .gpi,
      .gpo,
      .conv,
      .adc_stb,
      .bemf_stb,
      .scl_i(scl),
      .scl_oe,
      .sda_i(sda),
      .sda_oe,
      .mon_step,
      .mon_dir,
      .lamps(leds)
  );

  assign scl        = scl_oe ? 1'b0 : 'z;
  assign sda        = sda_oe ? 1'b0 : 'z;
  assign led        = leds;

  // A low level would put the ESP32 into its boot loader at its next reset.
  assign wifi_gpio0 = 1'b1;

endmodule

`default_nettype wire
