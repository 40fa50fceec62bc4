// SPDX-License-Identifier: Apache-2.0
// ppmc_bank_interval_rom: duration of an interval after its low time; a ROM with one word for each base clock, extra
//         time and rate, so that no multiplier is needed.
// Rules:  P104-BCK-01/03, P104-INT-01/02, P104-TIM-05 (a), BANK-GEN-02.
// Timing: rest_o is valid two cycles after pace_i.
`default_nettype none

module ppmc_bank_interval_rom
  import ppmc_bank_pkg::*;
#(
    parameter int unsigned Quantum  = 25,  // quantum in cycles
    parameter int unsigned Round    = 32,  // round in cycles
    parameter int unsigned TimeBits = 20
) (
    input  wire logic                 clk_i,
    input  wire pace_t                pace_i,  // interval; down is not used
    output logic       [TimeBits-1:0] rest_o   // cycles from end of low time to next pulse, minus Round
);

  // Word at address i = {slow, extra, rate}.
  function automatic int unsigned rest(int unsigned i);
    int unsigned rate, interval, low;
    rate     = i % 256;
    interval = Quantum * ((rate + 1) * (i >= 512 ? 32 : 8) + (i / 256 % 2 != 0 ? 30 : 0));
    low      = (i < 256 && rate < 3) ? interval / 2 : 20 * Quantum;
    return interval - low - Round;
  endfunction

  (* ram_style = "block" *)
  logic [TimeBits-1:0] words[1024];
  logic [TimeBits-1:0] read_q;
  logic unused_down;

  initial for (int unsigned i = 0; i < 1024; i++) words[i] = TimeBits'(rest(i));

  assign unused_down = pace_i.down;

  always_ff @(posedge clk_i) begin
    read_q <= words[{pace_i.slow, pace_i.extra, pace_i.rate}];
    rest_o <= read_q;
  end

endmodule

`default_nettype wire
