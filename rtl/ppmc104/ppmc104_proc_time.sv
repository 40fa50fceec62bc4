// SPDX-License-Identifier: Apache-2.0
// ppmc104_proc_time: with Datasheet = 1, implements the processing times that only the PPMC-104 has. It
//         delays slow-down limits, and allows only stop commands during a fast motion. ppmc_proc_time
//         implements the other processing times.
// Rules:  P104-DS-10/12, P104-LIM-01 (the limits are monitored without gaps).
// Timing: slow_o is asserted one cycle after the nominal delay of slow_seen_i. With Datasheet = 0, slow_o =
//         slow_seen_i.
`default_nettype none

module ppmc104_proc_time
  import ppmc_motion_pkg::*;
  import ppmc104_pkg::FAST_QUANTA;
  import ppmc104_pkg::SLOW_QUANTA;
  import ppmc104_pkg::EXTRA_QUANTA;
#(
    parameter bit          Datasheet = 1'b0,
    parameter int unsigned ClkHz     = 16_000_000,
    parameter int unsigned XtalHz    = 16_000_000
) (
    input  wire logic          clk_i,
    input  wire logic          rst_ni,
    input  wire motion_t       motion_i,     // status of the motion
    input  wire logic    [7:0] rate_i,       // rate of the running interval
    input  wire logic          slow_seen_i,  // 1: a slow-down limit is active and effective
    output logic               slow_o,       // 1: act on a slow-down limit in this cycle
    output logic               stops_only_o  // 1: only stop commands are accepted
);

  // Times in crystal cycles: microseconds times 16.
  localparam int unsigned FlagLimitXtal = 12 * 16;
  localparam int unsigned FlagLimitTopXtal = 17 * 16;
  // Interval limits in quanta. During an interval below the limit, only stop commands are accepted.
  localparam int unsigned FastIntervalPoutQuanta = 100;
  localparam int unsigned FastIntervalPhaseQuanta = 148;

  // Number of rates r whose interval, (r + 1) * period + extra time, is below the limit.
  function automatic int unsigned fast_interval_rates(bit pout_only, bit slow, bit extra);
    int unsigned limit, period;
    limit  = (pout_only ? FastIntervalPoutQuanta : FastIntervalPhaseQuanta) - (extra ? EXTRA_QUANTA : 0);
    period = slow ? SLOW_QUANTA : FAST_QUANTA;
    return (limit - 1) / period;
  endfunction

  if (!Datasheet) begin : g_fast
    logic unused_bits;

    assign unused_bits = &{1'b0, clk_i, rst_ni, motion_i, rate_i};
    assign slow_o = slow_seen_i;
    assign stops_only_o = 1'b0;
  end else begin : g_datasheet

    logic slow_busy_q, slow_top_q, slow_past;

    always_ff @(posedge clk_i or negedge rst_ni) begin
      if (!rst_ni) begin
        slow_busy_q <= 1'b0;
        slow_top_q  <= 1'b0;
      end else if (!motion_i.moving) begin
        slow_busy_q <= 1'b0;
      end else if (!slow_busy_q) begin
        slow_busy_q <= slow_seen_i;
        slow_top_q  <= motion_i.top;
      end else if (slow_past) begin
        slow_busy_q <= 1'b0;
      end
    end

    localparam int unsigned FlagCycles = ppmc_pkg::cyc(FlagLimitXtal, ClkHz, XtalHz);
    localparam int unsigned FlagTopCycles = ppmc_pkg::cyc(FlagLimitTopXtal, ClkHz, XtalHz);
    localparam int unsigned Width = ppmc_lfsr_pkg::width(FlagTopCycles - 1);
    localparam logic [Width-1:0] FlagLast = Width'(ppmc_lfsr_pkg::after(FlagCycles - 1, Width));
    localparam logic [Width-1:0] FlagTopLast = Width'(ppmc_lfsr_pkg::after(FlagTopCycles - 1, Width));

    ppmc_timer #(
        .Width(Width)
    ) u_slow (
        .clk_i,
        .restart_i(!slow_busy_q),
        .tick_i   (1'b1),
        .last_i   (slow_top_q ? FlagTopLast : FlagLast),
        .past_o   (slow_past)
    );

    assign slow_o = slow_busy_q && slow_past;

    // Lowest rate value at which all commands are accepted. It depends on pout_only, slow and extra.
    function automatic logic [7:0] fast_interval_rate(logic pout_only, logic slow, logic extra);
      logic [7:0] found;
      found = '0;
      for (int unsigned n = 0; n < 8; n++) begin
        if (n[2:0] == {pout_only, slow, extra}) found = 8'(fast_interval_rates(n[2], n[1], n[0]));
      end
      return found;
    endfunction

    logic unused_bits;

    assign unused_bits = &{1'b0, motion_i};
    assign stops_only_o = motion_i.running && !motion_i.base.external && ppmc_pkg::less(
        32'(rate_i), 32'(fast_interval_rate(motion_i.op.pout_only, motion_i.base.slow, motion_i.base.extra))
    );
  end

endmodule

`default_nettype wire
