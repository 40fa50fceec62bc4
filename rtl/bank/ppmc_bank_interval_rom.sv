// SPDX-License-Identifier: Apache-2.0
// ppmc_bank_interval_rom: returns the time from the end of the low time of a pulse until the next pulse. The
//         ROM has one word for each combination of base clock, extra time and rate, so that no multiplier is
//         needed.
// Rules:  P104-BCK-01/03, P104-INT-01/02, P104-TIM-05 (internal base clock), BANK-GEN-02.
// Timing: after_low_o is valid two cycles after interval_i.
`default_nettype none

module ppmc_bank_interval_rom
  import ppmc_bank_pkg::*;
#(
    parameter int unsigned Quantum  = 25,  // quantum (4 crystal cycles) in clock cycles
    parameter int unsigned Round    = 32,  // time between two visits of an axis (a round) in cycles
    parameter int unsigned TimeBits = 20
) (
    input wire logic clk_i,
    input wire interval_t interval_i,  // interval; the field decel is not used
    output logic [TimeBits-1:0] after_low_o  // cycles from end of low time to next pulse, minus Round
);

  // Word at address i = {slow_base, extra_time, rate}: cycles from the end of the low time to the next
  // pulse, minus Round.
  function automatic int unsigned after_low(int unsigned i);
    int unsigned rate, interval, low;
    rate     = i % 256;
    interval = Quantum * ((rate + 1) * (i >= 512 ? 32 : 8) + (i / 256 % 2 != 0 ? 30 : 0));
    low      = (i < 256 && rate < 3) ? interval / 2 : 20 * Quantum;
    return interval - low - Round;
  endfunction

  (* ram_style = "block" *)
  logic [TimeBits-1:0] rom[1024];
  logic [TimeBits-1:0] read_q;
  logic unused_down;

  initial for (int unsigned i = 0; i < 1024; i++) rom[i] = TimeBits'(after_low(i));

  assign unused_down = interval_i.decel;

  always_ff @(posedge clk_i) begin
    read_q <= rom[{interval_i.slow_base, interval_i.extra_time, interval_i.rate}];
    after_low_o <= read_q;
  end

endmodule

`default_nettype wire
