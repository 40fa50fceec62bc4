// SPDX-License-Identifier: Apache-2.0
// ppmc_tick_gen: outputs a tick every `TickXtal` crystal cycles. A phase accumulator avoids drift.
// Rules:  P104-BCK-03 (quantum ticks), P104-GEN-04.
// Timing: after a restart that takes effect at edge e, tick n is high in the cycle before edge e + ceil(n *
//         TickXtal * ClkHz / XtalHz). Registers that are enabled by the tick change at exactly this edge.
`include "ppmc_assert.svh"
`default_nettype none

module ppmc_tick_gen #(
    parameter int unsigned ClkHz     = 16_000_000,
    parameter int unsigned XtalHz    = 16_000_000,
    parameter int unsigned TickXtal  = 4,           // tick period in crystal cycles
    parameter int unsigned MinCycles = 2            // shortest permitted tick period in cycles, 1 or 2
) (
    input  wire logic clk_i,
    input  wire logic rst_ni,
    input  wire logic restart_i,  // strobe: set the phase to 0 at the next edge
    output logic      tick_o      // strobe, registered: a tick
);

  localparam longint unsigned Period = 64'(TickXtal) * 64'(ClkHz);
  localparam longint unsigned Common = ppmc_pkg::gcd(Period, 64'(XtalHz));
  localparam int unsigned Modulus = 32'(Period / Common);
  localparam int unsigned Step = 32'(64'(XtalHz) / Common);
  localparam int unsigned Width = ppmc_pkg::cnt_width(Modulus - 1);

  if (Modulus < MinCycles * Step) begin : g_check
    $fatal(1, "ppmc_tick_gen: a tick must last at least %0d cycles", MinCycles);
  end

  if (Modulus == Step) begin : g_every
    logic unused_phase;

    assign unused_phase = &{1'b0, restart_i, Width'(0)};
    always_ff @(posedge clk_i or negedge rst_ni) begin
      if (!rst_ni) tick_o <= 1'b0;
      else tick_o <= 1'b1;
    end
  end else begin : g_phase
    logic [Width-1:0] phase_d, phase_q;
    logic wrap;

    // The phase is one cycle ahead of the tick, which leaves a cycle for the output register.
    always_comb begin
      wrap = phase_q >= Width'(Modulus - Step);
      phase_d = phase_q + (wrap ? Width'(Step) - Width'(Modulus) : Width'(Step));
      if (restart_i) phase_d = Width'(Step);
    end

    always_ff @(posedge clk_i or negedge rst_ni) begin
      if (!rst_ni) begin
        phase_q <= Width'(Step);
        tick_o  <= 1'b0;
      end else begin
        phase_q <= phase_d;
        tick_o  <= wrap && !restart_i;
      end
    end

`ifndef SYNTHESIS
    `PPMC_ASSERT(tick_gen_phase_in_range, 32'(phase_q) < Modulus)
    `PPMC_ASSERT(tick_gen_single, MinCycles < 2 || !(tick_o && $past(tick_o)))
`endif
  end

endmodule

`default_nettype wire
