// SPDX-License-Identifier: Apache-2.0
// ppmc2104: two-axis stepper controller; replaces the Ampere PPMC-2104AFP.
// Rules:  P2104-PORT-01..06, P2104-PAR-01, P2104-STA-01..07, P2104-AUX-02/03; the instantiated blocks
//         implement all others.
// Timing: an instruction takes effect 4 cycles after the rising edge at which the end of its write is first
//         sampled. The motor pins and int_n follow one cycle later.
`default_nettype none

module ppmc2104
  import ppmc2104_pkg::*;
#(
    parameter int unsigned CLK_HZ  = 16_000_000,  // clock frequency in Hz, 8e6 .. 200e6, >= XTAL_HZ / 2
    parameter int unsigned XTAL_HZ = 16_000_000,  // crystal of the old chip in Hz, 1e6 .. 16e6
    parameter              TIMING  = "FAST"       // or "DATASHEET": processing times of the old chip
) (
    input  wire logic       clk,
    input  wire logic       rst_n,
    // host bus
    input  wire logic       cs_n,
    input  wire logic       a0,        // 0: data, 1: status or instruction code
    input  wire logic       busc,      // bus style; high: DS and R/W, low: WRS and RDS
    input  wire logic       ds_wrs_n,
    input  wire logic       rw_rds_n,
    input  wire logic [7:0] d_i,
    output logic      [7:0] d_o,
    output logic            d_oe,
    output logic            int_n,
    input  wire logic       errint_n,  // low: an error also asserts int_n
    // motors; the index is the axis
    output logic      [2:1] pout_n,
    output logic      [2:1] dir,       // 0: CW, 1: CCW
    output logic      [2:1] hold,
    output logic      [5:1] s1_n,      // phases of axis 1
    output logic      [5:1] s2_n,      // phases of axis 2
    // start gate, clock selection
    input  wire logic [2:1] run,
    input  wire logic [2:1] extck,     // external base clock, rising edges
    input  wire logic [2:1] csel,      // internal base clock, high: 500 kHz, low: 125 kHz
    // switches, active low
    input  wire logic [2:1] fl_n,      // CW limit
    input  wire logic [2:1] bl_n,      // CCW limit
    input  wire logic [2:1] fhl_n,     // CW slow-down limit
    input  wire logic [2:1] bhl_n,     // CCW slow-down limit
    input  wire logic [2:1] org_n,     // origin
    input  wire logic [2:1] alm_n,     // alarm
    // auxiliary
    input  wire logic [1:0] auxi,
    output logic      [1:0] auxo,
    output logic            clk_o      // crystal frequency / 4
);

  if (128'(TIMING) != "FAST" && 128'(TIMING) != "DATASHEET") begin : g_check_timing
    $fatal(1, "ppmc2104: TIMING must be FAST or DATASHEET");
  end
  if (CLK_HZ < 8_000_000 || CLK_HZ > 200_000_000) begin : g_check_clk
    $fatal(1, "ppmc2104: CLK_HZ must be 8e6 .. 200e6");
  end
  if (XTAL_HZ < 1_000_000 || XTAL_HZ > 16_000_000) begin : g_check_xtal
    $fatal(1, "ppmc2104: XTAL_HZ must be 1e6 .. 16e6");
  end

  localparam bit Datasheet = 128'(TIMING) == "DATASHEET";

  logic rst_core_n;

  ppmc_reset u_reset (
      .clk_i (clk),
      .rst_ni(rst_n),
      .rst_no(rst_core_n)
  );

  ppmc_square #(
      .ClkHz   (CLK_HZ),
      .XtalHz  (XTAL_HZ),
      .HalfXtal(CLOCK_OUT_XTAL)
  ) u_clock_out (
      .clk_i (clk),
      .rst_ni(rst_core_n),
      .wave_o(clk_o)
  );

  // ---- inputs -------------------------------------------------------------------------------------

  localparam int unsigned Pins = AXES * $bits(pin_levels_t) + 4;

  pin_levels_t [AXES:1] pins, levels;
  logic busc_s, errint_s;
  logic [1:0] auxi_s;
  logic [Pins-1:0] unused_meta;

  for (genvar n = 1; n <= AXES; n++) begin : g_pins
    assign pins[n] = '{
            run: run[n],
            csel: csel[n],
            org: org_n[n],
            alm: alm_n[n],
            fl: fl_n[n],
            fhl: fhl_n[n],
            bl: bl_n[n],
            bhl: bhl_n[n]
        };
  end

  ppmc_sync #(
      .Width(Pins)
  ) u_sync (
      .clk_i (clk),
      .rst_ni(rst_core_n),
      .d_i   ({pins, busc, errint_n, auxi}),
      .q1_o  (unused_meta),
      .q2_o  ({levels, busc_s, errint_s, auxi_s})
  );

  // ---- host ---------------------------------------------------------------------------------------

  logic ready, is_command, take, open, any_error, read_axis;
  logic [7:0] in_byte, code, code_held, code_late;
  logic [31:0] params, params_held, params_late;
  logic [AXES:1] collecting, building, window, cmnd, busy;
  logic [23:0] answer;
  logic [AXES:1][23:0] answers;
  action_t act_req, act;  // act_req: requested by the accepted byte; act: takes effect in this cycle
  error_report_t error_report;
  cmd_error_e speed;
  cmd_error_e [AXES:1] errors;
  axis_summary_t [AXES:1] state;

  assign cmnd = collecting | building | window;
  assign read_axis = act.axis[1].read || act.axis[2].read;

  always_comb begin
    answer = code_late[5] ? answers[2] : answers[1];
    if (code_late[6]) answer[7:0] = {6'b000000, auxi_s};
  end

  ppmc_host_port #(
      .QueueBytes(3)
  ) u_host (
      .clk_i    (clk),
      .rst_ni   (rst_core_n),
      .style_i  (busc_s),
      .cs_ni    (cs_n),
      .rd_ni    (rw_rds_n),
      .wr_ni    (ds_wrs_n),
      .a0_i     (a0),
      .d_i      (d_i),
      .d_o      (d_o),
      .d_oe_o   (d_oe),
      .state_i  ({any_error, 1'b0, cmnd, busy}),
      .ready_o  (ready),
      .command_o(is_command),
      .byte_o   (in_byte),
      .take_i   (take),
      .load_i   (read_axis || act.aux_in),
      .long_i   (code_late[2:0] == SEL_REMAINING),
      .answer_i (answer)
  );

  ppmc2104_command u_command (
      .clk_i         (clk),
      .rst_ni        (rst_core_n),
      .ready_i       (ready),
      .command_i     (is_command),
      .byte_i        (in_byte),
      .open_i        (open),
      .take_o        (take),
      .state_i       (state),
      .levels_i      (levels),
      .building_i    (building),
      .speed_i       (speed),
      .collecting_o  (collecting),
      .act_o         (act_req),
      .error_report_o(error_report),
      .code_o        (code),
      .params_o      (params),
      .code_held_o   (code_held),
      .params_held_o (params_held)
  );

  ppmc2104_speed #(
      .Datasheet(Datasheet)
  ) u_speed (
      .clk_i   (clk),
      .rst_ni  (rst_core_n),
      .code_i  (code),
      .params_i(params),
      .state_i (state),
      .levels_i(levels),
      .error_o (speed)
  );

  logic [AXES:1] run_open, end_delay, ends, read_end, read_error;
  logic poll;

  ppmc2104_proc_time #(
      .Datasheet(Datasheet),
      .ClkHz    (CLK_HZ),
      .XtalHz   (XTAL_HZ)
  ) u_proc_time (
      .clk_i        (clk),
      .rst_ni       (rst_core_n),
      .act_i        (act_req),
      .code_i       (code),
      .params_i     (params),
      .code_held_i  (code_held),
      .params_held_i(params_held),
      .state_i      (state),
      .open_o       (open),
      .window_o     (window),
      .act_o        (act),
      .code_o       (code_late),
      .params_o     (params_late),
      .run_open_o   (run_open),
      .end_delay_o  (end_delay),
      .poll_o       (poll)
  );

  ppmc2104_report #(
      .WidthCycles(ppmc_pkg::cyc(WIDTH_XTAL, CLK_HZ, XTAL_HZ))
  ) u_report (
      .clk_i         (clk),
      .rst_ni        (rst_core_n),
      .error_report_i(error_report),
      .errint_ni     (errint_s),
      .end_i         (ends),
      .read_end_i    (read_end),
      .read_error_i  (read_error),
      .error_o       (errors),
      .any_error_o   (any_error),
      .int_no        (int_n)
  );

  always_ff @(posedge clk or negedge rst_core_n) begin
    if (!rst_core_n) auxo <= '1;
    else if (act.aux_out) auxo <= ~code_late[5:4];
  end

  // ---- ramp tables --------------------------------------------------------------------------------

  logic [AXES:1] build;
  logic [AXES:1][RATE_BITS-1:0] slow, fast, lut_addr;
  logic [AXES:1][STEP_BITS-1:0] steps, lut_data;

  ppmc_ramp_tables #(
      .RateBits(RATE_BITS),
      .StepBits(STEP_BITS)
  ) u_table (
      .clk_i  (clk),
      .rst_ni (rst_core_n),
      .start_i(build),
      .slow_i (slow),
      .fast_i (fast),
      .steps_i(steps),
      .busy_o (building),
      .addr_i (lut_addr),
      .data_o (lut_data)
  );

  // ---- axes ---------------------------------------------------------------------------------------

  logic [AXES:1][5:1] s_n;

  assign s1_n = s_n[1];
  assign s2_n = s_n[2];

  for (genvar n = 1; n <= AXES; n++) begin : g_axis
    assign busy[n]       = state[n].busy;
    assign build[n]      = act.axis[n].init;
    assign slow[n]       = state[n].setup.slow;
    assign fast[n]       = state[n].setup.fast;
    assign steps[n]      = state[n].setup.steps;
    assign read_end[n]   = act.axis[n].read && code_late[2:0] == SEL_END;
    assign read_error[n] = act.axis[n].read && code_late[2:0] == SEL_ERROR;

    ppmc2104_axis #(
        .ClkHz    (CLK_HZ),
        .XtalHz   (XTAL_HZ),
        .Datasheet(Datasheet)
    ) u_axis (
        .clk_i        (clk),
        .rst_ni       (rst_core_n),
        .act_i        (act.axis[n]),
        .code_i       (code),
        .params_i     (params),
        .code_late_i  (code_late),
        .params_late_i(params_late),
        .ready_i      (!building[n] && !window[n]),
        .state_o      (state[n]),
        .end_o        (ends[n]),
        .error_i      (errors[n]),
        .answer_o     (answers[n]),
        .lut_addr_o   (lut_addr[n]),
        .lut_data_i   (lut_data[n]),
        .run_open_i   (run_open[n]),
        .poll_i       (poll),
        .end_delay_i  (end_delay[n]),
        .levels_i     (levels[n]),
        .extck_i      (extck[n]),
        .s_no         (s_n[n]),
        .hold_o       (hold[n]),
        .pout_no      (pout_n[n]),
        .dir_o        (dir[n])
    );
  end

endmodule

`default_nettype wire
