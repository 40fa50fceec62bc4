// SPDX-License-Identifier: Apache-2.0
// ppmc_ramp_table: a ramp in block RAM, what fills it, and the numbers that it was built from.
// Rules:  P104-RMP-02, P104-INI-05/07. Timing: see ppmc_ramp_builder; data_o stands two clk after addr_i.
`default_nettype none

module ppmc_ramp_table #(
    parameter int unsigned RateBits = 8,
    parameter int unsigned StepBits = 14
) (
    input  wire logic                clk_i,
    input  wire logic                rst_ni,
    input  wire logic                start_i,  // build
    input  wire logic [RateBits-1:0] slow_i,   // start-up rate; steady while busy_o
    input  wire logic [RateBits-1:0] fast_i,   // high-speed rate; the same
    input  wire logic [StepBits-1:0] steps_i,  // acceleration pulses PA; the same
    output logic                     busy_o,   // no use may be made of the outputs below
    output logic      [RateBits-1:0] slow_o,   // of the ramp in the table
    output logic      [RateBits-1:0] fast_o,   // the same
    output logic      [StepBits-1:0] steps_o,  // the same
    input  wire logic [RateBits-1:0] addr_i,   // r
    output logic      [StepBits-1:0] data_o    // thr(r), PA for fast_o
);

  logic we;
  logic [RateBits-1:0] waddr;
  logic [StepBits-1:0] wdata;

  assign slow_o = waddr;  // where the builder has stopped

  // No reset: a build sets them.
  always_ff @(posedge clk_i) begin
    if (busy_o) {steps_o, fast_o} <= {steps_i, fast_i};
  end

  ppmc_ramp_builder #(
      .RateBits(RateBits),
      .StepBits(StepBits)
  ) u_builder (
      .clk_i,
      .rst_ni,
      .start_i,
      .slow_i,
      .fast_i,
      .steps_i,
      .busy_o,
      .we_o  (we),
      .addr_o(waddr),
      .data_o(wdata)
  );

  ppmc_ram #(
      .Width   (StepBits),
      .AddrBits(RateBits)
  ) u_lut (
      .clk_i,
      .we_i   (we),
      .waddr_i(waddr),
      .wdata_i(wdata),
      .raddr_i(addr_i),
      .rdata_o(data_o)
  );

endmodule

`default_nettype wire
