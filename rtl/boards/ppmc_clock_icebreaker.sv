// SPDX-License-Identifier: Apache-2.0
// ppmc_clock_icebreaker: 24 MHz from the 12 MHz oscillator of an iCEBreaker, by the PLL at its clock pad.
// Rules:  settings of the PLL from icepll for 12 MHz in, 24 MHz out (VCO 768 MHz).
// Timing: lock_o is asynchronous.
`default_nettype none

module ppmc_clock_icebreaker (
    input  wire logic clk_12m_i,  // the package pin itself
    output logic      clk_o,      // 24 MHz, on a global net
    output logic      lock_o
);

  logic unused_core, unused_sdo;

  SB_PLL40_PAD #(
      .FEEDBACK_PATH("SIMPLE"),
      .DIVR         (4'd0),
      .DIVF         (7'd63),
      .DIVQ         (3'd5),
      .FILTER_RANGE (3'd1)
  ) u_pll (
      .PACKAGEPIN     (clk_12m_i),
      .PLLOUTCORE     (unused_core),
      .PLLOUTGLOBAL   (clk_o),
      .EXTFEEDBACK    (1'b0),
      .DYNAMICDELAY   (8'd0),
      .LOCK           (lock_o),
      .BYPASS         (1'b0),
      .RESETB         (1'b1),
      .LATCHINPUTVALUE(1'b0),
      .SDO            (unused_sdo),
      .SDI            (1'b0),
      .SCLK           (1'b0)
  );

endmodule

`default_nettype wire
