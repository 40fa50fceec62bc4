// SPDX-License-Identifier: Apache-2.0
// ppmc_base_clock: internal base clock of one interval, counted in quanta from the pulse that began the
//         interval.
// Rules:  P104-BCK-01 (period), P104-INT-01/02 (extra time before the first period of every interval).
// Timing: tick_o is combinational from quantum_i, in the same cycle.
`default_nettype none

module ppmc_base_clock #(
    parameter int unsigned FastQuanta  = 8,   // period of the fast base clock, quanta
    parameter int unsigned SlowQuanta  = 32,  // period of the slow base clock, quanta
    parameter int unsigned ExtraQuanta = 30   // extra time of an interval with extra_i, quanta
) (
    input  wire logic clk_i,
    input  wire logic rst_ni,
    input  wire logic restart_i,  // a pulse: a new interval begins at the next edge
    input  wire logic quantum_i,  // quantum tick
    input  wire logic slow_i,     // 1 = slow base clock; stable during an operation
    input  wire logic extra_i,    // 1 = begin each interval with the extra time
    output logic      tick_o      // a base clock period has ended
);

  localparam int unsigned Slower = (SlowQuanta > FastQuanta) ? SlowQuanta : FastQuanta;
  localparam int unsigned Longest = (Slower > ExtraQuanta) ? Slower : ExtraQuanta;
  localparam int unsigned Width = ppmc_pkg::cnt_width(Longest - 1);

  logic [Width-1:0] left_q, reload;  // left_q: remaining quanta minus 1; reload: its next start value
  logic extra_q;  // the extra time is running
  logic last_q;  // the next quantum ends the period
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

  // No reset, because the first pulse of a motion restarts left_q.
  always_ff @(posedge clk_i) begin
    if (restart_i || ends) left_q <= reload;
    else if (quantum_i) left_q <= Width'(ppmc_pkg::dec(32'(left_q)));
  end

endmodule

`default_nettype wire
