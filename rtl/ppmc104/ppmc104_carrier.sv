// SPDX-License-Identifier: Apache-2.0
// ppmc104_carrier: PPMC-104 board without clock generator and pads. Contains ppmc104 and one host
//         interface: the UART bridge, the character host, or the bus pins of the old chip.
// Rules:  HOST = "UART": docs/uart_bridge.md, or with BRIDGE = 0: docs/char_host.md. HOST = "BUS":
//         P104-PORT-01. Wiring: docs/boards.md.
// Timing: same as ppmc104. With RECORD != 0, inputs other than the bus act 2 cycles later. No input needs an
//         external synchroniser.
`default_nettype none

module ppmc104_carrier #(
    parameter int unsigned CLK_HZ     = 24_000_000,  // clock frequency in Hz, 8e6 .. 200e6
    parameter int unsigned XTAL_HZ    = 16_000_000,
    parameter              TIMING     = "FAST",
    parameter bit          PHASE_IDLE = 1'b1,        // level of s until the first initialisation
    parameter              HOST       = "UART",      // or "BUS"
    parameter bit          BRIDGE     = 1'b1,        // 0: character host for small FPGAs, not the UART bridge
    parameter int unsigned BAUD       = 115_200,     // baud rate of the UART host after reset
    parameter int unsigned RECORD     = 0            // 4 .. 16: 2**RECORD records of the pins; 0: no recorder
) (
    input  wire logic       clk,
    input  wire logic       rst_n,
    // UART host
    input  wire logic       uart_rxd,    // from the PC
    output logic            uart_txd,    // to the PC
    // bus host; with HOST = "UART", d_oe = 0, because reads then remain inside the FPGA
    input  wire logic       a0,
    input  wire logic       cs_n,
    input  wire logic       rd_n,
    input  wire logic       wr_n,
    input  wire logic [7:0] d_i,
    output logic      [7:0] d_o,
    output logic            d_oe,        // direction of a bus transceiver, 1: FPGA to host
    output logic            int_n,
    // clock selection; with HOST = "UART", strap outputs of the host can also set csel and vsel to 0
    input  wire logic       csel,
    input  wire logic       vsel,
    input  wire logic       clock,
    // switches, active low
    input  wire logic       l1_n,
    input  wire logic       l2_n,
    input  wire logic       l3_n,
    input  wire logic       l4_n,
    input  wire logic       cnp_n,
    input  wire logic       alm_n,
    // auxiliary
    input  wire logic [3:0] auxi,
    output logic      [3:0] auxo,
    output logic            aux_n,
    // motor
    output logic      [5:1] s,
    output logic            hold,
    output logic            pout_n,
    output logic            dir,
    // LEDs, high: on
    output logic            led_link,    // a script is running or an answer is pending
    output logic            led_moving,
    output logic            led_switch   // a limit or the alarm is active
);

  if (!BRIDGE && RECORD != 0) begin : g_check_record
    $fatal(1, "ppmc104_carrier: RECORD must be 0 with BRIDGE = 0");
  end

  logic part_rst_n, part_cs_n, part_rd_n, part_wr_n, part_a0, part_csel, part_vsel;
  logic [7:0] part_d, straps;
  logic part_oe, unused_straps;

  // in_…: input pins as ppmc104 receives them. watch: all recorded levels; part_rst_n is bit 0.
  localparam int unsigned Watch = 49;
  logic in_csel, in_vsel, in_clock, in_l1_n, in_l2_n, in_l3_n, in_l4_n, in_cnp_n, in_alm_n;
  logic [3:0] in_auxi;
  logic [Watch-1:0] watch;

  ppmc_board_inputs #(
      .Width(13),
      .Sync (RECORD != 0)
  ) u_inputs (
      .clk_i (clk),
      .rst_ni(rst_n),
      .d_i   ({auxi, alm_n, cnp_n, l4_n, l3_n, l2_n, l1_n, clock, vsel, csel}),
      .q_o   ({in_auxi, in_alm_n, in_cnp_n, in_l4_n, in_l3_n, in_l2_n, in_l1_n, in_clock, in_vsel, in_csel})
  );

  assign watch = {
    {dir, pout_n, hold, s, aux_n, auxo, int_n, part_oe, d_o},
    {in_auxi, in_alm_n, in_cnp_n, in_l4_n, in_l3_n, in_l2_n, in_l1_n, in_clock, part_vsel, part_csel},
    {part_d, part_wr_n, part_rd_n, part_cs_n, part_a0, part_rst_n}
  };

  ppmc104 #(
      .CLK_HZ    (CLK_HZ),
      .XTAL_HZ   (XTAL_HZ),
      .TIMING    (TIMING),
      .PHASE_IDLE(PHASE_IDLE)
  ) u_part (
      .clk,
      .rst_n(part_rst_n),
      .a0   (part_a0),
      .cs_n (part_cs_n),
      .rd_n (part_rd_n),
      .wr_n (part_wr_n),
      .d_i  (part_d),
      .d_o,
      .d_oe  (part_oe),
      .int_n,
      .csel (part_csel),
      .vsel (part_vsel),
      .clock(in_clock),
      .l1_n (in_l1_n),
      .l2_n (in_l2_n),
      .l3_n (in_l3_n),
      .l4_n (in_l4_n),
      .cnp_n(in_cnp_n),
      .alm_n(in_alm_n),
      .auxi (in_auxi),
      .auxo,
      .aux_n,
      .s,
      .hold,
      .pout_n,
      .dir
  );

  if (BRIDGE || 128'(HOST) == "BUS") begin : g_bridge
    ppmc_board_host #(
        .ClkHz    (CLK_HZ),
        .XtalHz   (XTAL_HZ),
        .Datasheet(128'(TIMING) == "DATASHEET"),
        .Host     (HOST),
        .Baud     (BAUD),
        .Part     (104),
        .Watch    (Watch),
        .Record   (RECORD)
    ) u_host (
        .clk_i      (clk),
        .rst_ni     (rst_n),
        .rxd_i      (uart_rxd),
        .txd_o      (uart_txd),
        .cs_ni      (cs_n),
        .rd_ni      (rd_n),
        .wr_ni      (wr_n),
        .a_i        (a0),
        .d_i,
        .part_rst_no(part_rst_n),
        .part_cs_no (part_cs_n),
        .part_rd_no (part_rd_n),
        .part_wr_no (part_wr_n),
        .part_a_o   (part_a0),
        .part_d_o   (part_d),
        .part_d_i   (d_o),
        .int_ni     (int_n),
        .straps_o   (straps),
        .switches_ni({alm_n, cnp_n, l4_n, l3_n, l2_n, l1_n}),
        .hold_i     (hold),
        .pout_ni    (pout_n),
        .dir_i      (dir),
        .watch_i    (watch),
        .link_o     (led_link)
    );
  end else begin : g_char
    logic [3:0] a;
    logic rst_host_n, unused;

    ppmc_char_host #(
        .ClkHz    (CLK_HZ),
        .XtalHz   (XTAL_HZ),
        .Baud     (BAUD),
        .Part     (104),
        .Datasheet(128'(TIMING) == "DATASHEET")
    ) u_host (
        .clk_i      (clk),
        .rst_ni     (rst_host_n),
        .rxd_i      (uart_rxd),
        .txd_o      (uart_txd),
        .cs_no      (part_cs_n),
        .rd_no      (part_rd_n),
        .wr_no      (part_wr_n),
        .a_o        (a),
        .d_o        (part_d),
        .d_i        (d_o),
        .part_rst_no(part_rst_n),
        .straps_o   (straps[6:0]),
        .pins_i     ({alm_n, cnp_n, l4_n, l3_n, l2_n, l1_n, hold, int_n}),
        .active_o   (led_link)
    );

    ppmc_reset u_reset (
        .clk_i (clk),
        .rst_ni(rst_n),
        .rst_no(rst_host_n)
    );

    assign part_a0   = a[0];
    assign straps[7] = 1'b1;
    assign unused    = ^{a, watch, a0, cs_n, rd_n, wr_n, d_i};
  end

  assign part_csel     = in_csel && straps[0];
  assign part_vsel     = in_vsel && straps[1];
  assign d_oe          = 128'(HOST) == "BUS" && part_oe;
  assign led_moving    = !hold;
  assign led_switch    = !(l1_n && l2_n && l3_n && l4_n && alm_n);
  assign unused_straps = ^straps[7:2];

endmodule

`default_nettype wire
