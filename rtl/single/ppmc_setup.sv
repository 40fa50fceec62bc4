// SPDX-License-Identifier: Apache-2.0
// ppmc_setup: settings that an initialisation makes in a single-axis device, except the ramp
//         (ppmc_ramp_table).
// Rules:  P104-INI-01/05/06/08, P104-PHS-02/05; STMC-INI-04/06, STMC-CHP-02.
// Timing: all outputs are registered. They change at the edge that ends the cycle of init_i, phase_init_i,
//         ready_i or off_i.
`default_nettype none

module ppmc_setup
  import ppmc_code_pkg::*;
#(
    parameter bit PhaseIdle = 1'b1  // level of the phases until the first initialisation
) (
    input  wire logic       clk_i,
    input  wire logic       rst_ni,
    input  wire logic       init_i,        // strobe: an initialisation is accepted
    input  wire init_code_t code_i,        // initialisation code; valid with init_i
    input  wire logic       phase_init_i,  // strobe: set the phases to index 0; first initialisation only
    input  wire logic       positive_i,    // 1: high = energised; valid with phase_init_i
    input  wire logic       ready_i,       // strobe: the initialisation is complete
    input  wire logic       off_i,         // strobe: return to the state before an initialisation
    output setup_t          setup_o,       // current settings
    output logic            initialised_o  // 1: operations may start
);

  logic chop_next_q, first;
  logic unused_bits;

  assign unused_bits = &{1'b0, code_i};
  assign first = init_i && !initialised_o;

  // Only the first initialisation loads half, motor and positive, which then do not change until Excitation
  // OFF. Every initialisation loads external and chop.
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      setup_o.external <= 1'b0;
      setup_o.chop     <= 1'b0;
      setup_o.positive <= !PhaseIdle;
      setup_o.half     <= 1'b0;
      setup_o.motor    <= '0;
      chop_next_q      <= 1'b0;
      initialised_o    <= 1'b0;
    end else begin
      if (init_i) begin
        setup_o.external <= code_i.external;
        chop_next_q      <= code_i.chop;
      end
      if (first) begin
        setup_o.half  <= code_i.half;
        setup_o.motor <= code_i.motor;
      end
      if (phase_init_i) setup_o.positive <= positive_i;
      if (ready_i) begin
        initialised_o <= 1'b1;
        setup_o.chop  <= chop_next_q;
      end
      if (off_i) begin
        initialised_o <= 1'b0;
        setup_o.chop  <= 1'b0;
      end
    end
  end

endmodule

`default_nettype wire
