// SPDX-License-Identifier: Apache-2.0
// ppmc_ramp_tables_fv: proves that each axis gets a table from its own parameters, and that a build waits
// for at most one other build.
`include "ppmc_fv.svh"
`default_nettype none

module ppmc_ramp_tables_fv (
    input wire logic            clk_i,
    input wire logic [2:1]      start_i,
    input wire logic [2:1][1:0] slow_i,
    input wire logic [2:1][1:0] fast_i,
    input wire logic [2:1][1:0] steps_i,
    input wire logic [2:1][1:0] addr_i
);

  localparam int unsigned Build = 5 + 2;  // cycles of one build with the stub of the builder

  logic [2:1] busy_o;
  logic [2:1][1:0] data_o;

  `FV_RESET

  ppmc_ramp_tables #(
      .RateBits(2),
      .StepBits(2)
  ) dut (
      .*
  );

  logic [2:1][3:0] age_q;  // cycles since the start of the build
  logic [2:1][1:0] words_q;  // number of written words, saturates at 3

  for (genvar n = 1; n <= 2; n++) begin : g_axis
    always_ff @(posedge clk_i)
      if (!rst_ni || !busy_o[n]) {age_q[n], words_q[n]} <= '0;
      else begin
        age_q[n]   <= age_q[n] + 1'b1;
        words_q[n] <= words_q[n] + 2'(dut.we && dut.build_axis[n]);
      end

    `FV_ASSUME(once, !(start_i[n] && busy_o[n]))
    `FV_ASSUME(stands, !busy_o[n] || {slow_i[n], fast_i[n], steps_i[n]} == $past(
               {slow_i[n], fast_i[n], steps_i[n]}))

    `FV_ASSERT(p2104_hsk_05_waits_for_one_other, age_q[n] <= 4'(2 * Build + 1))
    `FV_ASSERT(
        p2104_rmp_01_its_own_numbers,
        !(dut.we && dut.build_axis[n]) || (busy_o[n] && dut.waddr == slow_i[n] && dut.wdata == steps_i[n]))
    `FV_ASSERT(p2104_rmp_01_built, !($past(rst_ni && busy_o[n]) && !busy_o[n]) || $past(words_q[n]) == 2'd1)
  end

  `FV_COVER(seen_wait, busy_o == 2'b10 && age_q[2] == 4'd10)

endmodule

`default_nettype wire
