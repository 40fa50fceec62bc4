// SPDX-License-Identifier: Apache-2.0
// ppmc_ext_clock_fv: proves that each rising edge of the pin is reported once, that a falling edge is
// reported at least 2 cycles after the rising edge, and that the period of the pin is classified correctly.
`include "ppmc_fv.svh"
`default_nettype none

module ppmc_ext_clock_fv (
    input wire logic clk_i,
    input wire logic pin_i
);

  logic rise_o, fall_o, long_period_o, short_period_o;

  `FV_RESET

  ppmc_ext_clock #(
      .LongPeriodCycles (9),
      .ShortPeriodCycles(7)
  ) dut (
      .*
  );

  logic [4:0] pin_q;  // samples of the pin; the latest is bit 0
  logic rose_q;  // rise_o was high in the last cycle
  logic [4:0] age_q;  // cycles since the last rise, saturates at 31; 31 before the first rise

  always_ff @(posedge clk_i)
    if (!rst_ni) {pin_q, age_q, rose_q} <= {5'h1f, 5'h1f, 1'b0};
    else begin
      rose_q <= rise_o;
      pin_q  <= {pin_q[3:0], pin_i};
      age_q  <= rise_o ? 5'd1 : (age_q == '1) ? '1 : age_q + 1'b1;
    end

  `FV_ASSERT(p104_bck_04_rise, rise_o == (pin_q[2:1] == 2'b01))
  // If the pin was sampled high only once, its falling edge is reported one cycle later; it is not reported
  // if the pin is high again by then.
  `FV_ASSERT(p104_bck_04_fall, fall_o == (pin_q[3:1] == 3'b110 || pin_q[4:1] == 4'b0100))
  `FV_ASSERT(p104_tim_05_two_cycles, !(fall_o && rose_q))
  `FV_ASSERT(p104_int_03_long, !rise_o || long_period_o == (age_q > 5'd9))
  `FV_ASSERT(p104_tim_05_brisk, !rise_o || short_period_o == (age_q < 5'd7))
  `FV_COVER(seen_single, fall_o && !pin_q[2])
  `FV_COVER(seen_neither, rise_o && !long_period_o && !short_period_o)

endmodule

`default_nettype wire
