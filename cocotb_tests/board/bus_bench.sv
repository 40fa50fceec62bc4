// SPDX-License-Identifier: Apache-2.0
// bus_bench: a board top without a PLL, and an old host on its data bus. Both have tri-state drivers.
`default_nettype none

module bus_bench #(
    parameter        HOST = "BUS"
) (
    input  wire logic       clk,
    input  wire logic       key_n,
    input  wire logic       host_rst_n,
    input  wire logic       a0,
    input  wire logic       cs_n,
    input  wire logic       rd_n,
    input  wire logic       wr_n,
    input  wire logic       host_oe,
    input  wire logic [7:0] host_d,
    output logic      [7:0] bus,
    output logic            d_oe,
    output logic            running,
    output logic      [5:1] s,
    output logic            uart_txd
);

  wire  [7:0] d;
  logic [3:0] led;

  assign d = host_oe ? host_d : 'z;
  assign bus = d;
  assign running = led[3];

  board_de10nano_ppmc104 #(
      .HOST(HOST)
  ) u_top (
      .clk,
      .key_n,
      .uart_rxd(1'b1),
      .uart_txd,
      .a0,
      .cs_n,
      .rd_n,
      .wr_n,
      .d,
      .d_oe,
      .int_n   (),
      .host_rst_n,
      .csel    (1'b1),
      .vsel    (1'b1),
      .clock   (1'b0),
      .l1_n    (1'b1),
      .l2_n    (1'b1),
      .l3_n    (1'b1),
      .l4_n    (1'b1),
      .cnp_n   (1'b1),
      .alm_n   (1'b1),
      .auxi    (4'd0),
      .auxo    (),
      .aux_n   (),
      .s,
      .hold    (),
      .pout_n  (),
      .dir     (),
      .led     (led)
  );

endmodule

`default_nettype wire
