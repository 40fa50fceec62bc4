// SPDX-License-Identifier: Apache-2.0
// ppmc_ramp_table: ramp table in block RAM, with its builder and the parameters from which it was built.
// Rules:  P104-RMP-02, P104-INI-05/07.
// Timing: see ppmc_ramp_builder. data_o is valid two cycles after addr_i.
`default_nettype none

module ppmc_ramp_table #(
    parameter int unsigned RateBits = 8,
    parameter int unsigned StepBits = 14
) (
    input  wire logic                clk_i,
    input  wire logic                rst_ni,
    input  wire logic                start_i,  // strobe: start a build
    input  wire logic [RateBits-1:0] slow_i,   // start-up rate; stable while busy_o = 1
    input  wire logic [RateBits-1:0] fast_i,   // high-speed rate; stable while busy_o = 1
    input  wire logic [StepBits-1:0] steps_i,  // acceleration pulses PA; stable while busy_o = 1
    output logic                     busy_o,   // 1: build in progress, the table is not valid
    output logic      [RateBits-1:0] slow_o,   // start-up rate of the table
    output logic      [RateBits-1:0] fast_o,   // high-speed rate of the table
    output logic      [StepBits-1:0] steps_o,  // acceleration pulses of the table
    input  wire logic [RateBits-1:0] addr_i,   // rate r
    output logic      [StepBits-1:0] data_o    // threshold of r; PA for fast_o
);

  logic we;
  logic [RateBits-1:0] waddr;
  logic [StepBits-1:0] wdata;

  assign slow_o = waddr;  // the builder stops at this address

  // No reset: a build sets these outputs.
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
