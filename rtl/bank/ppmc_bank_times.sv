// SPDX-License-Identifier: Apache-2.0
// ppmc_bank_times: how long an interval lasts after its low time; one word for each pace, nothing is multiplied.
// Rules:  P104-BCK-01/03, P104-INT-01/02, P104-TIM-05 (a), BANK-GEN-02.
// Timing: rest_o stands two clk after pace_i.
`default_nettype none

module ppmc_bank_times
  import ppmc_bank_pkg::*;
#(
    parameter int unsigned Quantum  = 25,  // clk
    parameter int unsigned Round    = 32,  // clk
    parameter int unsigned TimeBits = 20
) (
    input  wire logic                 clk_i,
    input  wire pace_t                pace_i,  // down does not count
    output logic       [TimeBits-1:0] rest_o   // clk from the end of the low time to the next pulse, - Round
);

  // i: slow, extra, rate.
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
