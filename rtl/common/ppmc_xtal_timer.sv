// SPDX-License-Identifier: Apache-2.0
// ppmc_xtal_timer: counts crystal cycles since its restart and says whether a number of them has passed.
// Rules:  P104-GEN-02/03 for times that are not known at elaboration.
// Timing: after a restart at edge e, past_o is high from the clk after edge e + ceil(limit * ClkHz / XtalHz)
//         on; what it enables changes one edge later. The count stops at its end, never wraps: limit_i may be
//         at most 2**Width - 2, with more than two crystal cycles a clk 2**Width - 4.
`default_nettype none

module ppmc_xtal_timer #(
    parameter int unsigned ClkHz  = 16_000_000,  // at least XtalHz / 3
    parameter int unsigned XtalHz = 16_000_000,
    parameter int unsigned Width  = 22           // bits of limit_i
) (
    input  wire logic             clk_i,
    input  wire logic             rst_ni,
    input  wire logic             restart_i,  // count from 0
    input  wire logic [Width-1:0] limit_i,    // crystal cycles
    output logic                  past_o      // so many have passed
);

  localparam longint unsigned Common = ppmc_pkg::gcd(64'(ClkHz), 64'(XtalHz));
  localparam int unsigned Modulus = 32'(64'(ClkHz) / Common);
  localparam int unsigned Step = 32'(64'(XtalHz) / Common);
  localparam int unsigned PhaseBits = ppmc_pkg::cnt_width(Modulus + Step);

  if (3 * Modulus < Step) begin : g_check
    $fatal(1, "ppmc_xtal_timer: at most three crystal cycles a clk");
  end

  logic [PhaseBits-1:0] sum, phase_d, phase_q;
  logic [1:0] cycles;
  logic full;
  logic [Width-1:0] count_q;

  assign full = (Step > 2 * Modulus) ? &count_q[Width-1:2] : &count_q[Width-1:1];

  always_comb begin
    sum     = phase_q + PhaseBits'(Step);
    cycles  = 2'd0;
    phase_d = sum;
    if (Step > 2 * Modulus && 64'(sum) >= 64'd3 * 64'(Modulus)) begin
      cycles  = 2'd3;
      phase_d = PhaseBits'(64'(sum) - 64'd3 * 64'(Modulus));
    end else if (64'(sum) >= 64'd2 * 64'(Modulus)) begin
      cycles  = 2'd2;
      phase_d = PhaseBits'(64'(sum) - 64'd2 * 64'(Modulus));
    end else if (sum >= PhaseBits'(Modulus)) begin
      cycles  = 2'd1;
      phase_d = sum - PhaseBits'(Modulus);
    end
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      phase_q <= '0;
      count_q <= '0;
    end else if (restart_i) begin
      phase_q <= '0;
      count_q <= '0;
    end else if (!full) begin
      phase_q <= phase_d;
      count_q <= count_q + Width'(cycles);
    end
  end

  assign past_o = count_q >= limit_i;

endmodule

`default_nettype wire
