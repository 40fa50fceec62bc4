// SPDX-License-Identifier: Apache-2.0
// ppmc_bank_interval_rom_fv: proves that each word of the table is the remainder of its interval, with the times of
// the PPMC-104.
`include "ppmc_fv.svh"
`default_nettype none

module ppmc_bank_interval_rom_fv
  import ppmc_bank_pkg::*;
(
    input wire logic  clk_i,
    input wire pace_t pace_i
);

  localparam int unsigned Quantum = 1, Round = 8, TimeBits = 14;  // cycles

  logic [TimeBits-1:0] rest_o;

  `FV_RESET

  ppmc_bank_interval_rom #(
      .Quantum (Quantum),
      .Round   (Round),
      .TimeBits(TimeBits)
  ) dut (
      .*
  );

  // A base clock lasts 8 quanta (fast) or 32 (slow). With extra (vsel = L) an interval is 30 quanta longer.
  // The low time is 20 quanta; with the fast base clock, without extra and at rates 0 to 2 it is half the
  // interval.
  pace_t before_q, was_q;
  logic [1:0] known_q;  // both registers of the block are filled
  logic [TimeBits-1:0] bases, whole, low;

  assign bases = TimeBits'({1'b0, was_q.rate} + 9'd1);
  assign whole = (was_q.slow ? bases << 5 : bases << 3) + (was_q.extra ? TimeBits'(30) : '0);
  assign low   = (!was_q.slow && !was_q.extra && was_q.rate <= 8'd2) ? whole >> 1 : TimeBits'(20);

  always_ff @(posedge clk_i) begin
    {was_q, before_q} <= {before_q, pace_i};
    known_q           <= {known_q[0] && rst_ni, rst_ni};
  end

  `FV_ASSERT(p104_int_01_rest, !known_q[1] || rest_o == whole - low - TimeBits'(Round))
  `FV_COVER(seen_the_longest, known_q[1] && rest_o == TimeBits'(256 * 32 + 30 - 20 - Round))

endmodule

`default_nettype wire
