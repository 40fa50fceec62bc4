// SPDX-License-Identifier: Apache-2.0
// j105_stmc: PC/104 board J105 STMC. Contains one stmc on an 8-bit ISA bus, the step clock of the board,
//         which is the external step clock of stmc, and the outputs to the driver on the board.
// Rules:  J105-01..08; all STMC rules apply to the controller. Manual: docs/stmc/README.md.
// Timing: same as stmc. irq follows int_n by one cycle. drv has no delay from s.
`default_nettype none

module j105_stmc #(
    parameter int unsigned CLK_HZ      = 16_000_000,  // clock frequency in Hz, 8e6 .. 200e6
    parameter int unsigned XTAL_HZ     = 16_000_000,  // crystal of the old device in Hz, 1e6 .. 20e6
    parameter              TIMING      = "FAST",      // or "DATASHEET": processing times of the PPMC-104
    parameter              READ_MAP    = "FAMILY",    // read codes 80 .. 83; "SHEET": 80, 82, 83, 84
    parameter int unsigned HOLD_XT     = 544_000,     // hold delay in crystal periods
    parameter int unsigned CHOP_ON_XT  = 1_040,       // on time of the chopper in crystal periods
    parameter int unsigned CHOP_OFF_XT = 1_740,       // off time of the chopper in crystal periods
    parameter int unsigned BASE_ADDR   = 'h3B0,       // address of the data register, even
    parameter int unsigned EXT_HZ      = 48_675       // external step clock in Hz, 1 .. CLK_HZ / 4
) (
    input  wire logic       clk,
    input  wire logic       rst_n,
    // ISA
    input  wire logic [9:0] sa,
    input  wire logic       aen,
    input  wire logic       ior_n,
    input  wire logic       iow_n,
    input  wire logic [7:0] sd_i,
    output logic      [7:0] sd_o,
    output logic            sd_oe,
    output logic            irq,    // high: a motion has ended
    // switches, active low
    input  wire logic       l1_n,
    input  wire logic       l2_n,
    input  wire logic       l3_n,
    input  wire logic       l4_n,
    input  wire logic       cnp_n,
    input  wire logic       mon,
    // motor
    output logic      [5:1] s,
    output logic      [4:1] drv,    // high: the winding is energised
    output logic            hold
);

  if (EXT_HZ < 1 || EXT_HZ > CLK_HZ / 4) begin : g_check_ext
    $fatal(1, "j105_stmc: EXT_HZ must be 1 .. CLK_HZ / 4");
  end

  logic rst_core_n, ext_clk, cs_n, a0, d_oe, int_n;
  logic [7:0] d;

  ppmc_reset u_reset (
      .clk_i (clk),
      .rst_ni(rst_n),
      .rst_no(rst_core_n)
  );

  // ppmc_square counts each half period of the wave as one cycle of a virtual crystal.
  ppmc_square #(
      .ClkHz   (CLK_HZ),
      .XtalHz  (2 * EXT_HZ),
      .HalfXtal(1)
  ) u_ext (
      .clk_i (clk),
      .rst_ni(rst_core_n),
      .wave_o(ext_clk)
  );

  ppmc_isa #(
      .Parts(1),
      .Base (BASE_ADDR)
  ) u_isa (
      .clk_i  (clk),
      .rst_ni (rst_core_n),
      .sa_i   (sa),
      .aen_i  (aen),
      .ior_ni (ior_n),
      .iow_ni (iow_n),
      .sd_o,
      .sd_oe_o(sd_oe),
      .irq_o  (irq),
      .cs_no  (cs_n),
      .a0_o   (a0),
      .d_i    (d),
      .d_oe_i (d_oe),
      .int_ni (int_n)
  );

  stmc #(
      .CLK_HZ     (CLK_HZ),
      .XTAL_HZ    (XTAL_HZ),
      .TIMING     (TIMING),
      .READ_MAP   (READ_MAP),
      .PHASE_IDLE (1'b0),
      .HOLD_XT    (HOLD_XT),
      .CHOP_ON_XT (CHOP_ON_XT),
      .CHOP_OFF_XT(CHOP_OFF_XT)
  ) u_part (
      .clk,
      .rst_n,
      .ext_clk,
      .cs_n,
      .a0,
      .rd_n(ior_n),
      .wr_n(iow_n),
      .d_i (sd_i),
      .d_o (d),
      .d_oe,
      .int_n,
      .l1_n,
      .l2_n,
      .l3_n,
      .l4_n,
      .cnp_n,
      .mon,
      .s,
      .hold
  );

  assign drv = s[4:1];

endmodule

`default_nettype wire
