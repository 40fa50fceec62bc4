// SPDX-License-Identifier: Apache-2.0
// ppmc_base_clock: internal base clock of an interval, counted in quanta from the pulse that begins the
//         interval.
// Rules:  P104-BCK-01 (period), P104-INT-01/02 (extra time before the first period of each interval).
// Timing: tick_o is combinational: it is high in the cycle of a quantum_i.
`default_nettype none

module ppmc_base_clock #(
    parameter int unsigned FastQuanta  = 8,   // period of the fast base clock in quanta
    parameter int unsigned SlowQuanta  = 32,  // period of the slow base clock in quanta
    parameter int unsigned ExtraQuanta = 30   // extra time of an interval in quanta; only with extra_i = 1
) (
    input  wire logic clk_i,
    input  wire logic rst_ni,
    input  wire logic restart_i,  // strobe: a pulse; a new interval begins at the next edge
    input  wire logic quantum_i,  // strobe: quantum tick
    input  wire logic slow_i,     // 1: slow base clock; stable during an operation
    input  wire logic extra_i,    // 1: each interval begins with the extra time
    output logic      tick_o      // strobe: a period of the base clock ends
);

  localparam int unsigned Slower = (SlowQuanta > FastQuanta) ? SlowQuanta : FastQuanta;
  localparam int unsigned Longest = (Slower > ExtraQuanta) ? Slower : ExtraQuanta;
  localparam int unsigned Width = ppmc_pkg::cnt_width(Longest - 1);

  logic [Width-1:0] left_q, reload;  // left_q: remaining quanta - 1; reload: next start value of left_q
  logic extra_q;  // 1: the extra time is running
  logic last_q;  // 1: the next quantum ends the period
  logic ends;

  assign ends   = quantum_i && last_q;
  assign tick_o = ends && !extra_q;

  always_comb begin
    reload = slow_i ? Width'(SlowQuanta - 1) : Width'(FastQuanta - 1);
    if (restart_i && extra_i) reload = Width'(ExtraQuanta - 1);
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      extra_q <= 1'b0;
      last_q  <= 1'b0;
    end else if (restart_i || ends) begin
      extra_q <= restart_i && extra_i;
      last_q  <= reload == '0;
    end else if (quantum_i) begin
      last_q <= left_q == Width'(1);
    end
  end

  // No reset: the first pulse of a motion sets left_q.
  always_ff @(posedge clk_i) begin
    if (restart_i || ends) left_q <= reload;
    else if (quantum_i) left_q <= Width'(ppmc_pkg::dec(32'(left_q)));
  end

endmodule

`default_nettype wire
