// SPDX-License-Identifier: Apache-2.0
// ppmc_motor_port: drives the motor pins of one axis: phases with polarity and chopping, POUT, DIR and
//         HOLD.
// Rules:  P104-TIM-04 (pulse and phases change on the same edge), P104-PHS-01..07, P104-SW-01..07,
//         P104-PORT-02, P104-END-08.
// Timing: every pin is a register and follows the axis by one cycle. Therefore all pins of an event change
//         at the same edge.
`default_nettype none

module ppmc_motor_port
  import ppmc_motion_pkg::*;
#(
    parameter int unsigned HoldQuanta = 136_000,
    parameter int unsigned HoldRestCycles = 0,  // cycles added to the hold time
    parameter int unsigned HoldBits = 0,  // bits of hold_units_i; 0: the hold time is fixed
    parameter int unsigned UnitQuanta = 12,
    parameter int unsigned BaseBits = 9,
    // Level of s_o in reset. Until the first phase_init_i, positive_i must be !PhaseIdle.
    parameter bit PhaseIdle = 1'b1,
    localparam int unsigned HoldTop = (HoldBits == 0) ? 0 : HoldBits - 1
) (
    input  wire logic                  clk_i,
    input  wire logic                  rst_ni,
    // axis
    input  wire logic                  busy_i,          // 1: a motion is in progress
    input  wire logic                  low_i,           // 1: a pulse is active
    input  wire logic                  step_i,          // strobe: a pulse that steps the phases
    input  wire logic                  ccw_i,           // direction, 1: CCW
    input  wire logic                  quantum_i,       // strobe: quantum tick
    // excitation
    input  wire motor_e                motor_i,         // number of phases
    input  wire logic                  half_i,          // 1: half step
    input  wire logic                  positive_i,      // 1: high = energised; stable while energised
    input  wire logic                  phase_init_i,    // strobe: set the phases to index 0
    input  wire logic                  off_i,           // strobe: switch the phases off until phase_init_i
    // chopper
    input  wire logic                  chop_i,          // 1: chop at standstill
    input  wire logic                  chop_restart_i,  // strobe: begin a complete ON phase
    input  wire logic   [BaseBits-1:0] on_base_i,       // base time of the ON phase in quanta
    input  wire logic   [BaseBits-1:0] off_base_i,      // base time of the OFF phase in quanta
    input  wire logic   [         7:0] on_units_i,      // number of units added to on_base_i
    input  wire logic   [         7:0] off_units_i,     // number of units added to off_base_i
    input  wire logic   [   HoldTop:0] hold_units_i,    // hold time in units, minus 1
    // state of the pins, as the host reads it
    output logic        [         5:1] levels_o,        // phases with the polarity of the pins, not chopped
    // pins
    output logic        [         5:1] s_o,             // phases
    output logic                       hold_o,          // high: at standstill for at least the hold time
    output logic                       pout_no,         // pulse, active low
    output logic                       dir_o            // 0: CW, 1: CCW
);

  logic [5:1] pattern, invert;
  logic on;

  assign invert   = {5{!positive_i}};
  assign levels_o = pattern ^ invert;

  ppmc_excitation u_excitation (
      .clk_i,
      .rst_ni,
      .motor_i,
      .half_i,
      .phase_init_i,
      .off_i,
      .step_i,
      .ccw_i,
      .pattern_o(pattern)
  );

  ppmc_chopper #(
      .UnitQuanta(UnitQuanta),
      .BaseBits  (BaseBits)
  ) u_chopper (
      .clk_i,
      .rst_ni,
      .run_i    (chop_i && !busy_i),
      .restart_i(chop_restart_i),
      .quantum_i,
      .on_base_i,
      .off_base_i,
      .on_units_i,
      .off_units_i,
      .on_o     (on)
  );

  ppmc_hold_timer #(
      .Quanta(HoldQuanta),
      .RestCycles(HoldRestCycles),
      .UnitBits(HoldBits)
  ) u_hold (
      .clk_i,
      .rst_ni,
      .busy_i,
      .quantum_i,
      .units_i(hold_units_i),
      .hold_o
  );

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      s_o     <= {5{PhaseIdle}};
      pout_no <= 1'b1;
      dir_o   <= 1'b0;
    end else begin
      s_o     <= (pattern & {5{on}}) ^ invert;
      pout_no <= !low_i;
      dir_o   <= ccw_i;
    end
  end

endmodule

`default_nettype wire
