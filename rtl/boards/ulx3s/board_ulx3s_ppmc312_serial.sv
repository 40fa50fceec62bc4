// SPDX-License-Identifier: Apache-2.0
// Written by `make boards` from constraints/ulx3s/board.yml and ppmc312_carrier.sv; change those, not this.
// board_ulx3s_ppmc312_serial: PPMC-312 in serial mode on ULX3S v2.0 … v3.0 (LFE5U-25F, -85F, CABGA381), clk 50 MHz
//         from the 25 MHz oscillator.
// Rules:  pins, LEDs, wiring: docs/boards.md; constraints/ulx3s/ppmc312-serial/pins.lpf. Frames are accepted from the
//         USB-UART and from the RS-485 line; replies are sent to both.
// Timing: see ppmc312_carrier.
`default_nettype none

module board_ulx3s_ppmc312_serial #(
    parameter int unsigned XTAL_HZ  = 16_000_000,
    parameter              TIMING   = "FAST",
    parameter              SUM_MODE = "BINARY",    // checksum of the serial line; or "CHARS"
    parameter int unsigned SND_LEAD = 1,           // bit times from rs485_de to the start bit, 1 .. 16
    parameter int unsigned SND_WAIT = 0            // rs485_de rises SND_WAIT + 0.5 bits after a stop bit
) (
    input  wire logic       clk_25m,    // 25 MHz
    input  wire logic       btn_f1,     // 1: reset
    // UART host, or a master of the serial line
    input  wire logic       uart_rxd,   // from the PC
    output logic            uart_txd,   // to the PC
    // serial line and its straps; idle unless HOST = "SERIAL"
    input  wire logic       rs485_rxd,
    output logic            rs485_txd,
    output logic            rs485_de,
    input  wire logic       hsp,
    input  wire logic [2:0] mod,
    input  wire logic [3:0] adr,
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
    output logic            wifi_gpio0  // boot pin of the ESP32
);

  localparam int unsigned ClkHz = 50_000_000;

  logic clk, lock, rst_n, led_link, led_moving, led_switch;
  logic [3:0] leds;

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
      .req_ni  (!btn_f1),
      .rst_no  (rst_n),
      .link_i  (led_link),
      .moving_i(led_moving),
      .switch_i(led_switch),
      .leds_o  (leds)
  );

  ppmc312_carrier #(
      .CLK_HZ  (ClkHz),
      .XTAL_HZ (XTAL_HZ),
      .TIMING  (TIMING),
      .SUM_MODE(SUM_MODE),
      .SND_LEAD(SND_LEAD),
      .SND_WAIT(SND_WAIT),
      .HOST    ("SERIAL")
  ) u_carrier (
      .clk,
      .rst_n,
      .uart_rxd,
      .uart_txd,
      .rs485_rxd,
      .rs485_txd,
      .rs485_de,
      .hsp,
      .mod,
      .adr,
      .rs   ('1),
      .cs_n (1'b1),
      .oe_n (1'b1),
      .we_n (1'b1),
      .d_i  ('1),
      .d_o  (),
      .d_oe (),
      .wrq_n(),
      .irq_n(),
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
      .hold (),
      .led_link,
      .led_moving,
      .led_switch
  );

  assign led        = leds;

  // A low level would put the ESP32 into its boot loader at its next reset.
  assign wifi_gpio0 = 1'b1;

endmodule

`default_nettype wire
