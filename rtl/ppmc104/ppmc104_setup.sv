// SPDX-License-Identifier: Apache-2.0
// ppmc104_setup: what the host has set: initialisation, switching parameters, auxiliary outputs.
// Rules:  P104-INI-01/05/06/08, P104-AUX-01..06, P104-SW-04, P104-PHS-02/05.
// Timing: everything changes at the edge that ends the cycle of its action; auxo_o and aux_no are pins.
`default_nettype none

module ppmc104_setup
  import ppmc104_pkg::*;
#(
    parameter bit PhaseIdle = 1'b1  // level of the phases until the first initialisation
) (
    input  wire logic              clk_i,
    input  wire logic              rst_ni,
    input  wire action_t           act_i,
    input  wire init_code_t        code_i,         // with act_i.init
    input  wire logic       [31:0] params_i,       // with act_i.init and act_i.switching
    input  wire logic       [ 3:0] aux_i,          // with act_i.aux_out
    input  wire logic              home_i,         // phases go to index 0 for the first time
    input  wire logic              positive_i,     // with home_i
    input  wire logic              ready_i,        // the initialisation is complete
    input  wire logic              vsel_i,         // synchronous level
    output setup_t                 setup_o,
    output logic                   initialised_o,
    output logic            [ 3:0] auxo_o,
    output logic                   aux_no
);

  logic chop_next_q, programmed_q, first;
  logic unused_bits;

  assign unused_bits = &{1'b0, act_i, code_i, params_i};
  assign first = act_i.init && !initialised_o;

  // What is frozen until Excitation OFF is taken from the first initialisation only.
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      setup_o.slow     <= '0;
      setup_o.fast     <= '0;
      setup_o.steps    <= '0;
      setup_o.external <= 1'b0;
      setup_o.chop     <= 1'b0;
      setup_o.positive <= !PhaseIdle;
      setup_o.half     <= 1'b0;
      setup_o.motor    <= '0;
      chop_next_q      <= 1'b0;
      initialised_o    <= 1'b0;
    end else begin
      if (act_i.init) begin
        setup_o.slow     <= params_i[7:0];
        setup_o.fast     <= params_i[15:8];
        setup_o.steps    <= params_i[16+:STEP_BITS];
        setup_o.external <= code_i.external;
        chop_next_q      <= code_i.chop;
      end
      if (first) begin
        setup_o.half  <= code_i.half;
        setup_o.motor <= code_i.motor;
      end
      if (home_i) setup_o.positive <= positive_i;
      if (ready_i) begin
        initialised_o <= 1'b1;
        setup_o.chop  <= chop_next_q;
      end
      if (act_i.exc_off) begin
        initialised_o <= 1'b0;
        setup_o.chop  <= 1'b0;
      end
    end
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      programmed_q      <= 1'b0;
      setup_o.on_units  <= '0;
      setup_o.off_units <= '0;
      auxo_o            <= '1;
      aux_no            <= 1'b1;
    end else begin
      if (act_i.switching) begin
        programmed_q      <= 1'b1;
        setup_o.on_units  <= params_i[23:16];
        setup_o.off_units <= params_i[31:24];
      end
      if (act_i.aux_out) auxo_o <= ~aux_i;
      if (act_i.aux_on || act_i.aux_off) aux_no <= act_i.aux_off;
    end
  end

  // The fixed part of the chopper's times; the chopper samples it with the beginning of each phase.
  always_comb begin
    setup_o.on_base  = vsel_i ? 9'(CHOP_ON_VSEL_H) : 9'(CHOP_ON_VSEL_L);
    setup_o.off_base = vsel_i ? 9'(CHOP_OFF_VSEL_H) : 9'(CHOP_OFF_VSEL_L);
    if (!programmed_q) begin
      setup_o.on_base  = 9'(CHOP_ON_DEFAULT);
      setup_o.off_base = 9'(CHOP_OFF_DEFAULT);
    end
  end

endmodule

`default_nettype wire
