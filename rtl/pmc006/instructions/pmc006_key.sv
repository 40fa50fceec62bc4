// SPDX-License-Identifier: Apache-2.0
// pmc006_key: time filter of one input: an event when it has been low long enough, armed anew when high.
// Rules:  P006-PRG-30, P006-EEP-20.
// Timing: hit_o and armed_o are combinational, in the clk of the µs tick that decides: number Ticks without
//         interruption.
`default_nettype none

module pmc006_key #(
    parameter int unsigned LowTicks  = 1001,
    parameter int unsigned HighTicks = 1001,  // to arm it again; 0: at once
    parameter bit          Armed     = 1'b0   // after reset
) (
    input  wire logic clk_i,
    input  wire logic rst_ni,
    input  wire logic us_i,    // one clk every microsecond
    input  wire logic pin_i,   // synchronised
    output logic      hit_o,   // low long enough: the event
    output logic      armed_o  // being armed
);

  localparam int unsigned Width = ppmc_pkg::cnt_width(LowTicks);

  localparam int unsigned High = (HighTicks == 0) ? 1 : HighTicks;

  logic armed_q, done;
  logic [Width-1:0] count_q;

  assign done = us_i && count_q == (armed_q ? Width'(LowTicks - 1) : Width'(High - 1));
  assign hit_o = armed_q && !pin_i && done;
  assign armed_o = !armed_q && pin_i && (HighTicks == 0 || done);

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      armed_q <= Armed;
      count_q <= '0;
    end else begin
      if (hit_o || armed_o) armed_q <= !armed_q;
      if (pin_i == armed_q || hit_o || armed_o) count_q <= '0;
      else if (us_i) count_q <= count_q + 1'b1;
    end
  end

endmodule

`default_nettype wire
