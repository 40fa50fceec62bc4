// SPDX-License-Identifier: Apache-2.0
// ppmc_bank_interval_rom_fv: proves that each word of the ROM is the time from the end of the low time to
// the end of the interval, with the times of the PPMC-104.
`include "ppmc_fv.svh"
`default_nettype none

module ppmc_bank_interval_rom_fv
  import ppmc_bank_pkg::*;
(
    input wire logic clk_i,
    input wire interval_t interval_i
);

  localparam int unsigned Quantum = 1, Round = 8, TimeBits = 14;  // Quantum and Round in cycles

  logic [TimeBits-1:0] after_low_o;

  `FV_RESET

  ppmc_bank_interval_rom #(
      .Quantum (Quantum),
      .Round   (Round),
      .TimeBits(TimeBits)
  ) dut (
      .*
  );

  // A period of the base clock has 8 quanta (fast) or 32 quanta (slow). With extra_time = 1 (vsel low), an
  // interval has 30 more quanta. The low time has 20 quanta. Exception: with the fast base clock, extra_time
  // = 0 and a rate of 0 to 2, the low time is half of the interval.
  interval_t interval_q, interval_q2;
  logic [1:0] valid_q;  // 1: the registers of the block are filled
  logic [TimeBits-1:0] base_clocks, interval_cycles, low_cycles;

  assign base_clocks = TimeBits'({1'b0, interval_q2.rate} + 9'd1);
  assign interval_cycles = (interval_q2.slow_base ? base_clocks << 5 : base_clocks << 3)
      + (interval_q2.extra_time ? TimeBits'(30) : '0);
  assign low_cycles = (!interval_q2.slow_base && !interval_q2.extra_time && interval_q2.rate <= 8'd2)
      ? interval_cycles >> 1 : TimeBits'(20);

  always_ff @(posedge clk_i) begin
    {interval_q2, interval_q} <= {interval_q, interval_i};
    valid_q                   <= {valid_q[0] && rst_ni, rst_ni};
  end

  `FV_ASSERT(p104_int_01_after_low,
             !valid_q[1] || after_low_o == interval_cycles - low_cycles - TimeBits'(Round))
  `FV_COVER(seen_longest, valid_q[1] && after_low_o == TimeBits'(256 * 32 + 30 - 20 - Round))

endmodule

`default_nettype wire
