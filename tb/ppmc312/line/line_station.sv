// SPDX-License-Identifier: Apache-2.0
// line_station: a PPMC-312 in serial mode with packed pins, so that one compiled model serves all stations.
//         The inputs that a station on the line does not use are inactive.
// Timing: see ppmc312. Packing adds no delay.
`default_nettype none

module line_station #(
    parameter int unsigned CLK_HZ   = 8_000_000,
    parameter int unsigned XTAL_HZ  = 16_000_000,
    parameter              TIMING   = "FAST",
    parameter              SUM_MODE = "BINARY"
) (
    input  wire logic        clk,
    input  wire logic        rst_n,
    input  wire logic [15:0] pins_i,  // input pins, packed as in `ppmc312_line`
    output logic      [27:0] pins_o   // output pins, packed as in `ppmc312_line`
);

  logic rxd, evt0_n, evt1_n, fl_n, bl_n, org_n, alm_n, end_n, run;
  logic [2:0] mod;
  logic [3:0] adr;
  logic txd, snd, pout, dir, exon_n, cclr_n, aclr_n, zclmp_n, cd_n, intlk_n, out_oe;
  logic d_oe, wrq_n, irq_n;
  logic [7:0] d_o;
  logic [5:0] auxo_n;

  assign {run, end_n, alm_n, org_n, bl_n, fl_n, evt1_n, evt0_n, mod, adr, rxd} = pins_i;
  assign pins_o = {
    irq_n,
    wrq_n,
    d_oe,
    d_o,
    out_oe,
    intlk_n,
    cd_n,
    zclmp_n,
    aclr_n,
    cclr_n,
    exon_n,
    auxo_n,
    dir,
    pout,
    snd,
    txd
  };

  ppmc312 #(
      .CLK_HZ  (CLK_HZ),
      .XTAL_HZ (XTAL_HZ),
      .TIMING  (TIMING),
      .SUM_MODE(SUM_MODE)
  ) u_part (
      .clk,
      .rst_n,
      .mode   (1'b0),
      .d_i    (8'h00),
      .d_o,
      .d_oe,
      .rs     (3'd0),
      .cs_n   (1'b1),
      .we_n   (1'b1),
      .oe_n   (1'b1),
      .wrq_n,
      .irq_n,
      .rxd,
      .txd,
      .snd,
      .hsp    (1'b0),
      .mod,
      .adr,
      .evt0_n,
      .evt1_n,
      .auxi   (8'h00),
      .auxo_n,
      .exon_n,
      .cclr_n,
      .aclr_n,
      .zclmp_n,
      .cd_n,
      .alm_n,
      .end_n,
      .epin   (1'b0),
      .epdir  (1'b0),
      .index_n(1'b1),
      .org_n,
      .fl_n,
      .bl_n,
      .fhl_n  (1'b1),
      .bhl_n  (1'b1),
      .pout,
      .dir,
      .extck  (1'b0),
      .run,
      .intlk_n,
      .out_oe
  );

endmodule

`default_nettype wire
