// SPDX-License-Identifier: Apache-2.0
// ppmc104_example_wishbone: a PPMC-104 that a soft CPU reaches over Wishbone.
//         Copy it and change it; `make lint` elaborates it as it stands. Manual: docs/integration.md.
`default_nettype none

module ppmc104_example_wishbone #(
    parameter int unsigned CLK_HZ  = 16_000_000,  // frequency of clk, 8e6 .. 200e6
    parameter int unsigned XTAL_HZ = 16_000_000,  // all speeds of the part follow it
    parameter              TIMING  = "FAST"       // or "DATASHEET": with the old chip's processing times
) (
    input  wire logic        clk,
    input  wire logic        rst_n,     // may assert at any time
    // Wishbone B4, classic cycles, 32 bits: four words, byte addresses 0x0 .. 0xC
    input  wire logic        wb_cyc,
    input  wire logic        wb_stb,
    input  wire logic        wb_we,
    input  wire logic [ 3:2] wb_adr,
    input  wire logic [ 3:0] wb_sel,
    input  wire logic [31:0] wb_dat_w,
    output logic      [31:0] wb_dat_r,
    output logic             wb_ack,
    output logic             wb_err,
    output logic             irq,       // a motion has ended
    // switches, 0 = active; asynchronous
    input  wire logic        l1_n,
    input  wire logic        l2_n,
    input  wire logic        l3_n,
    input  wire logic        l4_n,
    input  wire logic        cnp_n,
    input  wire logic        alm_n,
    // motor
    output logic      [ 5:1] s,
    output logic             hold,
    output logic             pout_n,
    output logic             dir
);

  logic rst, a0, cs_n, rd_n, wr_n, int_n, unused_oe, unused_aux;
  logic [7:0] to_part, from_part;
  logic [3:0] unused_auxo;

  // One release for bridge and part. Leave it out if rst_n is released in step with clk already.
  ppmc_reset u_reset (
      .clk_i (clk),
      .rst_ni(rst_n),
      .rst_no(rst)
  );

  ppmc_wishbone #(
      .AddrBits(1)
  ) u_host (
      .clk_i (clk),
      .rst_ni(rst),
      .cyc_i (wb_cyc),
      .stb_i (wb_stb),
      .we_i  (wb_we),
      .adr_i (wb_adr),
      .sel_i (wb_sel),
      .dat_i (wb_dat_w),
      .dat_o (wb_dat_r),
      .ack_o (wb_ack),
      .err_o (wb_err),
      .irq_o (irq),
      .cs_no (cs_n),
      .rd_no (rd_n),
      .wr_no (wr_n),
      .a_o   (a0),
      .d_o   (to_part),
      .d_i   (from_part),
      .int_ni(int_n)
  );

  ppmc104 #(
      .CLK_HZ    (CLK_HZ),
      .XTAL_HZ   (XTAL_HZ),
      .TIMING    (TIMING),
      .PHASE_IDLE(1'b1)      // 0 if the drivers switch a coil on with H
  ) u_part (
      .clk,
      .rst_n(rst),
      .a0,
      .cs_n,
      .rd_n,
      .wr_n,
      .d_i  (to_part),
      .d_o  (from_part),
      .d_oe (unused_oe),
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
