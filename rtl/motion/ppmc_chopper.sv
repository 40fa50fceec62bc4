// SPDX-License-Identifier: Apache-2.0
// ppmc_chopper: switches the phases of a motor on and off at standstill.
// Rules:  P104-SW-01..06, P104-AUX-03. An ON or OFF phase lasts base + UnitQuanta * units quanta. The block
//         loads the base and the units of a phase from its inputs when this phase begins.
// Timing: on_o changes at the edge that ends the cycle of a quantum tick. restart_i acts at the next edge.
//         While run_i = 0, on_o is 1 (combinational).
`default_nettype none

module ppmc_chopper #(
    parameter int unsigned UnitQuanta = 12,  // quanta per unit of the host's parameter; 0: no units
    parameter int unsigned BaseBits   = 9,
    parameter int unsigned UnitBits   = 8
) (
    input  wire logic                clk_i,
    input  wire logic                rst_ni,
    input  wire logic                run_i,        // 0: the phases stay on
    input  wire logic                restart_i,    // strobe: begin a complete ON phase at the next edge
    input  wire logic                quantum_i,    // strobe: quantum tick
    input  wire logic [BaseBits-1:0] on_base_i,    // base time of the ON phase in quanta, at least 1
    input  wire logic [BaseBits-1:0] off_base_i,   // base time of the OFF phase in quanta, at least 1
    input  wire logic [UnitBits-1:0] on_units_i,   // number of units added to on_base_i
    input  wire logic [UnitBits-1:0] off_units_i,  // number of units added to off_base_i
    output logic                     on_o          // 1: phases on
);

  localparam int unsigned UnitWidth = ppmc_pkg::cnt_width(UnitQuanta);
  localparam int unsigned CountBits = (BaseBits > UnitWidth) ? BaseBits : UnitWidth;

  logic [CountBits-1:0] left_q;  // remaining quanta of the base time or of the current unit
  logic [ UnitBits-1:0] units_q;  // remaining units of this phase
  logic on_q, next_on, part_ends, phase_ends;

  assign on_o = on_q || !run_i;

  always_comb begin
    part_ends  = quantum_i && left_q == CountBits'(1);
    phase_ends = part_ends && (UnitQuanta == 0 || units_q == '0);
    next_on    = restart_i || !run_i || !on_q;
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      left_q  <= '0;
      units_q <= '0;
      on_q    <= 1'b1;
    end else if (restart_i || !run_i || phase_ends) begin
      on_q    <= next_on;
      left_q  <= CountBits'(next_on ? on_base_i : off_base_i);
      units_q <= next_on ? on_units_i : off_units_i;
    end else if (part_ends) begin
      left_q  <= CountBits'(UnitQuanta);
      units_q <= UnitBits'(ppmc_pkg::dec(32'(units_q)));
    end else if (quantum_i) begin
      left_q <= CountBits'(ppmc_pkg::dec(32'(left_q)));
    end
  end

endmodule

`default_nettype wire
