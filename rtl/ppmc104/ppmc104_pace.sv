// SPDX-License-Identifier: Apache-2.0
// ppmc104_pace: processing times that only this part has (DATASHEET): of slow-down limits, and of other bytes than
// stop commands in a fast motion. FAST has none. The others are in ppmc_pace.
// Rules:  P104-DS-10/12, P104-LIM-01 (the guard is never blinded).
// Timing: slow_o comes one clk after the nominal time.
`default_nettype none

module ppmc104_pace
  import ppmc_motion_pkg::motion_t;
#(
    parameter bit          Datasheet = 1'b0,
    parameter int unsigned ClkHz     = 16_000_000,
    parameter int unsigned XtalHz    = 16_000_000
) (
    input  wire logic          clk_i,
    input  wire logic          rst_ni,
    input  wire motion_t       motion_i,     // the motion as it stands
    input  wire logic    [7:0] rate_i,       // rate of its running interval
    input  wire logic          slow_seen_i,  // the axis sees a slow-down limit
    output logic               slow_o,       // act on a slow-down limit
    output logic               stops_only_o  // the mailbox gives stop commands only
);

  // Crystal cycles; microseconds times 16.
  localparam int unsigned FLAG_LIMIT = 12 * 16;
  localparam int unsigned FLAG_LIMIT_TOP = 17 * 16;
  localparam int unsigned SlowBits = 9;
  // Quanta; an interval shorter than this closes the mailbox.
  localparam int unsigned BRISK_POUT = 100;
  localparam int unsigned BRISK_PHASE = 148;

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

    ppmc_xtal_timer #(
        .ClkHz (ClkHz),
        .XtalHz(XtalHz),
        .Width (SlowBits)
    ) u_slow (
        .clk_i,
        .rst_ni,
        .restart_i(!slow_busy_q),
        .limit_i  (slow_top_q ? SlowBits'(FLAG_LIMIT_TOP) : SlowBits'(FLAG_LIMIT)),
        .past_o   (slow_past)
    );

    assign slow_o = slow_busy_q && slow_past;

    logic [13:0] interval;  // quanta of the running interval
    logic unused_bits;

    assign unused_bits = &{1'b0, motion_i};

    always_comb begin
      interval = (14'(rate_i) + 14'd1) << (motion_i.base.slow ? 5 : 3);
      if (motion_i.base.extra) interval = interval + 14'd30;
      stops_only_o = motion_i.running && !motion_i.base.external &&
        interval < (motion_i.op.pout_only ? 14'(BRISK_POUT) : 14'(BRISK_PHASE));
    end
  end

endmodule

`default_nettype wire
