// SPDX-License-Identifier: Apache-2.0
// ppmc_bank, stub for the proof of the block that instantiates it: its outputs are not driven, so the proof
// holds for any pins and any read data.
`default_nettype none

module ppmc_bank
  import ppmc_bank_pkg::*;
  import ppmc_motion_pkg::*;
#(
    parameter int unsigned AXES       = 32,           // 4, 8, 16, 32 or 64
    parameter int unsigned CLK_HZ     = 100_000_000,  // clock frequency in Hz, 8e6 .. 200e6
    parameter int unsigned XTAL_HZ    = 16_000_000,   // crystal of the old chip in Hz, 1e6 .. 16e6
    parameter bit          PHASE_IDLE = 1'b1          // level of s before the first initialisation
) (
    input  wire logic              clk,
    input  wire logic              rst_n,
    // host bus
    input  wire logic [       9:0] a,       // [9:4]: axis, [3:0]: register
    input  wire logic              cs_n,
    input  wire logic              rd_n,
    input  wire logic              wr_n,
    input  wire logic [       7:0] d_i,
    output logic      [       7:0] d_o,
    output logic                   d_oe,
    output logic                   int_n,   // low: at least one interrupt is pending
    // switches, active low, one bit per axis
    input  wire logic [  AXES-1:0] l1_n,    // CW limit
    input  wire logic [  AXES-1:0] l2_n,    // CCW limit
    input  wire logic [  AXES-1:0] l3_n,    // CW slow-down limit
    input  wire logic [  AXES-1:0] l4_n,    // CCW slow-down limit
    input  wire logic [  AXES-1:0] cnp_n,   // origin
    input  wire logic [  AXES-1:0] alm_n,   // alarm
    // motors, one bit per axis; s has five bits S5..S1 per axis
    output logic      [5*AXES-1:0] s,
    output logic      [  AXES-1:0] hold,
    output logic      [  AXES-1:0] pout_n,
    output logic      [  AXES-1:0] dir      // 0: CW, 1: CCW
);

endmodule

`default_nettype wire
