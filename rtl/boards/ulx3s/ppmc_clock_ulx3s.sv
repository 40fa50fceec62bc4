// SPDX-License-Identifier: Apache-2.0
// ppmc_clock_ulx3s: PLL (ECP5) of a ULX3S. Generates 100, 75 or 50 MHz from the 25 MHz oscillator.
// Rules:  divisors from ecppll for an input of 25 MHz; VCO 600 MHz, feedback from CLKOP.
// Timing: lock_o is asynchronous.
`default_nettype none

module ppmc_clock_ulx3s #(
    parameter int unsigned Divisor = 6  // divisor of 600 MHz, 6, 8 or 12
) (
    input  wire logic clk_25m_i,
    output logic      clk_o,      // 600 MHz / Divisor
    output logic      lock_o
);

  if (Divisor != 6 && Divisor != 8 && Divisor != 12) begin : g_check
    $fatal(1, "ppmc_clock_ulx3s: Divisor must be 6, 8 or 12");
  end

  // The attributes set the currents and the filter of the PLL loop. The tool of the vendor would calculate
  // these attributes.
  (* FREQUENCY_PIN_CLKI = "25", ICP_CURRENT = "12", LPF_RESISTOR = "8",
     MFG_ENABLE_FILTEROPAMP = "1", MFG_GMCREF_SEL = "2" *)
  EHXPLLL #(
      .CLKI_DIV       (1),
      .CLKFB_DIV      (24 / Divisor),
      .CLKOP_DIV      (Divisor),
      .CLKOP_CPHASE   (Divisor / 2 - 1),
      .CLKOP_FPHASE   (0),
      .CLKOP_ENABLE   ("ENABLED"),
      .FEEDBK_PATH    ("CLKOP"),
      .OUTDIVIDER_MUXA("DIVA"),
      .OUTDIVIDER_MUXB("DIVB"),
      .OUTDIVIDER_MUXC("DIVC"),
      .OUTDIVIDER_MUXD("DIVD"),
      .PLLRST_ENA     ("DISABLED"),
      .INTFB_WAKE     ("DISABLED"),
      .STDBY_ENABLE   ("DISABLED"),
      .DPHASE_SOURCE  ("DISABLED")
  ) u_pll (
      .CLKI        (clk_25m_i),
      .CLKFB       (clk_o),
      .PHASESEL1   (1'b0),
      .PHASESEL0   (1'b0),
      .PHASEDIR    (1'b1),
      .PHASESTEP   (1'b1),
      .PHASELOADREG(1'b1),
      .STDBY       (1'b0),
      .PLLWAKESYNC (1'b0),
      .RST         (1'b0),
      .ENCLKOP     (1'b0),
      .ENCLKOS     (1'b0),
      .ENCLKOS2    (1'b0),
      .ENCLKOS3    (1'b0),
      .CLKOP       (clk_o),
      .CLKOS       (),
      .CLKOS2      (),
      .CLKOS3      (),
      .LOCK        (lock_o),
      .INTLOCK     (),
      .REFCLK      (),
      .CLKINTFB    ()
  );

endmodule

`default_nettype wire
