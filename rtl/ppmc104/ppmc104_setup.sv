// SPDX-License-Identifier: Apache-2.0
// ppmc104_setup: stores the switching parameters and auxiliary outputs, which the host sets outside an
//         initialisation.
// Rules:  P104-AUX-01..06, P104-SW-04.
// Timing: the actions of act_i take effect at the next rising edge. chop_o also depends on vsel_i
//         combinationally. auxo_o and aux_no drive pins directly.
`default_nettype none

module ppmc104_setup
  import ppmc104_pkg::*;
  import ppmc_code_pkg::action_t;
  import ppmc_motion_pkg::chop_time_t;
(
    input  wire logic           clk_i,
    input  wire logic           rst_ni,
    input  wire action_t        act_i,     // actions, effective at the next rising edge
    input  wire logic    [31:0] params_i,  // parameters of act_i.switching
    input  wire logic    [ 3:0] aux_i,     // data of act_i.aux_out
    input  wire logic           vsel_i,    // VSEL, synchronised
    output chop_time_t          chop_o,    // chopper times
    output logic         [ 3:0] auxo_o,    // auxiliary outputs
    output logic                aux_no     // AUX output, active low
);

  logic programmed_q;
  logic [7:0] on_q, off_q;  // chopper times set by the host, in units
  logic unused_bits;

  assign unused_bits = &{1'b0, act_i, params_i};

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      programmed_q <= 1'b0;
      on_q         <= '0;
      off_q        <= '0;
      auxo_o       <= '1;
      aux_no       <= 1'b1;
    end else begin
      if (act_i.switching) begin
        programmed_q <= 1'b1;
        on_q         <= params_i[23:16];
        off_q        <= params_i[31:24];
      end
      if (act_i.aux_out) auxo_o <= ~aux_i;
      if (act_i.aux_on || act_i.aux_off) aux_no <= act_i.aux_off;
    end
  end

  // Fixed part of the chopper times. The chopper samples these values at the start of each phase.
  always_comb begin
    chop_o.on_units  = on_q;
    chop_o.off_units = off_q;
    chop_o.on_base   = vsel_i ? CHOP_ON_VSEL_H : CHOP_ON_VSEL_L;
    chop_o.off_base  = vsel_i ? CHOP_OFF_VSEL_H : CHOP_OFF_VSEL_L;
    if (!programmed_q) begin
      chop_o.on_base  = CHOP_ON_DEFAULT;
      chop_o.off_base = CHOP_OFF_DEFAULT;
    end
  end

endmodule

`default_nettype wire
