// SPDX-License-Identifier: Apache-2.0
// ppmc_hold_timer: asserts hold_o when the motor has been at standstill for the hold time. This time is
//         fixed, or a number of units set by the host.
// Rules:  P104-END-08, P104-DS-09, P2104-END-07, P2104-AUX-05; STMC-HLD-01.
// Timing: hold_o is deasserted one cycle after busy_i rises. The fall of busy_i starts a count of quantum
//         ticks. hold_o is asserted 1 + RestCycles cycles after tick number n of this count. n is Quanta, or
//         Quanta * (units_i + 1) if UnitBits is not 0. units_i is sampled while busy_i is high.
`default_nettype none

module ppmc_hold_timer #(
    parameter int unsigned Quanta = 136_000,  // quantum ticks; 34 ms at 16 MHz
    parameter int unsigned RestCycles = 0,  // cycles added to the quanta; less than one quantum
    // Bits of units_i; 0: the hold time is fixed. If UnitBits is not 0, Quanta must be a power of 2.
    parameter int unsigned UnitBits = 0,
    localparam int unsigned UnitTop = (UnitBits == 0) ? 0 : UnitBits - 1
) (
    input  wire logic             clk_i,
    input  wire logic             rst_ni,
    input  wire logic             busy_i,     // 1: a motion is in progress
    input  wire logic             quantum_i,  // strobe: quantum tick, restarted by the fall of busy_i
    input  wire logic [UnitTop:0] units_i,    // hold time in units, minus 1
    output logic                  hold_o      // high: at standstill for at least the hold time; 1 after reset
);

  logic done;

  if (UnitBits == 0) begin : g_fixed
    logic counted, unused_units;

    assign unused_units = &{1'b0, units_i};

    if (Quanta == 0) begin : g_none
      assign counted = 1'b1;
    end else begin : g_some
      ppmc_delay #(
          .Ticks(Quanta)
      ) u_quanta (
          .clk_i,
          .restart_i(busy_i),
          .tick_i   (quantum_i),
          .past_o   (counted)
      );
    end

    if (RestCycles == 0) begin : g_whole
      assign done = counted;
    end else begin : g_rest
      localparam int unsigned RestBits = ppmc_pkg::cnt_width(RestCycles);

      logic [RestBits-1:0] rest_q;

      assign done = counted && rest_q == '0;

      always_ff @(posedge clk_i) begin
        if (busy_i) rest_q <= RestBits'(RestCycles);
        else if (counted && rest_q != '0) rest_q <= rest_q - 1'b1;
      end
    end
  end else begin : g_units
    localparam int unsigned Scale = $clog2(Quanta);

    if (Quanta != 1 << Scale || Scale == 0) begin : g_check
      $fatal(1, "ppmc_hold_timer: a unit must be a power of two of quanta");
    end

    logic [UnitBits-1:0] units_q;  // units that remain after the current unit
    logic [Scale-1:0] scale_q;  // elapsed quanta of the current unit
    logic done_q;

    assign done = done_q;

    always_ff @(posedge clk_i) begin
      if (busy_i) begin
        scale_q <= '0;
        units_q <= units_i;
        done_q  <= 1'b0;
      end else if (quantum_i && !hold_o) begin
        scale_q <= scale_q + 1'b1;
        if (&scale_q) {done_q, units_q} <= {1'b0, units_q} - 1'b1;
      end
    end
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) hold_o <= 1'b1;
    else if (busy_i || done) hold_o <= !busy_i;
  end

endmodule

`default_nettype wire
