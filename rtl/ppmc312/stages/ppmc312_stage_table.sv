// SPDX-License-Identifier: Apache-2.0
// ppmc312_stage_table: stores a ramp of up to 127 stages in block RAM. Each stage has a rate, a number of
//         acceleration pulses and a number of deceleration pulses.
// Rules:  P312-TBL-01, P312-CMD-FC-10.
// Timing: read latency 2 cycles.
// How:    each of the two read ports has a separate copy of the RAM. The motion uses port a, and planner
//         and read-back use port b.
`default_nettype none

module ppmc312_stage_table #(
    parameter int unsigned StageBits = 7,
    parameter int unsigned RateBits  = 16,
    parameter int unsigned SumBits   = 24
) (
    input  wire logic                 clk_i,        // clock
    input  wire logic                 we_rate_i,    // strobe: write a rate
    input  wire logic                 we_pulses_i,  // strobe: write the pulses of a side
    input  wire logic                 wside_i,      // 0: acceleration, 1: deceleration
    input  wire logic [StageBits-1:0] waddr_i,      // stage, 0 .. 126
    input  wire logic [  SumBits-1:0] wdata_i,      // rate in bits 15:0, or number of pulses
    input  wire logic                 side_a_i,     // port a: side of the pulses
    input  wire logic [StageBits-1:0] addr_a_i,     // port a: stage
    output logic      [ RateBits-1:0] rate_a_o,     // port a: base clocks, two cycles later
    output logic      [  SumBits-1:0] pulses_a_o,   // port a: pulses, two cycles later
    input  wire logic                 side_b_i,     // port b: side of the pulses
    input  wire logic [StageBits-1:0] addr_b_i,     // port b: stage
    output logic      [ RateBits-1:0] rate_b_o,     // port b: base clocks, two cycles later
    output logic      [  SumBits-1:0] pulses_b_o    // port b: pulses, two cycles later
);

  logic [1:0] side;
  logic [1:0][StageBits-1:0] addr;
  logic [1:0][RateBits-1:0] rate;
  logic [1:0][SumBits-1:0] pulses;

  assign side = {side_b_i, side_a_i};
  assign addr = {addr_b_i, addr_a_i};
  assign {rate_b_o, rate_a_o} = rate;
  assign {pulses_b_o, pulses_a_o} = pulses;

  for (genvar n = 0; n < 2; n++) begin : g_copy
    ppmc_ram #(
        .Width   (RateBits),
        .AddrBits(StageBits)
    ) u_rate (
        .clk_i,
        .we_i   (we_rate_i),
        .waddr_i,
        .wdata_i(wdata_i[RateBits-1:0]),
        .raddr_i(addr[n]),
        .rdata_o(rate[n])
    );

    ppmc_ram #(
        .Width   (SumBits),
        .AddrBits(StageBits + 1)
    ) u_pulses (
        .clk_i,
        .we_i   (we_pulses_i),
        .waddr_i({wside_i, waddr_i}),
        .wdata_i,
        .raddr_i({side[n], addr[n]}),
        .rdata_o(pulses[n])
    );
  end

endmodule

`default_nettype wire
