// SPDX-License-Identifier: Apache-2.0
// ppmc104_example_bare: a bare PPMC-104 on the bus of the old chip.
//         Copy it and change it; `make lint` elaborates it as it stands. Manual: docs/integration.md.
`default_nettype none

module ppmc104_example_bare #(
    parameter int unsigned CLK_HZ  = 16_000_000,  // frequency of clk, 8e6 .. 200e6
    parameter int unsigned XTAL_HZ = 16_000_000   // all speeds of the part follow it
) (
    input  wire logic       clk,
    input  wire logic       rst_n,   // may assert at any time
    // host bus of the old chip; the pads' tri-state stays in the top level: d = d_oe ? d_o : 'z
    input  wire logic       a0,
    input  wire logic       cs_n,
    input  wire logic       rd_n,
    input  wire logic       wr_n,
    input  wire logic [7:0] d_i,
    output logic      [7:0] d_o,
    output logic            d_oe,
    output logic            int_n,
    // switches, 0 = active; asynchronous
    input  wire logic       l1_n,
    input  wire logic       l2_n,
    input  wire logic       l3_n,
    input  wire logic       l4_n,
    input  wire logic       cnp_n,
    input  wire logic       alm_n,
    // motor
    output logic      [5:1] s,
    output logic            hold,
    output logic            pout_n,
    output logic            dir
);

  logic [3:0] unused_auxo;
  logic unused_aux;

  ppmc104 #(
      .CLK_HZ    (CLK_HZ),
      .XTAL_HZ   (XTAL_HZ),
      .TIMING    ("FAST"),
      .PHASE_IDLE(1'b1)      // 0 if the drivers switch a coil on with H
  ) u_part (
      .clk,
      .rst_n,
      .a0,
      .cs_n,
      .rd_n,
      .wr_n,
      .d_i,
      .d_o,
      .d_oe,
      .int_n,
      .csel (1'b1),         // 500 kHz
      .vsel (1'b1),         // plain rate formula
      .clock(1'b0),         // no external base clock
      .l1_n,
      .l2_n,
      .l3_n,
      .l4_n,
      .cnp_n,
      .alm_n,
      .auxi (4'b0000),
      .auxo (unused_auxo),
      .aux_n(unused_aux),
      .s,
      .hold,
      .pout_n,
      .dir
  );

endmodule

`default_nettype wire
