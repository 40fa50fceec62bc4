// SPDX-License-Identifier: Apache-2.0
// Written by `make boards` from constraints/ulx3s/board.yml and ppmc312_carrier.sv; change those, not this.
// board_ulx3s_ppmc312: PPMC-312 with UART or bus host on ULX3S v2.0 … v3.0 (LFE5U-25F, -85F, CABGA381), clk 50 MHz
//         from the 25 MHz oscillator.
// Rules:  pins, LEDs, wiring: docs/boards.md; constraints/ulx3s/ppmc312/pins.lpf.
// Timing: see ppmc312_carrier.
`default_nettype none

module board_ulx3s_ppmc312 #(
    parameter int unsigned XTAL_HZ = 16_000_000,
    parameter              TIMING  = "FAST",
    parameter              HOST    = "UART",      // or "BUS", "SERIAL"
    parameter int unsigned BAUD    = 115_200,     // baud rate of the bridge after reset
    parameter int unsigned RECORD  = 0            // 4 .. 16: 2**RECORD records of the pins; 0: no recorder
) (
    input  wire logic       clk_25m,     // 25 MHz
    input  wire logic       btn_f1,      // 1: reset
    input  wire logic       host_rst_n,  // 0: reset, from the host
    // UART host, or a master of the serial line
    input  wire logic       uart_rxd,    // from the PC
    output logic            uart_txd,    // to the PC
    // bus host; d_oe = 0 unless HOST = "BUS", because reads then remain inside the FPGA
    input  wire logic [2:0] rs,
    input  wire logic       cs_n,
    input  wire logic       oe_n,
    input  wire logic       we_n,
    inout  wire logic [7:0] d,
    output logic            d_oe,        // direction of a bus transceiver, 1: FPGA to host
    output logic            wrq_n,
    output logic            irq_n,
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
    input  wire logic [7:0] auxi,
    // motor and drive
    output logic            pout,
    output logic            dir,
    output logic            exon_n,
    output logic            cd_n,
    output logic            cclr_n,
    output logic            aclr_n,
    output logic            zclmp_n,
    output logic            intlk_n,
    output logic      [5:0] auxo_n,
    // LEDs, 1 = on
    output logic      [3:0] led,
    // constant
    output logic            wifi_gpio0   // boot pin of the ESP32
);

  localparam int unsigned ClkHz = 50_000_000;

  logic clk, lock, rst_n, led_link, led_moving, led_switch;
  logic [3:0] leds;
  logic [7:0] part_d;

  ppmc_clock_ulx3s #(
      .Divisor(12)
  ) u_clock (
      .clk_25m_i(clk_25m),
      .clk_o    (clk),
      .lock_o   (lock)
  );

  ppmc_board_leds #(
      .ClkHz(ClkHz)
  ) u_leds (
      .clk_i   (clk),
      .lock_i  (lock),
      .req_ni  (!btn_f1 && host_rst_n),
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
      .HOST   (HOST),
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
      .rs,
      .cs_n,
      .oe_n,
      .we_n,
      .d_i      (d),
      .d_o      (part_d),
      .d_oe,
      .wrq_n,
      .irq_n,
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
      .auxi,
      .pout,
      .dir,
      .exon_n,
      .cd_n,
      .cclr_n,
      .aclr_n,
      .zclmp_n,
      .intlk_n,
      .auxo_n,
      .hold     (),
      .led_link,
      .led_moving,
      .led_switch
  );

  assign d          = d_oe ? part_d : 'z;
  assign led        = leds;

  // A low level would put the ESP32 into its boot loader at its next reset.
  assign wifi_gpio0 = 1'b1;

endmodule

`default_nettype wire
