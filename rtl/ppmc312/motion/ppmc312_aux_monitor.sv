// SPDX-License-Identifier: Apache-2.0
// ppmc312_aux_monitor: reports changes of the monitored bits of the generalized input.
// Rules:  P312-MON-10, P312-CMD-28.
// Timing: auxi_i is sampled every 50 us, counted from set_i. report_o is high in the cycle of the sample.
`default_nettype none

module ppmc312_aux_monitor #(
    parameter int unsigned ClkHz  = 16_000_000,
    parameter int unsigned XtalHz = 16_000_000
) (
    input  wire logic       clk_i,     // clock
    input  wire logic       rst_ni,    // reset, asynchronous
    input  wire logic       set_i,     // strobe: latch repeat_i and mask_i; restart
    input  wire logic       repeat_i,  // 1: continue after a report, 0: end after one report
    input  wire logic [7:0] mask_i,    // 1: bit is monitored
    input  wire logic [7:0] auxi_i,    // generalized input, synchronised
    output logic            report_o,  // strobe: monitored bits have changed
    output logic      [7:0] data_o     // changed bits; valid with report_o
);

  localparam int unsigned SampleXtal = 800;

  logic tick, repeat_q;
  logic [7:0] mask_q, prev_q;

  ppmc_tick_gen #(
      .ClkHz   (ClkHz),
      .XtalHz  (XtalHz),
      .TickXtal(SampleXtal)
  ) u_sample (
      .clk_i,
      .rst_ni,
      .restart_i(set_i),
      .tick_o   (tick)
  );

  assign data_o   = (prev_q ^ auxi_i) & mask_q;
  assign report_o = tick && data_o != '0;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      repeat_q <= 1'b0;
      mask_q   <= '0;
      prev_q   <= '0;
    end else if (set_i) begin
      repeat_q <= repeat_i;
      mask_q   <= mask_i;
      prev_q   <= auxi_i;
    end else if (tick) begin
      prev_q <= auxi_i;
      if (report_o && !repeat_q) mask_q <= '0;
    end
  end

endmodule

`default_nettype wire
