// SPDX-License-Identifier: Apache-2.0
// ppmc2104_setup: stores the settings that the host makes for one axis: initial setting, switching times and
//         hold delay.
// Rules:  P2104-INI-04..07, P2104-AUX-01/04..06, P2104-PHS-03, P2104-SW-01/02.
// Timing: the actions of act_i take effect in setup_o at the next rising edge. phase_init_o depends
//         on act_i combinationally, chop_o on ready_i.
`default_nettype none

module ppmc2104_setup
  import ppmc2104_pkg::*;
(
    input  wire logic                clk_i,
    input  wire logic                rst_ni,
    input  wire axis_action_t        act_i,          // actions of this axis, effective at the next edge
    input  wire init_code_t          code_i,         // setting code of act_i.init
    input  wire logic         [31:0] params_i,       // data bytes of act_i.init
    input  wire logic         [31:0] params_late_i,  // data bytes of act_i.switching and act_i.hold_delay
    input  wire logic                ready_i,        // 0: table build or processing time in progress
    output setup_t                   setup_o,        // current settings
    output logic                     phase_init_o,   // strobe: set the phases to index 0
    output logic                     chop_o          // 1: chop at standstill
);

  logic first_q;  // 1: the first initial setting (made in state INITIAL) is in progress
  logic unused_bits;

  assign unused_bits = &{1'b0, act_i, code_i, params_i, params_late_i};
  assign phase_init_o = act_i.init && !setup_o.initialised;
  assign chop_o = setup_o.chop && setup_o.initialised && (ready_i || !first_q);

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      setup_o.initialised <= 1'b0;
      setup_o.slow        <= '0;
      setup_o.fast        <= '0;
      setup_o.steps       <= '0;
      setup_o.chop        <= 1'b0;
      setup_o.external    <= 1'b0;
      setup_o.half        <= 1'b0;
      setup_o.motor       <= '0;
      setup_o.on          <= CHOP_ON_DEFAULT;
      setup_o.off         <= CHOP_OFF_DEFAULT;
      setup_o.hold_delay  <= HOLD_DEFAULT;
      first_q             <= 1'b0;
    end else begin
      if (act_i.init) begin
        setup_o.slow  <= params_i[7:0];
        setup_o.fast  <= params_i[15:8];
        setup_o.steps <= params_i[16+:STEP_BITS];
      end
      // Only the first setting writes these fields. They then keep their values until Excitation OFF.
      if (phase_init_o) begin
        setup_o.chop     <= code_i.chop;
        setup_o.external <= code_i.external;
        setup_o.half     <= code_i.half;
        setup_o.motor    <= code_i.motor;
      end
      if (act_i.init || act_i.exc_off) setup_o.initialised <= act_i.init;
      first_q <= phase_init_o || (first_q && !ready_i);
      if (act_i.switching) begin
        setup_o.on  <= params_late_i[23:16];
        setup_o.off <= params_late_i[31:24];
      end
      if (act_i.hold_delay) setup_o.hold_delay <= params_late_i[31:24];
    end
  end

endmodule

`default_nettype wire
