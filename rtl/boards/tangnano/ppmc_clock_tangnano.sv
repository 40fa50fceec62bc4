// SPDX-License-Identifier: Apache-2.0
// ppmc_clock_tangnano: PLL of a Tang Nano. Generates 54 MHz from the 27 MHz oscillator.
// Rules:  divisors from gowin_pll for an input of 27 MHz and an output of 54 MHz. Tang Nano 9K
//         (GW1NR-9C): output divider 8, VCO 432 MHz. Tang Nano 20K (GW2A-18C): output divider 16, VCO
//         864 MHz.
// Timing: lock_o is asynchronous.
`default_nettype none

module ppmc_clock_tangnano #(
    parameter Device = "GW1NR-9C",
    parameter int    OutDiv = 8
) (
    input  wire logic clk_27m_i,
    output logic      clk_o,      // 54 MHz
    output logic      lock_o
);

  rPLL #(
      .DEVICE   (Device),
      .FCLKIN   ("27"),
      .IDIV_SEL (0),
      .FBDIV_SEL(1),
      .ODIV_SEL (OutDiv)
  ) u_pll (
      .CLKIN   (clk_27m_i),
      .CLKFB   (1'b0),
      .RESET   (1'b0),
      .RESET_P (1'b0),
      .FBDSEL  (6'd0),
      .IDSEL   (6'd0),
      .ODSEL   (6'd0),
      .DUTYDA  (4'd0),
      .PSDA    (4'd0),
      .FDLY    (4'd0),
      .CLKOUT  (clk_o),
      .LOCK    (lock_o),
      .CLKOUTP (),
      .CLKOUTD (),
      .CLKOUTD3()
  );

endmodule

`default_nettype wire
