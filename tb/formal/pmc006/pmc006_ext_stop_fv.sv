// SPDX-License-Identifier: Apache-2.0
// pmc006_ext_stop_fv: proves the events and flags of the emergency switches.
`include "ppmc_fv.svh"
`default_nettype none

module pmc006_ext_stop_fv (
    input wire logic       clk_i,
    input wire logic [1:0] ext_i,
    input wire logic [1:0] rising_i,
    input wire logic [1:0] enable_i,
    input wire logic [1:0] clear_i
);

  logic event_o;
  logic [1:0] flags_o, before_q, edges;

  `FV_RESET

  pmc006_ext_stop dut (.*);

  always_ff @(posedge clk_i)
    if (!rst_ni) before_q <= '1;
    else before_q <= ext_i;

  for (genvar n = 0; n < 2; n++) begin : g_switch
    assign edges[n] = enable_i[n] && (rising_i[n] ? (ext_i[n] && !before_q[n]) : (!ext_i[n] && before_q[n]));
    `FV_ASSERT(p006_ext_01_sets, !$past(rst_ni && edges[n]) || flags_o[n])
    `FV_ASSERT(p006_ext_11_clears, !$past(rst_ni && clear_i[n] && !edges[n]) || !flags_o[n])
    `FV_ASSERT(p006_ext_11_stays, !$past(rst_ni && !clear_i[n] && !edges[n]) || flags_o[n] == $past(flags_o[n]
               ))
  end
  `FV_ASSERT(p006_ext_01_event, event_o == (edges != '0))
  `FV_COVER(seen_both, flags_o == 2'b11 && clear_i == 2'b01)

endmodule

`default_nettype wire
