// SPDX-License-Identifier: Apache-2.0
// ppmc312_stage_table_fv: proves for an arbitrary stage and side that both read ports return the words last
// written to it.
`include "ppmc_fv.svh"
`default_nettype none

module ppmc312_stage_table_fv (
    input wire logic       clk_i,
    input wire logic       we_rate_i,
    input wire logic       we_pulses_i,
    input wire logic       wside_i,
    input wire logic [1:0] waddr_i,
    input wire logic [1:0] wdata_i,
    input wire logic       side_a_i,
    input wire logic [1:0] addr_a_i,
    input wire logic       side_b_i,
    input wire logic [1:0] addr_b_i,
    input wire logic [1:0] stage_i,      // any stage
    input wire logic       stage_side_i  // any side
);

  logic rate_a_o, rate_b_o;
  logic [1:0] pulses_a_o, pulses_b_o;

  `FV_RESET

  ppmc312_stage_table #(
      .StageBits(2),
      .RateBits (1),
      .SumBits  (2)
  ) dut (
      .we_rate_i  (we_rate_i && rst_ni),
      .we_pulses_i(we_pulses_i && rst_ni),
      .*
  );

  `FV_ASSUME(one_stage, {stage_i, stage_side_i} == $past({stage_i, stage_side_i}))

  logic hit_rate, hit_pulses, rate_q;
  logic [1:0] pulses_q, rates_h, side_a, side_b;
  logic [1:0][1:0] pulses_h;  // [n]: word n + 1 cycles ago
  logic [1:0] reads_a, reads_b;

  assign hit_rate   = we_rate_i && waddr_i == stage_i;
  assign hit_pulses = we_pulses_i && {wside_i, waddr_i} == {stage_side_i, stage_i};

  always_ff @(posedge clk_i) begin
    if (!rst_ni) {rate_q, pulses_q, reads_a, reads_b} <= '0;
    else begin
      if (hit_rate) rate_q <= wdata_i[0];
      if (hit_pulses) pulses_q <= wdata_i;
      reads_a <= {reads_a[0], addr_a_i == stage_i && !hit_rate && !hit_pulses};
      reads_b <= {reads_b[0], addr_b_i == stage_i && !hit_rate && !hit_pulses};
    end
    rates_h  <= {rates_h[0], rate_q};
    pulses_h <= {pulses_h[0], pulses_q};
    side_a   <= {side_a[0], side_a_i == stage_side_i};
    side_b   <= {side_b[0], side_b_i == stage_side_i};
  end

  `FV_ASSERT(rate_a, !reads_a[1] || rate_a_o == rates_h[1])
  `FV_ASSERT(rate_b, !reads_b[1] || rate_b_o == rates_h[1])
  `FV_ASSERT(pulses_a, !(reads_a[1] && side_a[1]) || pulses_a_o == pulses_h[1])
  `FV_ASSERT(pulses_b, !(reads_b[1] && side_b[1]) || pulses_b_o == pulses_h[1])
  `FV_COVER(seen_both, reads_a[1] && side_a[1] && pulses_a_o == 2'd2 && rate_a_o)

endmodule

`default_nettype wire
