// SPDX-License-Identifier: Apache-2.0
// pmc006_debounce: debounce filter of one input. Asserts hit_o when the input has been low for LowTicks,
//         and re-arms when it has been high for HighTicks (0: immediately).
// Rules:  P006-PRG-30, P006-EEP-20.
// Timing: hit_o and rearm_o are combinational strobes. They are high in the cycle of the µs tick that
//         completes the number of consecutive ticks. With HighTicks = 0, rearm_o is high in the first cycle
//         in which the input is high.
`default_nettype none

module pmc006_debounce #(
    parameter int unsigned LowTicks     = 1001,
    parameter int unsigned HighTicks    = 1001,  // LowTicks, or 0: the filter re-arms immediately
    parameter bit          ArmedAtReset = 1'b0   // 1: the filter is armed after reset
) (
    input  wire logic clk_i,
    input  wire logic rst_ni,
    input  wire logic us_i,    // strobe every microsecond
    input  wire logic pin_i,   // input, synchronised
    output logic      hit_o,   // strobe: the input was low for LowTicks
    output logic      rearm_o  // strobe: the input is re-armed
);

  if (HighTicks != 0 && HighTicks != LowTicks) begin : g_check
    $fatal(1, "pmc006_debounce: HighTicks must be 0 or LowTicks");
  end

  logic armed_q, running_q, last_tick, done;

  // Counts all ticks except the last one.
  ppmc_delay #(
      .Ticks(LowTicks - 1)
  ) u_nearly (
      .clk_i,
      .restart_i(pin_i == armed_q || hit_o || rearm_o || !running_q),
      .tick_i   (us_i),
      .past_o   (last_tick)
  );

  assign done = us_i && last_tick && running_q;
  assign hit_o = armed_q && !pin_i && done;
  assign rearm_o = !armed_q && pin_i && (HighTicks == 0 || done);

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      armed_q   <= ArmedAtReset;
      running_q <= 1'b0;
    end else begin
      if (hit_o || rearm_o) armed_q <= !armed_q;
      running_q <= 1'b1;
    end
  end

endmodule

`default_nettype wire
