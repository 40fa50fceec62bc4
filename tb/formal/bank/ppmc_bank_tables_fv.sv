// SPDX-License-Identifier: Apache-2.0
// ppmc_bank_tables_fv: proves that a table is written only during a build, only for the axis that requested
// the build, and from the parameters of this axis. Proves that the build ends.
`include "ppmc_fv.svh"
`default_nettype none

module ppmc_bank_tables_fv (
    input wire logic       clk_i,
    input wire logic       build_start_i,
    input wire logic [0:0] build_axis_i,
    input wire logic [7:0] slow_i,
    input wire logic [7:0] fast_i,
    input wire logic [1:0] steps_i,
    input wire logic [0:0] axis_i,
    input wire logic [7:0] rate_i
);

  logic build_busy_o;
  logic [0:0] build_axis_o;
  logic [1:0] threshold_o;

  `FV_RESET

  ppmc_bank_tables #(
      .AxisBits(1),
      .StepBits(2)
  ) dut (
      .*
  );

  `FV_ASSUME(only_when_idle, !(build_start_i && build_busy_o))

  logic axis_q, written_q;  // axis_q: axis of the build; written_q: the build has written its word
  logic [7:0] slow_q;
  logic [1:0] steps_q;
  logic [3:0] age_q;

  always_ff @(posedge clk_i)
    if (!rst_ni) {axis_q, slow_q, steps_q, age_q, written_q} <= '0;
    else if (build_start_i)
      {axis_q, slow_q, steps_q, age_q, written_q} <= {build_axis_i, slow_i, steps_i, 5'd0};
    else begin
      age_q <= build_busy_o ? age_q + 1'b1 : '0;
      written_q <= written_q || dut.we;
    end

  `FV_ASSERT(
      bank_ini_01_write_for_requested_axis,
      !dut.we || (build_busy_o && build_axis_o == axis_q && dut.waddr == slow_q && dut.wdata == steps_q))
  `FV_ASSERT(bank_hsk_05_build_ends, age_q <= 4'd8)
  `FV_ASSERT(bank_hsk_05_complete_when_idle, !($past(rst_ni && build_busy_o) && !build_busy_o) || written_q)
  `FV_COVER(seen_second_axis, dut.we && build_axis_o == 1'b1)

endmodule

`default_nettype wire
