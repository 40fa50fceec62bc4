// SPDX-License-Identifier: Apache-2.0
// ppmc312_aux_monitor_fv: proves the reports of the monitor of the generalized input, with a sample every 2.5
// cycles on average.
`include "ppmc_fv.svh"
`default_nettype none

module ppmc312_aux_monitor_fv (
    input wire logic       clk_i,
    input wire logic       set_i,
    input wire logic       repeat_i,
    input wire logic [7:0] mask_i,
    input wire logic [7:0] auxi_i
);

  logic report_o, repeat_q, ended_q;
  logic [7:0] data_o, mask_q, before_q;

  `FV_RESET

  ppmc312_aux_monitor #(
      .ClkHz (1),
      .XtalHz(320)
  ) dut (
      .*
  );

  // before_q: levels at the last sample, or at set_i; ended_q: 1 after the only report, and before set_i
  always_ff @(posedge clk_i)
    if (!rst_ni) {repeat_q, mask_q, before_q, ended_q} <= {17'd0, 1'b1};
    else if (set_i) {repeat_q, mask_q, before_q, ended_q} <= {repeat_i, mask_i, auxi_i, 1'b0};
    else if (dut.tick) begin
      before_q <= auxi_i;
      ended_q  <= ended_q || (report_o && !repeat_q);
    end

  `FV_ASSERT(p312_mon_10_each_change,
             report_o == (dut.tick && !ended_q && ((auxi_i ^ before_q) & mask_q) != '0))
  `FV_ASSERT(p312_mon_10_its_bits, !report_o || data_o == ((auxi_i ^ before_q) & mask_q))
  `FV_COVER(seen_second_report, report_o && repeat_q && before_q != '0)

endmodule

`default_nettype wire
