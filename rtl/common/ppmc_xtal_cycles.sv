// SPDX-License-Identifier: Apache-2.0
// ppmc_xtal_cycles: outputs the number of crystal cycles that end in each clock cycle. The sum has no
//         drift.
// Rules:  P104-GEN-02/03.
// Timing: after a restart at edge e, the sum of cycles_o over the next n cycles is floor(n * XtalHz / ClkHz).
`default_nettype none

module ppmc_xtal_cycles #(
    parameter int unsigned ClkHz  = 16_000_000,  // at least XtalHz / 3
    parameter int unsigned XtalHz = 16_000_000
) (
    input  wire logic       clk_i,
    input  wire logic       rst_ni,
    input  wire logic       restart_i,  // strobe: restart the count at the next edge
    output logic      [1:0] cycles_o    // crystal cycles that end in this cycle, 0 .. 3
);

  localparam longint unsigned Common = ppmc_pkg::gcd(64'(ClkHz), 64'(XtalHz));
  localparam int unsigned Modulus = 32'(64'(ClkHz) / Common);
  localparam int unsigned Step = 32'(64'(XtalHz) / Common);
  localparam int unsigned PhaseBits = ppmc_pkg::cnt_width(Modulus + Step);

  if (3 * Modulus < Step) begin : g_check
    $fatal(1, "ppmc_xtal_cycles: at most three crystal cycles per clock cycle");
  end

  if (Modulus == Step) begin : g_same
    logic unused_inputs;

    assign unused_inputs = &{1'b0, clk_i, rst_ni, restart_i, PhaseBits'(0)};
    assign cycles_o = 2'd1;
  end else begin : g_phase
    logic [PhaseBits-1:0] sum, phase_d, phase_q;

    always_comb begin
      sum      = phase_q + PhaseBits'(Step);
      cycles_o = 2'd0;
      phase_d  = sum;
      if (Step > 2 * Modulus && 64'(sum) >= 64'd3 * 64'(Modulus)) begin
        cycles_o = 2'd3;
        phase_d  = PhaseBits'(64'(sum) - 64'd3 * 64'(Modulus));
      end else if (64'(sum) >= 64'd2 * 64'(Modulus)) begin
        cycles_o = 2'd2;
        phase_d  = PhaseBits'(64'(sum) - 64'd2 * 64'(Modulus));
      end else if (sum >= PhaseBits'(Modulus)) begin
        cycles_o = 2'd1;
        phase_d  = sum - PhaseBits'(Modulus);
      end
    end

    always_ff @(posedge clk_i or negedge rst_ni) begin
      if (!rst_ni) phase_q <= '0;
      else phase_q <= restart_i ? '0 : phase_d;
    end
  end

endmodule

`default_nettype wire
