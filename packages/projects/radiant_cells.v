// SPDX-License-Identifier: Apache-2.0
// Cells of the iCE40 that the board tops use, made from the primitives that Radiant has for the same FPGA.
// How:     PLL_B has text parameters, so only the settings of the iCEBreaker (12 MHz to 24 MHz) are possible.
//          Other settings instantiate a module that does not exist, which ends the synthesis.
// Not run by this project's tests, which have no vendor tools; Verilator and yosys read the file.
`default_nettype none

module SB_PLL40_PAD #(
    parameter FEEDBACK_PATH = "SIMPLE",
    parameter [3:0] DIVR = 0,
    parameter [6:0] DIVF = 0,
    parameter [2:0] DIVQ = 0,
    parameter [2:0] FILTER_RANGE = 0
) (
    input  wire       PACKAGEPIN,
    output wire       PLLOUTCORE,
    output wire       PLLOUTGLOBAL,
    input  wire       EXTFEEDBACK,
    input  wire [7:0] DYNAMICDELAY,
    output wire       LOCK,
    input  wire       BYPASS,
    input  wire       RESETB,
    input  wire       LATCHINPUTVALUE,
    output wire       SDO,
    input  wire       SDI,
    input  wire       SCLK
);

  wire feedback, unused;

  assign unused = &{EXTFEEDBACK, DYNAMICDELAY};

  generate
    if (DIVR != 0 || DIVF != 63 || DIVQ != 5 || FILTER_RANGE != 1) begin : g_other
      radiant_cells_has_only_24_mhz u_error ();
    end
  endgenerate

  PLL_B #(
      .FEEDBACK_PATH                 (FEEDBACK_PATH),
      .DIVR                          ("0"),
      .DIVF                          ("63"),
      .DIVQ                          ("5"),
      .FILTER_RANGE                  ("1"),
      .DELAY_ADJUSTMENT_MODE_FEEDBACK("FIXED"),
      .FDA_FEEDBACK                  ("0"),
      .DELAY_ADJUSTMENT_MODE_RELATIVE("FIXED"),
      .FDA_RELATIVE                  ("0"),
      .SHIFTREG_DIV_MODE             ("0"),
      .PLLOUT_SELECT_PORTA           ("GENCLK"),
      .PLLOUT_SELECT_PORTB           ("GENCLK"),
      .EXTERNAL_DIVIDE_FACTOR        ("NONE"),
      .ENABLE_ICEGATE_PORTA          ("0"),
      .ENABLE_ICEGATE_PORTB          ("0"),
      .FREQUENCY_PIN_REFERENCECLK    ("12.000000")
  ) u_pll (
      .REFERENCECLK (PACKAGEPIN),
      .FEEDBACK     (feedback),
      .INTFBOUT     (feedback),
      .DYNAMICDELAY7(1'b0),
      .DYNAMICDELAY6(1'b0),
      .DYNAMICDELAY5(1'b0),
      .DYNAMICDELAY4(1'b0),
      .DYNAMICDELAY3(1'b0),
      .DYNAMICDELAY2(1'b0),
      .DYNAMICDELAY1(1'b0),
      .DYNAMICDELAY0(1'b0),
      .BYPASS       (BYPASS),
      .RESET_N      (RESETB),
      .LATCH        (LATCHINPUTVALUE),
      .SCLK         (SCLK),
      .SDI          (SDI),
      .SDO          (SDO),
      .OUTCORE      (PLLOUTCORE),
      .OUTGLOBAL    (PLLOUTGLOBAL),
      .OUTCOREB     (),
      .OUTGLOBALB   (),
      .LOCK         (LOCK)
  );

endmodule

`default_nettype wire
