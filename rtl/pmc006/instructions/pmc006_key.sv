// SPDX-License-Identifier: Apache-2.0
// pmc006_key: time filter of one input: an event when it has been low long enough, armed anew when high.
// Rules:  P006-PRG-30, P006-EEP-20.
// Timing: hit_o and armed_o are combinational, in the clk of the µs tick that decides: number Ticks without
//         interruption.
`default_nettype none

module pmc006_key #(
    parameter int unsigned LowTicks  = 1001,
    parameter int unsigned HighTicks = 1001,  // to arm it again: as many, or 0: at once
    parameter bit          Armed     = 1'b0   // after reset
) (
    input  wire logic clk_i,
    input  wire logic rst_ni,
    input  wire logic us_i,    // one clk every microsecond
    input  wire logic pin_i,   // synchronised
    output logic      hit_o,   // low long enough: the event
    output logic      armed_o  // being armed
);

  if (HighTicks != 0 && HighTicks != LowTicks) begin : g_check
    $fatal(1, "pmc006_key: HighTicks must be 0 or LowTicks");
  end

  logic armed_q, begun_q, nearly, done;

  // All ticks but the last one.
  ppmc_delay #(
      .Ticks(LowTicks - 1)
  ) u_nearly (
      .clk_i,
      .restart_i(pin_i == armed_q || hit_o || armed_o || !begun_q),
      .tick_i   (us_i),
      .past_o   (nearly)
  );

  assign done = us_i && nearly && begun_q;
  assign hit_o = armed_q && !pin_i && done;
  assign armed_o = !armed_q && pin_i && (HighTicks == 0 || done);

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      armed_q <= Armed;
      begun_q <= 1'b0;
    end else begin
      if (hit_o || armed_o) armed_q <= !armed_q;
      begun_q <= 1'b1;
    end
  end

endmodule

`default_nettype wire
