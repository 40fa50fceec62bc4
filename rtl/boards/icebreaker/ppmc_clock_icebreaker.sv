// SPDX-License-Identifier: Apache-2.0
// ppmc_clock_icebreaker: PLL at the clock pad of an iCEBreaker. Generates 16.875 .. 33 MHz (default: 24 MHz)
//         from the 12 MHz oscillator.
// Rules:  PLL settings from icepll for an input of 12 MHz; the VCO has 32 times the frequency of clk_o,
//         533 .. 1066 MHz.
// Timing: lock_o is asynchronous.
`default_nettype none

module ppmc_clock_icebreaker #(
    parameter bit [6:0] Divf = 7'd63  // clk_o = 12 MHz * (Divf + 1) / 32; Divf = 44 .. 87
) (
    input  wire logic clk_12m_i,  // oscillator, at its package pin
    output logic      clk_o,      // clock on a global net
    output logic      lock_o
);

  if (Divf < 44 || Divf > 87) begin : g_check
    $fatal(1, "ppmc_clock_icebreaker: Divf must be 44 .. 87");
  end

  logic unused_core, unused_sdo;

  SB_PLL40_PAD #(
      .FEEDBACK_PATH("SIMPLE"),
      .DIVR         (4'd0),
      .DIVF         (Divf),
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
