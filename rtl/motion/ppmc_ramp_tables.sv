// SPDX-License-Identifier: Apache-2.0
// ppmc_ramp_tables: ramp tables of two axes in two block RAMs, with one builder that fills both.
// Rules:  P2104-RMP-01/02, P2104-HSK-05 (a build waits for at most one other build).
// Timing: see ppmc_ramp_builder. A build begins at the edge of start_i or, if another build is running, at
//         the end of that build. A build takes two cycles longer than in ppmc_ramp_builder alone.
//         data_o is valid two cycles after addr_i.
`include "ppmc_assert.svh"
`default_nettype none

module ppmc_ramp_tables #(
    parameter int unsigned RateBits = 8,
    parameter int unsigned StepBits = 14
) (
    input  wire logic                     clk_i,
    input  wire logic                     rst_ni,
    input  wire logic [2:1]               start_i,  // strobe: start a build; only while busy_o = 0
    input  wire logic [2:1][RateBits-1:0] slow_i,   // start-up rate; stable while busy_o = 1
    input  wire logic [2:1][RateBits-1:0] fast_i,   // high-speed rate; stable while busy_o = 1
    input  wire logic [2:1][StepBits-1:0] steps_i,  // acceleration pulses PA; stable while busy_o = 1
    output logic      [2:1]               busy_o,   // 1: build pending or in progress, data_o not valid
    input  wire logic [2:1][RateBits-1:0] addr_i,   // rate r
    output logic      [2:1][StepBits-1:0] data_o    // threshold of r
);

  logic second_q;  // axis of the current build, 1: axis 2
  logic was_busy_q, we, start, busy, done;
  logic [2:1] build_axis;
  logic [RateBits-1:0] slow_q, fast_q, waddr;
  logic [StepBits-1:0] steps_q, wdata;

  assign build_axis    = {second_q, !second_q};
  assign done  = was_busy_q && !busy;
  assign start = busy_o != '0 && !busy && !was_busy_q;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      busy_o   <= '0;
      second_q <= 1'b0;
      was_busy_q    <= 1'b0;
    end else begin
      was_busy_q <= busy;
      busy_o <= (busy_o & ~(build_axis &{2{done}})) | start_i;
      if (start) second_q <= !busy_o[1];
    end
  end

  // No reset: every build begins with a load.
  always_ff @(posedge clk_i) begin
    if (start) begin
      slow_q  <= busy_o[1] ? slow_i[1] : slow_i[2];
      fast_q  <= busy_o[1] ? fast_i[1] : fast_i[2];
      steps_q <= busy_o[1] ? steps_i[1] : steps_i[2];
    end
  end

  ppmc_ramp_builder #(
      .RateBits(RateBits),
      .StepBits(StepBits)
  ) u_builder (
      .clk_i,
      .rst_ni,
      .start_i(start),
      .slow_i (slow_q),
      .fast_i (fast_q),
      .steps_i(steps_q),
      .busy_o (busy),
      .we_o   (we),
      .addr_o (waddr),
      .data_o (wdata)
  );

  for (genvar n = 1; n <= 2; n++) begin : g_axis
    ppmc_ram #(
        .Width   (StepBits),
        .AddrBits(RateBits)
    ) u_lut (
        .clk_i,
        .we_i   (we && build_axis[n]),
        .waddr_i(waddr),
        .wdata_i(wdata),
        .raddr_i(addr_i[n]),
        .rdata_o(data_o[n])
    );
  end

`ifndef SYNTHESIS
  `PPMC_ASSERT(p2104_hsk_05_once, (start_i & busy_o) == '0)
  `PPMC_ASSERT(p2104_hsk_05_requested, !busy || (busy_o & build_axis) != '0)
`endif

endmodule

`default_nettype wire
