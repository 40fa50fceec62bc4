// SPDX-License-Identifier: Apache-2.0
// pmc006_carrier: all logic of a board with a PMC006B4 except clock generator and pads. Contains the core,
//         the reset, the LEDs, the serial line (USB and RS-485, wired-AND) and the bus of an A/D converter.
// Rules:  P006-PORT-01..04; pins: docs/pmc006/README.md, 2; LEDs, wiring: docs/boards.md.
// Timing: see pmc006 and ppmc_board_reset. The inputs need no external synchroniser.
// Assumes: conv is stable from the rising edge of adc_stb or bemf_stb until 4 cycles after it.
`default_nettype none

module pmc006_carrier #(
    parameter int unsigned CLK_HZ     = 24_000_000,  // clock frequency in Hz, 8e6 .. 200e6
    parameter              STEP_ACK   = "MANUAL",    // or "ECHO"
    parameter int unsigned BAUD       = 9600,
    parameter int unsigned I2C_HZ     = 400_000,
    parameter int unsigned T_OFF_NS   = 20_000,
    parameter int unsigned T_BLANK_NS = 1_000
) (
    input  wire logic       clk,
    input  wire logic       lock,         // 1: clk is stable; 1 without a PLL
    input  wire logic       req_n,        // 0: reset request
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
    input  wire logic       scl_i,
    output logic            scl_oe,
    input  wire logic       sda_i,
    output logic            sda_oe,
    // monitor
    output logic            mon_step,
    output logic            mon_dir,
    output logic      [3:0] lamps         // 1: on; [3]: out of reset, [2]: EXT low, [1]: motion, [0]: line
);

  logic rst_n, rxd, mon_busy, unused;
  logic [1:0] strobe, strobe_q, unused_meta, valid;
  logic [7:0] a_ref, b_ref;
  logic a_sign, b_sign, scl_o, sda_o;

  // Both lines idle high. Assumes that only one host transmits at a time.
  assign rxd = uart_rxd && rs485_rxd;
  assign uart_txd = rs485_txd;

  ppmc_board_leds #(
      .ClkHz(CLK_HZ)
  ) u_panel (
      .clk_i   (clk),
      .lock_i  (lock),
      .req_ni  (req_n),
      .rst_no  (rst_n),
      .link_i  (rs485_de),
      .moving_i(mon_busy),
      .switch_i(!(ext1 && ext2)),
      .leds_o (lamps)
  );

  ppmc_sync #(
      .Width(2)
  ) u_strobe (
      .clk_i (clk),
      .rst_ni(rst_n),
      .d_i   ({bemf_stb, adc_stb}),
      .q1_o  (unused_meta),
      .q2_o  (strobe)
  );

  always_ff @(posedge clk or negedge rst_n) begin
    if (!rst_n) strobe_q <= '1;
    else strobe_q <= strobe;
  end

  assign valid = strobe & ~strobe_q;

  pmc006 #(
      .CLK_HZ    (CLK_HZ),
      .STEP_ACK  (STEP_ACK),
      .BAUD      (BAUD),
      .I2C_HZ    (I2C_HZ),
      .T_OFF_NS  (T_OFF_NS),
      .T_BLANK_NS(T_BLANK_NS)
  ) u_part (
      .clk,
      .rst_n,
      .rxd,
      .txd         (rs485_txd),
      .de          (rs485_de),
      .ext1,
      .ext2,
      .ext1_pu,
      .ext2_pu,
      .fset_n,
      .gpi,
      .gpo,
      .adc_data    (conv),
      .adc_valid   (valid[0]),
      .bemf_level  (conv),
      .bemf_valid  (valid[1]),
      .phase_a_ref (a_ref),
      .phase_a_sign(a_sign),
      .phase_b_ref (b_ref),
      .phase_b_sign(b_sign),
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
      .scl_i,
      .scl_o,
      .scl_oe,
      .sda_i,
      .sda_o,
      .sda_oe,
      .mon_step,
      .mon_dir,
      .mon_busy
  );

  assign unused = &{1'b0, a_ref, a_sign, b_ref, b_sign, scl_o, sda_o};

endmodule

`default_nettype wire
