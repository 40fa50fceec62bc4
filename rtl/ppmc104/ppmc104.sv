// SPDX-License-Identifier: Apache-2.0
// ppmc104: single-axis stepper controller; replaces the Ampere PPMC-104BFP.
// Rules:  P104-PORT-01..04, P104-PAR-01; the instantiated blocks implement all others. Manual:
//         docs/ppmc104/README.md.
// Timing: a command takes effect 4 cycles after the rising edge at which the end of its write is first
//         sampled. The motor pins follow one cycle later.
`default_nettype none

module ppmc104
  import ppmc104_pkg::*;
  import ppmc_code_pkg::*;
  import ppmc_motion_pkg::*;
  import ppmc_single_pkg::*;
#(
    parameter int unsigned CLK_HZ     = 16_000_000,  // clock frequency in Hz, 8e6 .. 200e6
    parameter int unsigned XTAL_HZ    = 16_000_000,  // crystal of the old chip in Hz, 1e6 .. 16e6
    parameter              TIMING     = "FAST",      // or "DATASHEET": processing times of the old chip
    parameter bit          PHASE_IDLE = 1'b1         // level of s until the first initialisation
) (
    input  wire logic       clk,
    input  wire logic       rst_n,
    // host bus
    input  wire logic       a0,      // 0: data, 1: status or command
    input  wire logic       cs_n,
    input  wire logic       rd_n,
    input  wire logic       wr_n,
    input  wire logic [7:0] d_i,
    output logic      [7:0] d_o,
    output logic            d_oe,
    output logic            int_n,   // low: a motion has ended
    // clock selection
    input  wire logic       csel,    // internal base clock, high: 500 kHz, low: 125 kHz
    input  wire logic       vsel,    // low: adds 7.5 us to every interval
    input  wire logic       clock,   // external base clock, rising edges
    // switches, active low
    input  wire logic       l1_n,    // CW limit
    input  wire logic       l2_n,    // CCW limit
    input  wire logic       l3_n,    // CW slow-down limit
    input  wire logic       l4_n,    // CCW slow-down limit
    input  wire logic       cnp_n,   // origin
    input  wire logic       alm_n,   // alarm
    // auxiliary
    input  wire logic [3:0] auxi,
    output logic      [3:0] auxo,
    output logic            aux_n,
    // motor
    output logic      [5:1] s,
    output logic            hold,
    output logic            pout_n,
    output logic            dir      // 0: CW, 1: CCW
);

  if (128'(TIMING) != "FAST" && 128'(TIMING) != "DATASHEET") begin : g_check_timing
    $fatal(1, "ppmc104: TIMING must be FAST or DATASHEET");
  end
  if (CLK_HZ < 8_000_000 || CLK_HZ > 200_000_000) begin : g_check_clk
    $fatal(1, "ppmc104: CLK_HZ must be 8e6 .. 200e6");
  end
  if (XTAL_HZ < 1_000_000 || XTAL_HZ > 16_000_000) begin : g_check_xtal
    $fatal(1, "ppmc104: XTAL_HZ must be 1e6 .. 16e6");
  end

  logic rst_core_n;

  ppmc_reset u_reset (
      .clk_i (clk),
      .rst_ni(rst_n),
      .rst_no(rst_core_n)
  );

  // ---- inputs --------------------------------------------------------------------------------------

  logic l1, l2, l3, l4, cnp, alm, csel_s, vsel_s;
  logic [3:0] auxi_s;
  logic [11:0] unused_meta;
  switches_t switches;

  ppmc_sync #(
      .Width(12)
  ) u_sync (
      .clk_i (clk),
      .rst_ni(rst_core_n),
      .d_i   ({l1_n, l2_n, l3_n, l4_n, cnp_n, alm_n, csel, vsel, auxi}),
      .q1_o  (unused_meta),
      .q2_o  ({l1, l2, l3, l4, cnp, alm, csel_s, vsel_s, auxi_s})
  );

  assign switches = '{
          limit_cw: !l1,
          limit_ccw: !l2,
          slow_cw: !l3,
          slow_ccw: !l4,
          origin: !cnp,
          alarm: !alm
      };

  // ---- decoding of the bytes, shared single-axis core ----------------------------------------------

  rx_byte_t rx_byte;
  decoded_byte_t decoded_byte;
  command_req_t command_req;
  check_result_t check_result;
  logic [31:0] params_late;
  logic slow_seen, slow_react, stops_only, unused_bits;
  setup_t setup;
  chop_time_t chop;
  action_t act;
  motion_t motion;
  logic [7:0] rate;
  motor_t motor;
  base_clock_t base_now;

  assign decoded_byte = '{decoded: decode(rx_byte.data), data: rx_byte.data};
  assign check_result = '{
          error: check_params(command_req.params),
          is_checked: rx_byte.code_held[7:6] == 2'b00,
          select: command_req.code[2:0],
          setup: rx_byte.params
      };
  assign base_now = '{external: setup.external, slow: !csel_s, extra: !vsel_s};
  assign unused_bits = &{1'b0, rx_byte, command_req, params_late, setup};

  ppmc_single #(
      .ClkHz    (CLK_HZ),
      .XtalHz   (XTAL_HZ),
      .Datasheet(128'(TIMING) == "DATASHEET"),
      .PhaseIdle(PHASE_IDLE),
      .PartCfg  (PART_CFG)
  ) u_single (
      .clk_i         (clk),
      .rst_ni        (rst_core_n),
      .cs_ni         (cs_n),
      .rd_ni         (rd_n),
      .wr_ni         (wr_n),
      .a0_i          (a0),
      .d_i,
      .d_o,
      .d_oe_o        (d_oe),
      .int_no        (int_n),
      .rx_byte_o     (rx_byte),
      .decoded_byte_i(decoded_byte),
      .command_req_o (command_req),
      .check_result_i(check_result),
      .stops_only_i  (stops_only),
      .act_o         (act),
      .params_late_o (params_late),
      .base_i        (base_now),
      .setup_o       (setup),
      .clock_pin_i   (clock),
      .switches_i    (switches),
      .slow_i        (slow_react),
      .slow_seen_o   (slow_seen),
      .motion_o      (motion),
      .rate_o        (rate),
      .inputs_i      ({cnp, alm, 2'b00, l1, l2, l3, l4}),
      .auxi_i        (auxi_s),
      .chop_i        (chop),
      .motor_o       (motor)
  );

  assign s = motor.s;
  assign hold = motor.hold;
  assign pout_n = motor.pout_n;
  assign dir = motor.dir;

  // ---- functions that only this device has ---------------------------------------------------------

  ppmc104_setup u_switching (
      .clk_i   (clk),
      .rst_ni  (rst_core_n),
      .act_i   (act),
      .params_i(command_req.params),
      .aux_i   (params_late[27:24]),
      .vsel_i  (vsel_s),
      .chop_o  (chop),
      .auxo_o  (auxo),
      .aux_no  (aux_n)
  );

  ppmc104_proc_time #(
      .Datasheet(128'(TIMING) == "DATASHEET"),
      .ClkHz    (CLK_HZ),
      .XtalHz   (XTAL_HZ)
  ) u_own_proc_time (
      .clk_i       (clk),
      .rst_ni      (rst_core_n),
      .motion_i    (motion),
      .rate_i      (rate),
      .slow_seen_i (slow_seen),
      .slow_o      (slow_react),
      .stops_only_o(stops_only)
  );

endmodule

`default_nettype wire
