// SPDX-License-Identifier: Apache-2.0
// ppmc_bank: 4 to 64 axes on one engine; for the host, each axis is a PPMC-104.
// Rules:  BANK-GEN-01..05 and, through its blocks, all others. Manual: docs/bank/README.md.
// Timing: axis a is visited every R = max(AXES, 8) cycles; edges are exact to the cycle. d_o is valid 5
//         cycles after a read strobe has begun.
`default_nettype none

module ppmc_bank
  import ppmc_bank_pkg::*;
  import ppmc_motion_pkg::*;
#(
    parameter int unsigned AXES       = 32,           // 4, 8, 16, 32 or 64
    parameter int unsigned CLK_HZ     = 100_000_000,  // clock frequency in Hz, 8e6 .. 200e6
    parameter int unsigned XTAL_HZ    = 16_000_000,   // crystal of the old chip in Hz, 1e6 .. 16e6
    parameter bit          PHASE_IDLE = 1'b1          // level of s until the first initialisation
) (
    input  wire logic              clk,
    input  wire logic              rst_n,
    // host bus
    input  wire logic [       9:0] a,       // 9..4 axis, 3..0 register
    input  wire logic              cs_n,
    input  wire logic              rd_n,
    input  wire logic              wr_n,
    input  wire logic [       7:0] d_i,
    output logic      [       7:0] d_o,
    output logic                   d_oe,
    output logic                   int_n,   // L: a motion has ended
    // switches, L = active, one bit for each axis
    input  wire logic [  AXES-1:0] l1_n,    // CW limit
    input  wire logic [  AXES-1:0] l2_n,    // CCW limit
    input  wire logic [  AXES-1:0] l3_n,    // CW slow-down limit
    input  wire logic [  AXES-1:0] l4_n,    // CCW slow-down limit
    input  wire logic [  AXES-1:0] cnp_n,   // origin
    input  wire logic [  AXES-1:0] alm_n,   // alarm
    // motors, one bit for each axis; five bits S5..S1
    output logic      [5*AXES-1:0] s,
    output logic      [  AXES-1:0] hold,
    output logic      [  AXES-1:0] pout_n,
    output logic      [  AXES-1:0] dir      // 0 = CW
);

  localparam int unsigned RoundBits = (AXES < 8) ? 3 : $clog2(AXES);
  localparam int unsigned Round = 1 << RoundBits;

  if (!(AXES inside {4, 8, 16, 32, 64})) begin : g_check_axes
    $fatal(1, "ppmc_bank: AXES must be 4, 8, 16, 32 or 64");
  end
  if (CLK_HZ < 8_000_000 || CLK_HZ > 200_000_000) begin : g_check_clk
    $fatal(1, "ppmc_bank: CLK_HZ must be 8e6 .. 200e6");
  end
  if (XTAL_HZ < 1_000_000 || XTAL_HZ > 16_000_000) begin : g_check_xtal
    $fatal(1, "ppmc_bank: XTAL_HZ must be 1e6 .. 16e6");
  end
  if (64'd4 * 64'(CLK_HZ) % 64'(XTAL_HZ) != 0) begin : g_check_quantum
    $fatal(1, "ppmc_bank: 4 * CLK_HZ must be a multiple of XTAL_HZ");
  end
  if (64'd16 * 64'(CLK_HZ) < 64'(Round) * 64'(XTAL_HZ)) begin : g_check_round
    $fatal(1, "ppmc_bank: CLK_HZ too low for so many axes: 16 * CLK_HZ / XTAL_HZ >= AXES and >= 8");
  end

  logic rst;

  ppmc_reset u_reset (
      .clk_i (clk),
      .rst_ni(rst_n),
      .rst_no(rst)
  );

  logic [6*AXES-1:0] unused_meta, levels;

  ppmc_sync #(
      .Width(6 * AXES)
  ) u_sync (
      .clk_i (clk),
      .rst_ni(rst),
      .d_i   ({alm_n, cnp_n, l4_n, l3_n, l2_n, l1_n}),
      .q1_o  (unused_meta),
      .q2_o  (levels)
  );

  // ---- host, engine --------------------------------------------------------------------------------

  localparam int unsigned Quantum = 4 * CLK_HZ / XTAL_HZ;  // quantum in cycles
  localparam int unsigned TimeBits = $clog2(Quantum * (256 * 32 + 30) + 1);  // bits of the slowest interval

  logic go, go_now, stop, stopping, answer_we, call, calm;
  logic [5:0][RoundBits-1:0] axis;
  logic [Round-1:0] turn;
  logic [6:0] clear;
  logic unused_clear;
  logic [RoundBits-1:0] at;
  logic [TimeBits-1:0] due;
  mail_t mail;
  progress_t progress;
  logic [1:0] config_n;
  status_t status;
  logic [31:0] position;
  answer_t answer;
  order_t order;
  seen_t seen;
  logic [AXES-1:0] mask, pending_q;

  assign unused_clear = ^{clear[5], clear[2:0]};

  ppmc_bank_scheduler #(
      .RoundBits(RoundBits),
      .Width    (20 * Quantum),
      .TimeBits (TimeBits)
  ) u_round (
      .clk_i  (clk),
      .rst_ni (rst),
      .go_i   (go),
      .stop_i (stop),
      .axis_o (axis),
      .turn_o (turn),
      .clear_o(clear),
      .go_o   (go_now),
      .due_o  (due),
      .stop_o (stopping)
  );

  ppmc_bank_window #(
      .Axes     (AXES),
      .RoundBits(RoundBits)
  ) u_window (
      .clk_i      (clk),
      .rst_ni     (rst),
      .a_i        (a),
      .cs_ni      (cs_n),
      .rd_ni      (rd_n),
      .wr_ni      (wr_n),
      .d_i,
      .d_o,
      .d_oe_o     (d_oe),
      .ready_i    (!clear[6]),
      .axis_i     (axis[0]),
      .mail_o     (mail),
      .progress_o (progress),
      .config_no  (config_n),
      .done_axis_i(axis[5]),
      .status_i   (status),
      .position_i (position),
      .answer_we_i(answer_we),
      .answer_i   (answer),
      .map_i      (pending_q),
      .mask_o     (mask),
      .go_o       (go),
      .stop_o     (stop)
  );

  ppmc_bank_engine #(
      .Quantum  (Quantum),
      .TimeBits (TimeBits),
      .PhaseIdle(PHASE_IDLE),
      .RoundBits(RoundBits)
  ) u_engine (
      .clk_i      (clk),
      .rst_ni     (rst),
      .axis_i     (axis),
      .clear_i    (clear[4:3]),
      .mail_i     (mail),
      .progress_i (progress),
      .config_ni  (config_n),
      .go_i       (go_now),
      .due_i      (due),
      .seen_i     (seen),
      .status_o   (status),
      .position_o (position),
      .answer_we_o(answer_we),
      .answer_o   (answer),
      .order_o    (order),
      .at_o       (at),
      .call_o     (call),
      .calm_o     (calm)
  );

  // ---- axes ----------------------------------------------------------------------------------------

  seen_t views[AXES];

  // AND and OR need half the cells of a multiplexer. turn marks the axis in the last stage. The axis in stage
  // 2 is three axes after it.
  always_comb begin
    seen = '0;
    for (int unsigned i = 0; i < AXES; i++) seen |= views[i] & {$bits(seen_t) {turn[(i+Round-3)%Round]}};
  end

  for (genvar i = 0; i < AXES; i++) begin : g_axis
    assign views[i].mask = mask[i];
    assign views[i].switches = '{
            limit_cw: !levels[i],
            limit_ccw: !levels[AXES+i],
            slow_cw: !levels[2*AXES+i],
            slow_ccw: !levels[3*AXES+i],
            origin: !levels[4*AXES+i],
            alarm: !levels[5*AXES+i]
        };

    ppmc_bank_pins #(
        .RoundBits(RoundBits),
        .PhaseIdle(PHASE_IDLE)
    ) u_cell (
        .clk_i     (clk),
        .rst_ni    (rst),
        .clock_i   (axis[0]),
        .load_i    (turn[i]),
        .order_i   (order),
        .at_i      (at),
        .stop_i    (stopping),
        .switches_i(views[i].switches),
        .armed_o   (views[i].armed),
        .emitted_o (views[i].emitted),
        .stopped_o (views[i].stop),
        .alarm_o   (views[i].alarm),
        .limit_o   (views[i].limit),
        .s_o       (s[5*i+:5]),
        .hold_o    (hold[i]),
        .pout_no   (pout_n[i]),
        .dir_o     (dir[i])
    );

    always_ff @(posedge clk or negedge rst) begin
      if (!rst) pending_q[i] <= 1'b0;
      else if (turn[i] && (call || calm)) pending_q[i] <= call;
    end
  end

  always_ff @(posedge clk or negedge rst) begin
    if (!rst) int_n <= 1'b1;
    else int_n <= pending_q == '0;
  end

endmodule

`default_nettype wire
