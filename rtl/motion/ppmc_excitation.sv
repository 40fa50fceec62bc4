// SPDX-License-Identifier: Apache-2.0
// ppmc_excitation: pattern of the energised phases of 3-, 4- and 5-phase motors, for full and half steps.
// Rules:  P104-PHS-01..06 (tables: docs/ppmc104/README.md, 10.1; P104-PHS-03/05: index 0 and phases off).
// Timing: pattern_o changes at the edge that ends the cycle of phase_init_i, off_i or step_i.
// How:    see ppmc_motion_pkg.
`include "ppmc_assert.svh"
`default_nettype none

module ppmc_excitation
  import ppmc_motion_pkg::*;
(
    input  wire logic         clk_i,
    input  wire logic         rst_ni,
    input  wire motor_e       motor_i,       // number of phases
    input  wire logic         half_i,        // 1: half step
    input  wire logic         phase_init_i,  // strobe: set the phases to index 0 (S1 and S2 on)
    input  wire logic         off_i,         // strobe: switch all phases off until phase_init_i
    input  wire logic         step_i,        // strobe: make one step
    input  wire logic         ccw_i,         // 1: step to the previous index, 0: to the next index
    output logic        [5:1] pattern_o      // 1: energised
);

  logic two_phases_q;  // 1: two adjacent phases are on (even index of the half-step table)

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      pattern_o <= '0;
      two_phases_q    <= 1'b1;
    end else if (phase_init_i || off_i) begin
      pattern_o <= {3'b000, {2{phase_init_i}}};
      two_phases_q    <= 1'b1;
    end else if (step_i) begin
      pattern_o <= next_phases(pattern_o, two_phases_q, half_i, motor_i, ccw_i);
      two_phases_q    <= two_phases_q ^ half_i;
    end
  end

`ifndef SYNTHESIS
  logic [2:0] count;
  assign count = 3'($countones(pattern_o));
  `PPMC_ASSERT(p104_phs_two_phases, !two_phases_q || count == 3'd2 || count == 3'd0)
  `PPMC_ASSERT(p104_phs_odd, two_phases_q || count == 3'd0 || count == ((motor_i == Motor5) ? 3'd3 : 3'd1))
  `PPMC_ASSERT(p104_phs_unused3, motor_i != Motor3 || pattern_o[5:4] == 2'b00)
  `PPMC_ASSERT(p104_phs_unused4, motor_i != Motor4 || !pattern_o[5])
`endif

endmodule

`default_nettype wire
