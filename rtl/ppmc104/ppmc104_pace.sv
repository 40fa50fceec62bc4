// SPDX-License-Identifier: Apache-2.0
// ppmc104_pace: processing times that only this part has (DATASHEET): of slow-down limits, and of other bytes than
// stop commands in a fast motion. FAST has none. The others are in ppmc_pace.
// Rules:  P104-DS-10/12, P104-LIM-01 (the guard is never blinded).
// Timing: slow_o comes one clk after the nominal time.
`default_nettype none

module ppmc104_pace
  import ppmc104_pkg::*;
  import ppmc_motion_pkg::*;
#(
    parameter bit          Datasheet = 1'b0,
    parameter int unsigned ClkHz     = 16_000_000,
    parameter int unsigned XtalHz    = 16_000_000
) (
    input  wire logic                  clk_i,
    input  wire logic                  rst_ni,
    input  wire logic                  moving_i,
    input  wire logic                  running_i,
    input  wire logic                  top_i,
    input  wire op_t                   op_run_i,
    input  wire base_t                 base_run_i,
    input  wire logic  [RATE_BITS-1:0] rate_i,
    input  wire logic                  slow_seen_i,
    output logic                       slow_o,       // act on a slow-down limit
    output logic                       stops_only_o  // the mailbox gives stop commands only
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

    assign unused_bits = &{1'b0, clk_i, rst_ni, moving_i, running_i, top_i, op_run_i, base_run_i, rate_i};
    assign slow_o = slow_seen_i;
    assign stops_only_o = 1'b0;
  end else begin : g_datasheet

    logic slow_busy_q, slow_top_q, slow_past;

    always_ff @(posedge clk_i or negedge rst_ni) begin
      if (!rst_ni) begin
        slow_busy_q <= 1'b0;
        slow_top_q  <= 1'b0;
      end else if (!moving_i) begin
        slow_busy_q <= 1'b0;
      end else if (!slow_busy_q) begin
        slow_busy_q <= slow_seen_i;
        slow_top_q  <= top_i;
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

    assign unused_bits = &{1'b0, op_run_i};

    always_comb begin
      interval = (14'(rate_i) + 14'd1) << (base_run_i.slow ? 5 : 3);
      if (base_run_i.extra) interval = interval + 14'd30;
      stops_only_o = running_i && !base_run_i.external &&
        interval < (op_run_i.pout_only ? 14'(BRISK_POUT) : 14'(BRISK_PHASE));
    end
  end

endmodule

`default_nettype wire
