// SPDX-License-Identifier: Apache-2.0
// pmc006_board_bench: a board with a PMC006B4 and its EEPROM, which share open-drain lines.
`default_nettype none

module pmc006_board_bench (
    input  wire logic       clk,
    input  wire logic       btn_n,
    input  wire logic       uart_rxd,
    output logic            uart_txd,
    input  wire logic       rs485_rxd,
    output logic            rs485_txd,
    output logic            rs485_de,
    input  wire logic       cmp,
    output logic            bridge_a_en,
    output logic            bridge_b_en,
    input  wire logic       ext1,
    input  wire logic       ext2,
    input  wire logic [4:0] gpi,
    output logic      [4:0] gpo,
    input  wire logic [9:0] conv,
    input  wire logic       adc_stb,
    input  wire logic       bemf_stb,
    output logic            mon_step,
    output logic      [3:0] lamps
);

  logic scl, sda, scl_part, sda_part, scl_device, sda_device, scl_pin, sda_pin;

  assign scl = !(scl_part || scl_device);
  assign sda = !(sda_part || sda_device);

  // The EEPROM has no clock in common with the part, so the pins of the part change while clk is low.
  always_latch if (!clk) {scl_pin, sda_pin} = {scl, sda};

  eeprom_24c32 #(
      .WriteCycles(8_000)
  ) u_eeprom (
      .clk_i   (clk),
      .on_i    (1'b1),
      .scl_i   (scl),
      .sda_i   (sda),
      .scl_oe_o(scl_device),
      .sda_oe_o(sda_device)
  );

  pmc006_carrier #(
      .CLK_HZ(8_000_000),
      .BAUD  (115_200)
  ) u_board (
      .clk,
      .lock     (1'b1),
      .req_n    (btn_n),
      .uart_rxd,
      .uart_txd,
      .rs485_rxd,
      .rs485_txd,
      .rs485_de,
      .m10      (),
      .m11      (),
      .bridge_a_en,
      .m20      (),
      .m21      (),
      .bridge_b_en,
      .pwm_a_ref(),
      .pwm_b_ref(),
      .cmp_a    (cmp),
      .cmp_b    (cmp),
      .ext1,
      .ext2,
      .ext1_pu  (),
      .ext2_pu  (),
      .fset_n   (1'b1),
      .gpi,
      .gpo,
      .conv,
      .adc_stb,
      .bemf_stb,
      .scl_i    (scl_pin),
      .scl_oe   (scl_part),
      .sda_i    (sda_pin),
      .sda_oe   (sda_part),
      .mon_step,
      .mon_dir  (),
      .lamps
  );

endmodule

`default_nettype wire
