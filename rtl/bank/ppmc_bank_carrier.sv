// SPDX-License-Identifier: Apache-2.0
// ppmc_bank_carrier: all logic of a board with a bank except clock generator and pads. Contains the bank
//         and its host interface. The host interface is either the UART bridge, which accesses the registers
//         of one selected axis, or an SPI slave, which accesses the complete window.
// Rules:  HOST = "UART": docs/uart_bridge.md, docs/bank/carrier.md; HOST = "SPI": docs/bank/spi.md. Axis a
//         (0 .. AXES - 1) uses bit a of each port of switches and motors. In s, it uses bits
//         5 * a (S1) to 5 * a + 4 (S5).
// Timing: same as ppmc_bank. The inputs need no external synchroniser.
`default_nettype none

module ppmc_bank_carrier #(
    parameter int unsigned CLK_HZ = 100_000_000,  // clock frequency in Hz, see BANK-GEN-02
    parameter int unsigned XTAL_HZ = 16_000_000,
    parameter int unsigned AXES = 32,  // 4, 8, 16, 32 or 64
    parameter bit PHASE_IDLE = 1'b1,  // level of s before the first initialisation
    parameter HOST = "UART",  // or "SPI"
    parameter int unsigned BAUD = 115_200,  // baud rate of the bridge after reset
    parameter int unsigned RECORD = 0  // 4 .. 16: 2**RECORD records of the pins; 0: no recorder
) (
    input  wire logic              clk,
    input  wire logic              rst_n,
    // UART host
    input  wire logic              uart_rxd,    // from the PC
    output logic                   uart_txd,    // to the PC
    // SPI host
    input  wire logic              spi_cs_n,
    input  wire logic              sck,
    input  wire logic              mosi,
    output logic                   miso_o,
    output logic                   miso_oe,
    output logic                   int_n,       // low: at least one axis has a pending interrupt
    // switches, active low
    input  wire logic [  AXES-1:0] l1_n,
    input  wire logic [  AXES-1:0] l2_n,
    input  wire logic [  AXES-1:0] l3_n,
    input  wire logic [  AXES-1:0] l4_n,
    input  wire logic [  AXES-1:0] cnp_n,
    input  wire logic [  AXES-1:0] alm_n,
    // motors
    output logic      [5*AXES-1:0] s,
    output logic      [  AXES-1:0] hold,
    output logic      [  AXES-1:0] pout_n,
    output logic      [  AXES-1:0] dir,
    // LEDs, 1: on
    output logic                   led_link,    // a script or a frame is running, or a response is being sent
    output logic                   led_moving,  // at least one motor is moving
    output logic                   led_switch   // a limit or an alarm is active
);

  if (128'(HOST) != "UART" && 128'(HOST) != "SPI") begin : g_check
    $fatal(1, "ppmc_bank_carrier: HOST must be UART or SPI");
  end

  logic part_rst_n, part_cs_n, part_rd_n, part_wr_n, part_oe;
  logic [9:0] part_a;
  logic [7:0] to_part, from_part;
  logic [AXES-1:0] in_l1_n, in_l2_n, in_l3_n, in_l4_n, in_cnp_n, in_alm_n;

  ppmc_board_inputs #(
      .Width(6 * AXES),
      .Sync (RECORD != 0)
  ) u_inputs (
      .clk_i (clk),
      .rst_ni(rst_n),
      .d_i   ({alm_n, cnp_n, l4_n, l3_n, l2_n, l1_n}),
      .q_o   ({in_alm_n, in_cnp_n, in_l4_n, in_l3_n, in_l2_n, in_l1_n})
  );

  ppmc_bank #(
      .AXES      (AXES),
      .CLK_HZ    (CLK_HZ),
      .XTAL_HZ   (XTAL_HZ),
      .PHASE_IDLE(PHASE_IDLE)
  ) u_part (
      .clk,
      .rst_n(part_rst_n),
      .a    (part_a),
      .cs_n (part_cs_n),
      .rd_n (part_rd_n),
      .wr_n (part_wr_n),
      .d_i  (to_part),
      .d_o  (from_part),
      .d_oe (part_oe),
      .int_n,
      .l1_n (in_l1_n),
      .l2_n (in_l2_n),
      .l3_n (in_l3_n),
      .l4_n (in_l4_n),
      .cnp_n(in_cnp_n),
      .alm_n(in_alm_n),
      .s,
      .hold,
      .pout_n,
      .dir
  );

  if (128'(HOST) == "SPI") begin : g_spi
    ppmc_reset u_reset (
        .clk_i (clk),
        .rst_ni(rst_n),
        .rst_no(part_rst_n)
    );

    ppmc_spi #(
        .AddrBits(10)
    ) u_spi (
        .clk_i    (clk),
        .rst_ni   (part_rst_n),
        .sck_i    (sck),
        .mosi_i   (mosi),
        .cs_ni    (spi_cs_n),
        .miso_o,
        .miso_oe_o(miso_oe),
        .active_o (led_link),
        .cs_no    (part_cs_n),
        .rd_no    (part_rd_n),
        .wr_no    (part_wr_n),
        .a_o      (part_a),
        .d_o      (to_part),
        .d_i      (from_part),
        .int_ni   (int_n)
    );

    logic unused;
    assign uart_txd = 1'b1;
    assign unused   = uart_rxd ^ part_oe;
  end else begin : g_uart
    localparam int unsigned AxisBits = $clog2(AXES);
    localparam int unsigned Watch = 32 + 14 * AXES;  // number of recorded levels; bit 0 is part_rst_n

    logic host_cs_n;
    logic [3:0] host_a;
    logic [7:0] to_host, axis, straps;
    logic [AxisBits-1:0] pins_axis;  // axis whose pins the bridge operation PINS reads

    logic [Watch-1:0] watch;

    assign pins_axis = axis[AxisBits-1:0];
    assign watch = {
      {s, hold, dir, pout_n, int_n, part_oe, from_part},
      {in_alm_n, in_cnp_n, in_l4_n, in_l3_n, in_l2_n, in_l1_n},
      {to_part, part_wr_n, part_rd_n, part_cs_n, part_a, part_rst_n}
    };

    ppmc_board_host #(
        .ClkHz   (CLK_HZ),
        .XtalHz  (XTAL_HZ),
        .Baud    (BAUD),
        .Part    (32),
        .AddrBits(4),
        .Counter (1'b0),
        .Watch   (Watch),
        .Record  (RECORD)
    ) u_host (
        .clk_i(clk),
        .rst_ni(rst_n),
        .rxd_i(uart_rxd),
        .txd_o(uart_txd),
        .cs_ni(1'b1),
        .rd_ni(1'b1),
        .wr_ni(1'b1),
        .a_i('0),
        .d_i('0),
        .part_rst_no(part_rst_n),
        .part_cs_no(host_cs_n),
        .part_rd_no(part_rd_n),
        .part_wr_no(part_wr_n),
        .part_a_o(host_a),
        .part_d_o(to_part),
        .part_d_i(to_host),
        .int_ni(int_n),
        .straps_o(straps),
        .switches_ni({
          alm_n[pins_axis],
          cnp_n[pins_axis],
          l4_n[pins_axis],
          l3_n[pins_axis],
          l2_n[pins_axis],
          l1_n[pins_axis]
        }),
        .hold_i(hold[pins_axis]),
        .pout_ni(1'b1),
        .dir_i(1'b0),
        .watch_i(watch),
        .link_o(led_link)
    );

    ppmc_bank_axis_port u_axis_port (
        .clk_i   (clk),
        .rst_ni  (part_rst_n),
        .cs_ni   (host_cs_n),
        .wr_ni   (part_wr_n),
        .a_i     (host_a),
        .d_i     (to_part),
        .d_o     (to_host),
        .cs_no   (part_cs_n),
        .a_o     (part_a),
        .bank_d_i(from_part),
        .axis_o  (axis)
    );

    logic unused;
    assign miso_o  = 1'b0;
    assign miso_oe = 1'b0;
    assign unused  = ^{spi_cs_n, sck, mosi, straps, axis};
  end

  assign led_moving = !(&hold);
  assign led_switch = !(&{l1_n, l2_n, l3_n, l4_n, alm_n});

endmodule

`default_nettype wire
