// SPDX-License-Identifier: Apache-2.0
// ppmc_bank: 4 to 64 axes that share one engine. For the host, each axis is a PPMC-104.
// Rules:  BANK-GEN-01..05; the instantiated blocks implement all others. Manual: docs/bank/README.md.
// Timing: the engine serves (visits) each axis once in every round of R = max(AXES, 8) cycles. The motor pins
//         change in exactly the cycles that the rules specify. d_o is valid 5 cycles after the start of a
//         read strobe.
`default_nettype none

module ppmc_bank
  import ppmc_bank_pkg::*;
  import ppmc_motion_pkg::*;
#(
    parameter int unsigned AXES       = 32,           // 4, 8, 16, 32 or 64
    parameter int unsigned CLK_HZ     = 100_000_000,  // clock frequency in Hz, 8e6 .. 200e6
    parameter int unsigned XTAL_HZ    = 16_000_000,   // crystal of the old chip in Hz, 1e6 .. 16e6
    parameter bit          PHASE_IDLE = 1'b1          // level of s before the first initialisation
) (
    input  wire logic              clk,
    input  wire logic              rst_n,
    // host bus
    input  wire logic [       9:0] a,       // [9:4]: axis, [3:0]: register
    input  wire logic              cs_n,
    input  wire logic              rd_n,
    input  wire logic              wr_n,
    input  wire logic [       7:0] d_i,
    output logic      [       7:0] d_o,
    output logic                   d_oe,
    output logic                   int_n,   // low: at least one interrupt is pending
    // switches, active low, one bit per axis
    input  wire logic [  AXES-1:0] l1_n,    // CW limit
    input  wire logic [  AXES-1:0] l2_n,    // CCW limit
    input  wire logic [  AXES-1:0] l3_n,    // CW slow-down limit
    input  wire logic [  AXES-1:0] l4_n,    // CCW slow-down limit
    input  wire logic [  AXES-1:0] cnp_n,   // origin
    input  wire logic [  AXES-1:0] alm_n,   // alarm
    // motors, one bit per axis; s has five bits S5..S1 per axis
    output logic      [5*AXES-1:0] s,
    output logic      [  AXES-1:0] hold,
    output logic      [  AXES-1:0] pout_n,
    output logic      [  AXES-1:0] dir      // 0: CW, 1: CCW
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

  logic rst_core_n;

  ppmc_reset u_reset (
      .clk_i (clk),
      .rst_ni(rst_n),
      .rst_no(rst_core_n)
  );

  logic [6*AXES-1:0] unused_meta, levels;

  ppmc_sync #(
      .Width(6 * AXES)
  ) u_sync (
      .clk_i (clk),
      .rst_ni(rst_core_n),
      .d_i   ({alm_n, cnp_n, l4_n, l3_n, l2_n, l1_n}),
      .q1_o  (unused_meta),
      .q2_o  (levels)
  );

  // ---- host, engine --------------------------------------------------------------------------------

  localparam int unsigned Quantum = 4 * CLK_HZ / XTAL_HZ;  // quantum (4 crystal cycles) in clock cycles
  // Bits of the number of cycles of the longest interval.
  localparam int unsigned TimeBits = $clog2(Quantum * (256 * 32 + 30) + 1);

  logic go, go_active, stop, stop_active, read_data_we, irq_pending;
  logic [5:0][RoundBits-1:0] axis;
  logic [Round-1:0] last_stage;
  logic [6:0] clear;
  logic unused_clear;
  logic [RoundBits-1:0] at_cycle, go_left;
  in_buf_t in_buf;
  read_progress_t read_progress;
  logic [1:0] config_n;
  axis_status_t status;
  logic [31:0] position;
  read_data_t read_data;
  pin_cmd_t pin_cmd;
  pin_status_t pin_status;
  logic [AXES-1:0] mask, pending_q;

  assign unused_clear = ^{clear[5], clear[2:0]};

  ppmc_bank_scheduler #(
      .RoundBits(RoundBits)
  ) u_scheduler (
      .clk_i  (clk),
      .rst_ni (rst_core_n),
      .go_i   (go),
      .stop_i (stop),
      .axis_o (axis),
      .last_stage_o (last_stage),
      .clear_o(clear),
      .go_o   (go_active),
      .go_left_o(go_left),
      .stop_o (stop_active)
  );

  ppmc_bank_window #(
      .Axes     (AXES),
      .RoundBits(RoundBits)
  ) u_window (
      .clk_i          (clk),
      .rst_ni         (rst_core_n),
      .a_i            (a),
      .cs_ni          (cs_n),
      .rd_ni          (rd_n),
      .wr_ni          (wr_n),
      .d_i,
      .d_o,
      .d_oe_o         (d_oe),
      .ready_i        (!clear[6]),
      .axis_i         (axis[0]),
      .in_buf_o       (in_buf),
      .read_progress_o(read_progress),
      .config_no      (config_n),
      .done_axis_i    (axis[5]),
      .status_i       (status),
      .position_i     (position),
      .read_data_we_i (read_data_we),
      .read_data_i    (read_data),
      .map_i          (pending_q),
      .mask_o         (mask),
      .go_o           (go),
      .stop_o         (stop)
  );

  ppmc_bank_engine #(
      .Quantum  (Quantum),
      .TimeBits (TimeBits),
      .PhaseIdle(PHASE_IDLE),
      .RoundBits(RoundBits)
  ) u_engine (
      .clk_i          (clk),
      .rst_ni         (rst_core_n),
      .axis_i         (axis),
      .clear_i        (clear[4:3]),
      .in_buf_i       (in_buf),
      .read_progress_i(read_progress),
      .config_ni      (config_n),
      .go_i           (go_active),
      .go_left_i      (go_left),
      .pin_status_i   (pin_status),
      .status_o       (status),
      .position_o     (position),
      .read_data_we_o (read_data_we),
      .read_data_o    (read_data),
      .pin_cmd_o      (pin_cmd),
      .at_cycle_o     (at_cycle),
      .irq_pending_o  (irq_pending)
  );

  // ---- axes ----------------------------------------------------------------------------------------

  pin_status_t axis_pin_status[AXES];

  // Selects the status of the axis in stage 2. last_stage marks the axis in stage 5, whose index is lower by
  // 3. The selection uses AND and OR gates, because a multiplexer needs twice the number of cells.
  always_comb begin
    pin_status = '0;
    for (int unsigned i = 0; i < AXES; i++)
    pin_status |= axis_pin_status[i] & {$bits(pin_status_t) {last_stage[(i+Round-3)%Round]}};
  end

  for (genvar i = 0; i < AXES; i++) begin : g_axis
    assign axis_pin_status[i].pout_n = pout_n[i];
    assign axis_pin_status[i].in_group = mask[i];
    assign axis_pin_status[i].switches = '{
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
    ) u_pins (
        .clk_i     (clk),
        .rst_ni    (rst_core_n),
        .cycle_i   (axis[0]),
        .load_i    (last_stage[i]),
        .pin_cmd_i (pin_cmd),
        .at_cycle_i(at_cycle),
        .stop_i    (stop_active),
        .switches_i(axis_pin_status[i].switches),
        .armed_o   (axis_pin_status[i].armed),
        .stopped_o (axis_pin_status[i].stop),
        .alarm_no  (axis_pin_status[i].alarm_n),
        .limit_o   (axis_pin_status[i].limit),
        .s_o       (s[5*i+:5]),
        .hold_o    (hold[i]),
        .pout_no   (pout_n[i]),
        .dir_o     (dir[i])
    );

    always_ff @(posedge clk or negedge rst_core_n) begin
      if (!rst_core_n) pending_q[i] <= 1'b0;
      else if (last_stage[i]) pending_q[i] <= irq_pending;
    end
  end

  always_ff @(posedge clk or negedge rst_core_n) begin
    if (!rst_core_n) int_n <= 1'b1;
    else int_n <= pending_q == '0;
  end

endmodule

`default_nettype wire
