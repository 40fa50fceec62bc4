// SPDX-License-Identifier: Apache-2.0
// ppmc_bank_tables: ramp tables of all axes in one RAM, with one builder that fills them.
// Rules:  P104-RMP-02, P104-INI-07, BANK-INI-01, BANK-HSK-05.
// Timing: build_start_i is accepted while build_busy_o = 0. The table is complete when build_busy_o falls.
//         threshold_o is valid two cycles after axis_i and rate_i.
`default_nettype none

module ppmc_bank_tables #(
    parameter int unsigned AxisBits = 5,
    parameter int unsigned StepBits = 14
) (
    input  wire logic                clk_i,
    input  wire logic                rst_ni,
    // build
    input  wire logic                build_start_i,  // strobe: build a table
    input  wire logic [AxisBits-1:0] build_axis_i,   // axis of the table to build
    input  wire logic [         7:0] slow_i,         // start-up rate
    input  wire logic [         7:0] fast_i,         // high-speed rate
    input  wire logic [StepBits-1:0] steps_i,        // acceleration pulses PA
    output logic                     build_busy_o,   // 1: a build is in progress
    output logic      [AxisBits-1:0] build_axis_o,   // axis of the current build
    // look up
    input  wire logic [AxisBits-1:0] axis_i,         // axis of the look-up
    input  wire logic [         7:0] rate_i,         // rate r
    output logic      [StepBits-1:0] threshold_o     // first ramp index whose rate is below r
);

  logic start_q, busy, we;
  logic [7:0] slow_q, fast_q, waddr;
  logic [StepBits-1:0] steps_q, wdata;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) {build_busy_o, start_q} <= '0;
    else begin
      start_q <= build_start_i;
      build_busy_o <= build_start_i || (build_busy_o && (start_q || busy));
    end
  end

  always_ff @(posedge clk_i) begin
    if (build_start_i) {build_axis_o, slow_q, fast_q, steps_q} <= {build_axis_i, slow_i, fast_i, steps_i};
  end

  ppmc_ramp_builder #(
      .StepBits(StepBits)
  ) u_builder (
      .clk_i,
      .rst_ni,
      .start_i(start_q),
      .slow_i (slow_q),
      .fast_i (fast_q),
      .steps_i(steps_q),
      .busy_o (busy),
      .we_o   (we),
      .addr_o (waddr),
      .data_o (wdata)
  );

  ppmc_ram #(
      .Width   (StepBits),
      .AddrBits(AxisBits + 8)
  ) u_tables (
      .clk_i,
      .we_i   (we),
      .waddr_i({build_axis_o, waddr}),
      .wdata_i(wdata),
      .raddr_i({axis_i, rate_i}),
      .rdata_o(threshold_o)
  );

endmodule

`default_nettype wire
