// SPDX-License-Identifier: Apache-2.0
// Written by `make boards` from constraints/tangnano20k/board.yml and ppmc312_carrier.sv; change those, not this.
// board_tangnano20k_ppmc312: PPMC-312 with UART host on Tang Nano 20K (GW2AR-LV18QN88C8/I7), clk 54 MHz from the 27
//         MHz oscillator.
// Rules:  pins, LEDs, wiring: docs/boards.md; constraints/tangnano20k/ppmc312/pins.cst. Only two general inputs and
//         two general outputs have pins, and the bus is omitted, because the header has no more pins.
// Timing: see ppmc312_carrier.
`default_nettype none

module board_tangnano20k_ppmc312 #(
    parameter int unsigned XTAL_HZ = 16_000_000,
    parameter              TIMING  = "FAST",
    parameter int unsigned BAUD    = 115_200,     // baud rate of the bridge after reset
    parameter int unsigned RECORD  = 0            // 4 .. 16: 2**RECORD records of the pins; 0: no recorder
) (
    input  wire logic       clk_27m,   // 27 MHz
    input  wire logic       btn,       // 1: reset
    // UART host, or a master of the serial line
    input  wire logic       uart_rxd,  // from the PC
    output logic            uart_txd,  // to the PC
    // switches, drive, encoder, start gate, events; pins that end in _n are active low
    input  wire logic       fl_n,
    input  wire logic       bl_n,
    input  wire logic       fhl_n,
    input  wire logic       bhl_n,
    input  wire logic       org_n,
    input  wire logic       index_n,
    input  wire logic       alm_n,
    input  wire logic       end_n,
    input  wire logic       epin,
    input  wire logic       epdir,
    input  wire logic       run,
    input  wire logic       evt0_n,
    input  wire logic       evt1_n,
    input  wire logic       extck,
    input  wire logic [1:0] auxi,
    // motor and drive
    output logic            pout,
    output logic            dir,
    output logic            exon_n,
    output logic            cd_n,
    output logic            cclr_n,
    output logic            aclr_n,
    output logic            zclmp_n,
    output logic            intlk_n,
    output logic      [1:0] auxo_n,
    // LEDs, 0 = on
    output logic      [3:0] led_n
);

  localparam int unsigned ClkHz = 54_000_000;

  logic clk, lock, rst_n, led_link, led_moving, led_switch, unused;
  logic [3:0] leds;
  logic [5:0] part_auxo_n;

  ppmc_clock_tangnano #(
      .Device("GW2A-18C"),
      .OutDiv(16)
  ) u_clock (
      .clk_27m_i(clk_27m),
      .clk_o    (clk),
      .lock_o   (lock)
  );

  ppmc_board_leds #(
      .ClkHz(ClkHz)
  ) u_leds (
      .clk_i   (clk),
      .lock_i  (lock),
      .req_ni  (!btn),
      .rst_no  (rst_n),
      .link_i  (led_link),
      .moving_i(led_moving),
      .switch_i(led_switch),
      .leds_o  (leds)
  );

  ppmc312_carrier #(
      .CLK_HZ (ClkHz),
      .XTAL_HZ(XTAL_HZ),
      .TIMING (TIMING),
      .HOST   ("UART"),
      .BAUD   (BAUD),
      .RECORD (RECORD)
  ) u_carrier (
      .clk,
      .rst_n,
      .uart_rxd,
      .uart_txd,
      .rs485_rxd(1'b1),
      .rs485_txd(),
      .rs485_de (),
      .hsp      (1'b1),
      .mod      ('1),
      .adr      ('1),
      .rs       ('1),
      .cs_n     (1'b1),
      .oe_n     (1'b1),
      .we_n     (1'b1),
      .d_i      ('1),
      .d_o      (),
      .d_oe     (),
      .wrq_n    (),
      .irq_n    (),
      .fl_n,
      .bl_n,
      .fhl_n,
      .bhl_n,
      .org_n,
      .index_n,
      .alm_n,
      .end_n,
      .epin,
      .epdir,
      .run,
      .evt0_n,
      .evt1_n,
      .extck,
      .auxi     ({6'b111111, auxi}),
      .pout,
      .dir,
      .exon_n,
      .cd_n,
      .cclr_n,
      .aclr_n,
      .zclmp_n,
      .intlk_n,
      .auxo_n   (part_auxo_n),
      .hold     (),
      .led_link,
      .led_moving,
      .led_switch
  );

  assign auxo_n = part_auxo_n[1:0];
  assign led_n  = ~leds;

  assign unused = ^{part_auxo_n[5:2]};

endmodule

`default_nettype wire
