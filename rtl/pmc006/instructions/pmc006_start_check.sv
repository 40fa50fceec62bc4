// SPDX-License-Identifier: Apache-2.0
// pmc006_start_check: decides whether a motion is started, resumed or stopped by an instruction or another
// cause.
// Rules:  P006-STA-01..04/10/11/13/14/16/18/19, P006-CMD-55, P006-EXT-11.
// Timing: start_o, run_o and halt_o are combinational, in the cycle before the edge on which BUSY changes. At
//         most one of them is high in a cycle. speed_o is combinational: during a speed run, it is 1 in
//         the cycle of an "N 1", which therefore resumes a run that would end on the next edge.
`include "ppmc_assert.svh"
`default_nettype none

module pmc006_start_check
  import pmc006_pkg::*;
(
    input  wire logic            clk_i,
    input  wire logic            rst_ni,
    input  wire exec_cmd_t       cmd_i,         // instruction in progress
    input  wire logic            legal_i,       // 1: the data of cmd_i are accepted
    input  wire logic            exec_i,        // cmd_i is executed in this cycle
    input  wire motor_settings_t settings_i,    // parameter registers
    input  wire logic            busy_i,        // a motion is in progress
    input  wire logic            locked_i,      // an EXT flag is set
    input  wire logic            ext_event_i,   // strobe: an EXT flag is set at the next edge
    input  wire logic            stall_stop_i,  // a stall stops the motion
    input  wire logic            key_stop_i,    // strobe: the RESET key stops the motion
    output logic                 start_o,       // strobe: start a motion of counted steps
    output logic                 run_o,         // strobe: start a speed run
    output logic                 halt_o,        // stop immediately
    output logic                 speed_o,       // 0: decelerate and end a speed run
    output logic                 speed_mode_o   // register SPEED_MODE
);

  logic limits_q, endless_q, exec_ok, can_start, run_req;

  // A stall stops only a motion in progress, so it does not prevent a start.
  assign exec_ok = exec_i && legal_i && !ext_event_i && !key_stop_i;
  assign can_start = !busy_i && !settings_i.free && !locked_i;

  assign start_o = exec_ok && cmd_i.op == I_STEP && can_start && limits_q;
  assign run_req = exec_ok && cmd_i.op == I_RUN && cmd_i.data[0];
  assign run_o = run_req && can_start && settings_i.vmax != '0;
  assign halt_o = ext_event_i || stall_stop_i || key_stop_i || (exec_i && cmd_i.op == I_ABORT) ||
      (exec_i && legal_i && cmd_i.op == I_FREE && cmd_i.data[0]);
  assign speed_o = speed_mode_o || (run_req && busy_i && endless_q);

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) speed_mode_o <= 1'b0;
    else if (halt_o) speed_mode_o <= 1'b0;
    else if (exec_i && legal_i && cmd_i.op == I_RUN && !cmd_i.data[0]) speed_mode_o <= 1'b0;
    else speed_mode_o <= run_o || speed_o;
  end

  // limits_q: VSTART and VSTOP are at most VMAX. The comparison is registered: instructions are several
  // cycles apart, so the settings are stable before start_o depends on it.
  always_ff @(posedge clk_i) begin
    limits_q <= {2'b00, settings_i.vstart} <= settings_i.vmax && {2'b00, settings_i.vstop} <= settings_i.vmax;
    if (start_o || run_o) endless_q <= run_o;
  end

  logic unused_bits;
  assign unused_bits = &{1'b0, cmd_i, settings_i};

`ifndef SYNTHESIS
  `PPMC_ASSERT(p006_sta_14, !((start_o || run_o) && halt_o))
  `PPMC_ASSERT(p006_sta_16, !speed_mode_o || busy_i)
`endif

endmodule

`default_nettype wire
