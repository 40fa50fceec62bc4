// SPDX-License-Identifier: Apache-2.0
// ppmc312_board_bench: a PPMC-312 on its serial line, with the reset and the LEDs of a board.
//         All inputs that the serial line does not need are idle.
`default_nettype none

module ppmc312_board_bench (
    input  wire logic       clk,
    input  wire logic       btn_n,
    input  wire logic       uart_rxd,
    output logic            uart_txd,
    input  wire logic       rs485_rxd,
    output logic            rs485_txd,
    output logic            rs485_de,
    input  wire logic [2:0] mod,
    input  wire logic [3:0] adr,
    input  wire logic       fl_n,
    input  wire logic       alm_n,
    input  wire logic [7:0] auxi,
    output logic            pout,
    output logic            dir,
    output logic      [5:0] auxo_n,
    output logic            d_oe,
    output logic      [3:0] leds
);

  logic rst_n, led_link, led_moving, led_switch;

  ppmc_board_leds #(
      .ClkHz(8_000_000)
  ) u_leds (
      .clk_i   (clk),
      .lock_i  (1'b1),
      .req_ni  (btn_n),
      .rst_no  (rst_n),
      .link_i  (led_link),
      .moving_i(led_moving),
      .switch_i(led_switch),
      .leds_o (leds)
  );

  ppmc312_carrier #(
      .CLK_HZ(8_000_000),
      .HOST  ("SERIAL")
  ) u_carrier (
      .clk,
      .rst_n,
      .uart_rxd,
      .uart_txd,
      .rs485_rxd,
      .rs485_txd,
      .rs485_de,
      .hsp    (1'b1),
      .mod,
      .adr,
      // A constant read strobe on the bus, which the part must ignore in serial mode.
      .rs     ('1),
      .cs_n   (1'b0),
      .oe_n   (1'b0),
      .we_n   (1'b1),
      .d_i    ('0),
      .d_o    (),
      .d_oe,
      .wrq_n  (),
      .irq_n  (),
      .fl_n,
      .bl_n   (1'b1),
      .fhl_n  (1'b1),
      .bhl_n  (1'b1),
      .org_n  (1'b1),
      .index_n(1'b1),
      .alm_n,
      .end_n  (1'b1),
      .epin   (1'b0),
      .epdir  (1'b0),
      .run    (1'b1),
      .evt0_n (1'b1),
      .evt1_n (1'b1),
      .extck  (1'b0),
      .auxi,
      .pout,
      .dir,
      .exon_n (),
      .cd_n   (),
      .cclr_n (),
      .aclr_n (),
      .zclmp_n(),
      .intlk_n(),
      .auxo_n,
      .hold   (),
      .led_link,
      .led_moving,
      .led_switch
  );

endmodule

`default_nettype wire
