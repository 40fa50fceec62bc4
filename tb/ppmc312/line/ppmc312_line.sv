// SPDX-License-Identifier: Apache-2.0
// ppmc312_line: PPMC-312 stations in serial mode on one RS-485 line.
// Rules:  a disabled driver leaves the line high. If two drivers disagree, the line is low.
// Timing: each rising edge samples the levels that master and stations drive before this edge. A reset
//         takes effect at an edge.
// Note:   the stations are compiled separately (`line_station`, station.cpp), so all use the same code.
//         Each station receives the level of the master. With hear_others = 1, a station also receives the
//         levels of the other stations; with hear_self = 1, also its own level. noise[i] = 1 inverts the
//         level that station i receives.
`default_nettype none

module ppmc312_line #(
    parameter int unsigned N = 16
) (
    input  wire logic           clk,
    input  wire logic           rst_n,
    // line
    input  wire logic           master,
    input  wire logic           hear_others,
    input  wire logic           hear_self,
    input  wire logic [  N-1:0] noise,
    output logic                line,
    output logic      [  N-1:0] txd,
    output logic      [  N-1:0] snd,
    // set-up, latched at the end of a reset
    input  wire logic [4*N-1:0] adr,
    input  wire logic [3*N-1:0] mod,
    // switches and driver
    input  wire logic [  N-1:0] evt0_n,
    input  wire logic [  N-1:0] evt1_n,
    input  wire logic [  N-1:0] fl_n,
    input  wire logic [  N-1:0] bl_n,
    input  wire logic [  N-1:0] org_n,
    input  wire logic [  N-1:0] alm_n,
    input  wire logic [  N-1:0] end_n,
    input  wire logic [  N-1:0] run,
    output logic      [6*N-1:0] auxo_n,
    output logic      [  N-1:0] exon_n,
    output logic      [  N-1:0] cclr_n,
    output logic      [  N-1:0] aclr_n,
    output logic      [  N-1:0] zclmp_n,
    output logic      [  N-1:0] cd_n,
    output logic      [  N-1:0] intlk_n,
    output logic      [  N-1:0] out_oe,
    // outputs that do not change in serial mode
    output logic      [8*N-1:0] d_o,
    output logic      [  N-1:0] d_oe,
    output logic      [  N-1:0] wrq_n,
    output logic      [  N-1:0] irq_n,
    // pulses
    output logic      [  N-1:0] pout,
    output logic      [  N-1:0] dir
);

  import "DPI-C" function chandle line_station_new(input int number);
  import "DPI-C" function int line_station_clk(
    input chandle station,
    input bit rst_n,
    input int pins
  );

  // driven: output of each driver; rxd: level that each station receives
  logic [N-1:0] driven, rxd;

  assign driven = txd | ~snd;
  assign line   = master & (&driven);

  always_comb begin
    for (int unsigned i = 0; i < N; i++) begin
      logic others;
      others = &(driven | N'(1) << i);
      rxd[i] = noise[i] ^ (master & (others | ~hear_others) & (driven[i] | ~hear_self));
    end
  end

  for (genvar i = 0; i < N; i++) begin : g_station
    chandle station;
    logic [15:0] pins;
    logic [27:0] pins_q;

    initial station = line_station_new(i);

    assign pins = {
      run[i],
      end_n[i],
      alm_n[i],
      org_n[i],
      bl_n[i],
      fl_n[i],
      evt1_n[i],
      evt0_n[i],
      mod[3*i+:3],
      adr[4*i+:4],
      rxd[i]
    };

    always_ff @(posedge clk) begin
      pins_q <= 28'(line_station_clk(station, rst_n, {16'd0, pins}));
    end

    assign {
      irq_n[i],
      wrq_n[i],
      d_oe[i],
      d_o[8*i+:8],
      out_oe[i],
      intlk_n[i],
      cd_n[i],
      zclmp_n[i],
      aclr_n[i],
      cclr_n[i],
      exon_n[i],
      auxo_n[6*i+:6],
      dir[i],
      pout[i],
      snd[i],
      txd[i]
    } = pins_q;
  end

endmodule

`default_nettype wire
