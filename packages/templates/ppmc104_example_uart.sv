// SPDX-License-Identifier: Apache-2.0
// ppmc104_example_uart: a PPMC-104 that a PC reaches over two wires.
//         Copy it and change it; `make lint` elaborates it as it stands. Manual: docs/integration.md.
`default_nettype none

module ppmc104_example_uart #(
    parameter int unsigned CLK_HZ  = 16_000_000,  // frequency of clk, 8e6 .. 200e6
    parameter int unsigned XTAL_HZ = 16_000_000   // all speeds of the part follow it
) (
    input  wire logic       clk,
    input  wire logic       rst_n,     // may assert at any time
    // serial line to the PC, 115 200 8N1
    input  wire logic       uart_rxd,
    output logic            uart_txd,
    // switches, 0 = active; asynchronous
    input  wire logic       l1_n,
    input  wire logic       l2_n,
    input  wire logic       l3_n,
    input  wire logic       l4_n,
    input  wire logic       cnp_n,
    input  wire logic       alm_n,
    // motor
    output logic      [5:1] s,
    output logic            hold,
    output logic            pout_n,
    output logic            dir
);

  logic unused_oe, unused_int, unused_aux;
  logic [7:0] unused_d;
  logic [3:0] unused_auxo;
  logic [2:0] unused_led;

  ppmc104_carrier #(
      .CLK_HZ    (CLK_HZ),
      .XTAL_HZ   (XTAL_HZ),
      .TIMING    ("FAST"),
      .PHASE_IDLE(1'b1),     // 0 if the drivers switch a coil on with H
      .HOST      ("UART"),
      .BAUD      (115_200)
  ) u_board (
      .clk,
      .rst_n,
      .uart_rxd,
      .uart_txd,
      .a0        (1'b0),
      .cs_n      (1'b1),
      .rd_n      (1'b1),
      .wr_n      (1'b1),
      .d_i       (8'h00),
      .d_o       (unused_d),
      .d_oe      (unused_oe),
      .int_n     (unused_int),
      .csel      (1'b1),
      .vsel      (1'b1),
      .clock     (1'b0),
      .l1_n,
      .l2_n,
      .l3_n,
      .l4_n,
      .cnp_n,
      .alm_n,
      .auxi      (4'b0000),
      .auxo      (unused_auxo),
      .aux_n     (unused_aux),
      .s,
      .hold,
      .pout_n,
      .dir,
      .led_link  (unused_led[0]),
      .led_moving(unused_led[1]),
      .led_switch(unused_led[2])
  );

endmodule

`default_nettype wire
