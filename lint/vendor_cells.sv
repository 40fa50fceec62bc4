// SPDX-License-Identifier: Apache-2.0
// Ports and parameters of the vendors' cells that rtl/boards instantiates, for lint and for elaboration. In
// synthesis, the library of the FPGA family replaces these modules. Only the ports and parameters that the
// boards use are declared, with the vendors' names.
/* verilator lint_off DECLFILENAME */
/* verilator lint_off UNUSEDSIGNAL */
/* verilator lint_off UNUSEDPARAM */
/* verilator lint_off UNDRIVEN */
`default_nettype none

// iCE40: PLL at a clock pad
(* blackbox *)
module SB_PLL40_PAD #(
    parameter FEEDBACK_PATH = "SIMPLE",
    parameter logic [3:0] DIVR = 0,
    parameter logic [6:0] DIVF = 0,
    parameter logic [2:0] DIVQ = 0,
    parameter logic [2:0] FILTER_RANGE = 0
) (
    input  wire        PACKAGEPIN,
    output wire        PLLOUTCORE,
    output wire        PLLOUTGLOBAL,
    input  wire        EXTFEEDBACK,
    input  wire  [7:0] DYNAMICDELAY,
    output wire        LOCK,
    input  wire        BYPASS,
    input  wire        RESETB,
    input  wire        LATCHINPUTVALUE,
    output wire        SDO,
    input  wire        SDI,
    input  wire        SCLK
);
endmodule

// ECP5: PLL
(* blackbox *)
module EHXPLLL #(
    parameter integer CLKI_DIV = 1,
    parameter integer CLKFB_DIV = 1,
    parameter integer CLKOP_DIV = 8,
    parameter integer CLKOP_CPHASE = 0,
    parameter integer CLKOP_FPHASE = 0,
    parameter CLKOP_ENABLE = "ENABLED",
    parameter FEEDBK_PATH = "CLKOP",
    parameter OUTDIVIDER_MUXA = "DIVA",
    parameter OUTDIVIDER_MUXB = "DIVB",
    parameter OUTDIVIDER_MUXC = "DIVC",
    parameter OUTDIVIDER_MUXD = "DIVD",
    parameter PLLRST_ENA = "DISABLED",
    parameter INTFB_WAKE = "DISABLED",
    parameter STDBY_ENABLE = "DISABLED",
    parameter DPHASE_SOURCE = "DISABLED"
) (
    input  wire CLKI,
    input  wire CLKFB,
    input  wire PHASESEL1,
    input  wire PHASESEL0,
    input  wire PHASEDIR,
    input  wire PHASESTEP,
    input  wire PHASELOADREG,
    input  wire STDBY,
    input  wire PLLWAKESYNC,
    input  wire RST,
    input  wire ENCLKOP,
    input  wire ENCLKOS,
    input  wire ENCLKOS2,
    input  wire ENCLKOS3,
    output wire CLKOP,
    output wire CLKOS,
    output wire CLKOS2,
    output wire CLKOS3,
    output wire LOCK,
    output wire INTLOCK,
    output wire REFCLK,
    output wire CLKINTFB
);
endmodule

// Gowin: PLL
(* blackbox *)
module rPLL #(
    parameter DEVICE = "GW1N-1",
    parameter FCLKIN = "100",
    parameter integer IDIV_SEL = 0,
    parameter integer FBDIV_SEL = 0,
    parameter integer ODIV_SEL = 8
) (
    input  wire        CLKIN,
    input  wire        CLKFB,
    input  wire        RESET,
    input  wire        RESET_P,
    input  wire  [5:0] FBDSEL,
    input  wire  [5:0] IDSEL,
    input  wire  [5:0] ODSEL,
    input  wire  [3:0] DUTYDA,
    input  wire  [3:0] PSDA,
    input  wire  [3:0] FDLY,
    output wire        CLKOUT,
    output wire        LOCK,
    output wire        CLKOUTP,
    output wire        CLKOUTD,
    output wire        CLKOUTD3
);
endmodule

`default_nettype wire
