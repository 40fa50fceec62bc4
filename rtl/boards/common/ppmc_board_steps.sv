// SPDX-License-Identifier: Apache-2.0
// ppmc_board_steps: derives pulse and direction for the pulse counter from the phase pins of a device that
//         has no pulse output.
// Rules:  docs/stmc/README.md, 11.1: the block recognises 3, 4 or 5 phases, full or half steps, and both
//         polarities without a setting. It ignores patterns with all phases at one level (chopper, before
//         the first initialisation).
// Timing: pout_no is low for one cycle, two cycles after a step. dir_o changes in the same cycle.
// Assumes: all bits of s_i change at the same edge.
`default_nettype none

module ppmc_board_steps (
    input  wire logic       clk_i,
    input  wire logic       rst_ni,   // reset of the device; the first pattern after it is no step
    input  wire logic [5:1] s_i,
    output logic            pout_no,
    output logic            dir_o     // 0: CW, 1: CCW
);

  logic [5:1] now_q, last_q;

  function automatic logic at_most_two(logic [5:1] pins);
    logic [2:0] count;
    count = '0;
    for (int n = 1; n <= 5; n++) count += 3'(pins[n]);
    return count <= 3'd2;
  endfunction

  // The smaller group of equal pins is assumed to be the energised phases. Then, for 3, 4 or 5 phases,
  // adjacent patterns share exactly one energised phase. Only 5-phase motors have half steps between 2 and
  // 3 energised phases. For such a step, either group gives the correct direction.
  function automatic logic is_clockwise(logic [5:1] prev, logic [5:1] next);
    logic [5:1] a, b, from, to, changed;
    changed = prev ^ next;
    if (at_most_two(prev) != at_most_two(next)) begin
      if ((changed & next) != '0) return (changed & {prev[4:1], prev[5]}) != '0;
      return (changed & {next[1], next[5:2]}) != '0;
    end
    a    = at_most_two(prev) ? prev : ~prev;
    b    = at_most_two(next) ? next : ~next;
    to   = b & ~a;
    from = a & b;
    if (to == '0) begin
      to   = a & b;
      from = a & ~b;
    end
    // 1 if the step goes to the next higher phase, or from the last phase to the first. The expression is
    // correct for any number of phases.
    return to == {from[4:1], 1'b0} || (to < from && to != {1'b0, from[5:2]});
  endfunction

  logic energised, step;

  assign energised = now_q != '0 && now_q != '1;
  assign step      = energised && last_q != '0 && last_q != now_q;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      now_q   <= '0;
      last_q  <= '0;
      pout_no <= 1'b1;
      dir_o   <= 1'b0;
    end else begin
      now_q   <= s_i;
      pout_no <= !step;
      if (energised) last_q <= now_q;
      if (step) dir_o <= !is_clockwise(last_q, now_q);
    end
  end

endmodule

`default_nettype wire
