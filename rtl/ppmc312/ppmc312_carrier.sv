// SPDX-License-Identifier: Apache-2.0
// ppmc312_carrier: PPMC-312 board without clock generator and pads. Contains ppmc312 and one host
//         interface: the UART bridge, the pins of the parallel bus, or the serial line.
// Rules:  HOST = "UART": docs/uart_bridge.md. Strap outputs 0, 1, 2 of the bridge are ANDed with run,
//         evt0_n, evt1_n.
//         HOST = "BUS": the pins of the parallel bus.
//         HOST = "SERIAL": the serial station. It receives frames from uart_rxd and rs485_rxd (only one of
//         these lines may have a master) and sends replies to both lines. Wiring: docs/boards.md.
// Timing: same as ppmc312. With RECORD != 0, inputs other than those of the host act 2 cycles later. No input
//         needs an external synchroniser.
`default_nettype none

module ppmc312_carrier #(
    parameter int unsigned CLK_HZ = 24_000_000,  // clock frequency in Hz, 8e6 .. 200e6
    parameter int unsigned XTAL_HZ = 16_000_000,
    parameter TIMING = "FAST",
    parameter SUM_MODE = "BINARY",  // checksum of the serial line; or "CHARS"
    parameter int unsigned SND_LEAD = 1,  // bit times from rs485_de to the start bit, 1 .. 16
    parameter int unsigned SND_WAIT = 0,  // rs485_de rises SND_WAIT + 0.5 bits after a stop bit
    parameter HOST = "UART",  // or "BUS", "SERIAL"
    parameter int unsigned BAUD = 115_200,  // baud rate of the bridge after reset
    parameter int unsigned RECORD = 0  // 4 .. 16: 2**RECORD records of the pins; 0: no recorder
) (
    input  wire logic       clk,
    input  wire logic       rst_n,
    // UART host, or a master of the serial line
    input  wire logic       uart_rxd,    // from the PC
    output logic            uart_txd,    // to the PC
    // serial line and its straps; idle unless HOST = "SERIAL"
    input  wire logic       rs485_rxd,
    output logic            rs485_txd,
    output logic            rs485_de,
    input  wire logic       hsp,
    input  wire logic [2:0] mod,
    input  wire logic [3:0] adr,
    // bus host; d_oe = 0 unless HOST = "BUS", because reads then remain inside the FPGA
    input  wire logic [2:0] rs,
    input  wire logic       cs_n,
    input  wire logic       oe_n,
    input  wire logic       we_n,
    input  wire logic [7:0] d_i,
    output logic      [7:0] d_o,
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
    output logic            hold,        // high: standstill for 100 ms, or no pulse since the reset
    // LEDs, high: on
    output logic            led_link,    // script running or answer pending; SERIAL: rs485_de
    output logic            led_moving,
    output logic            led_switch   // a limit or the alarm is active
);

  logic part_rst_n, part_cs_n, part_oe_n, part_we_n, moved_q, unused;
  logic [2:0] part_rs;
  logic [7:0] part_d, straps;
  logic rxd, part_oe, out_oe;

  // Input pins as ppmc312 receives them.
  logic in_fl_n, in_bl_n, in_fhl_n, in_bhl_n, in_org_n, in_index_n, in_alm_n, in_end_n, in_epin, in_epdir;
  logic in_run, in_evt0_n, in_evt1_n, in_extck, part_run, part_evt0_n, part_evt1_n;
  logic [7:0] in_auxi;

  ppmc_board_inputs #(
      .Width(22),
      .Sync (RECORD != 0)
  ) u_inputs (
      .clk_i(clk),
      .rst_ni(rst_n),
      .d_i({
        {auxi, extck, evt1_n, evt0_n, run, epdir, epin},
        {end_n, alm_n, index_n, org_n, bhl_n, fhl_n, bl_n, fl_n}
      }),
      .q_o({
        {in_auxi, in_extck, in_evt1_n, in_evt0_n, in_run, in_epdir, in_epin},
        {in_end_n, in_alm_n, in_index_n, in_org_n, in_bhl_n, in_fhl_n, in_bl_n, in_fl_n}
      })
  );

  ppmc312 #(
      .CLK_HZ  (CLK_HZ),
      .XTAL_HZ (XTAL_HZ),
      .TIMING  (TIMING),
      .SUM_MODE(SUM_MODE),
      .SND_LEAD(SND_LEAD),
      .SND_WAIT(SND_WAIT)
  ) u_part (
      .clk,
      .rst_n  (part_rst_n),
      .mode   (128'(HOST) != "SERIAL"),
      .d_i    (part_d),
      .d_o,
      .d_oe   (part_oe),
      .rs     (part_rs),
      .cs_n   (part_cs_n),
      .we_n   (part_we_n),
      .oe_n   (part_oe_n),
      .wrq_n,
      .irq_n,
      .rxd,
      .txd    (rs485_txd),
      .snd    (rs485_de),
      .hsp,
      .mod,
      .adr,
      .evt0_n (part_evt0_n),
      .evt1_n (part_evt1_n),
      .auxi   (in_auxi),
      .auxo_n,
      .exon_n,
      .cclr_n,
      .aclr_n,
      .zclmp_n,
      .cd_n,
      .alm_n  (in_alm_n),
      .end_n  (in_end_n),
      .epin   (in_epin),
      .epdir  (in_epdir),
      .index_n(in_index_n),
      .org_n  (in_org_n),
      .fl_n   (in_fl_n),
      .bl_n   (in_bl_n),
      .fhl_n  (in_fhl_n),
      .bhl_n  (in_bhl_n),
      .pout,
      .dir,
      .extck  (in_extck),
      .run    (part_run),
      .intlk_n,
      .out_oe
  );

  // cd_n is asserted 100 ms after the last pulse, but it is not asserted before the first pulse. Therefore
  // hold is asserted while moved_q = 0, which is until the first pulse.
  always_ff @(posedge clk or negedge part_rst_n) begin
    if (!part_rst_n) moved_q <= 1'b0;
    else if (pout) moved_q <= 1'b1;
  end

  assign part_run    = in_run && straps[0];
  assign part_evt0_n = in_evt0_n && straps[1];
  assign part_evt1_n = in_evt1_n && straps[2];

  assign hold        = !moved_q || !cd_n;
  assign d_oe        = 128'(HOST) == "BUS" && part_oe;
  assign led_moving  = !hold;
  assign led_switch  = !(fl_n && bl_n && fhl_n && bhl_n && alm_n);

  if (128'(HOST) == "SERIAL") begin : g_serial
    // Both lines idle high.
    assign rxd = uart_rxd && rs485_rxd;
    assign uart_txd = rs485_txd;
    assign led_link = rs485_de;

    assign part_rst_n = rst_n;
    assign {part_cs_n, part_oe_n, part_we_n} = '1;
    assign {part_rs, part_d, straps} = '1;

    logic unused_bus;
    assign unused_bus = ^{rs, cs_n, oe_n, we_n, d_i};
  end else begin : g_host
    // All recorded levels; part_rst_n is bit 0.
    localparam int unsigned Watch = 63;
    logic [Watch-1:0] watch;
    assign watch = {
      {out_oe, intlk_n, dir, pout, cd_n, zclmp_n, aclr_n, cclr_n, exon_n, auxo_n, irq_n, wrq_n, part_oe, d_o},
      {in_auxi, in_extck, part_evt1_n, part_evt0_n, part_run, in_epdir, in_epin, in_end_n, in_alm_n},
      {in_index_n, in_org_n, in_bhl_n, in_fhl_n, in_bl_n, in_fl_n},
      {part_d, part_we_n, part_oe_n, part_cs_n, part_rs, part_rst_n}
    };

    assign rxd = 1'b1;

    logic unused_line;
    assign unused_line = rs485_rxd;

    ppmc_board_host #(
        .ClkHz    (CLK_HZ),
        .XtalHz   (XTAL_HZ),
        .Datasheet(128'(TIMING) == "DATASHEET"),
        .Host     (HOST),
        .Baud     (BAUD),
        .Part     (312),
        .AddrBits (3),
        .Watch    (Watch),
        .Record   (RECORD)
    ) u_host (
        .clk_i      (clk),
        .rst_ni     (rst_n),
        .rxd_i      (uart_rxd),
        .txd_o      (uart_txd),
        .cs_ni      (cs_n),
        .rd_ni      (oe_n),
        .wr_ni      (we_n),
        .a_i        (rs),
        .d_i,
        .part_rst_no(part_rst_n),
        .part_cs_no (part_cs_n),
        .part_rd_no (part_oe_n),
        .part_wr_no (part_we_n),
        .part_a_o   (part_rs),
        .part_d_o   (part_d),
        .part_d_i   (d_o),
        .int_ni     (irq_n),
        .straps_o   (straps),
        .switches_ni({alm_n, org_n, bhl_n, fhl_n, bl_n, fl_n}),
        .hold_i     (hold),
        .pout_ni    (!pout),
        .dir_i      (dir),
        .watch_i    (watch),
        .link_o     (led_link)
    );
  end

  assign unused = &{1'b0, straps[7:3], out_oe};

endmodule

`default_nettype wire
