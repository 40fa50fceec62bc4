// SPDX-License-Identifier: Apache-2.0
// pmc006_start_check: decides whether an instruction or another event starts, resumes or stops a motion.
// Rules:  P006-STA-01..04/10/11/13/14/16/18/19, P006-CMD-55, P006-EXT-11.
// Timing: start_o, run_o and halt_o are combinational. They are asserted in the cycle before the edge at
//         which BUSY changes, and at most one of them is high in a cycle. speed_o is also combinational:
//         during a speed run, it is 1 in the cycle of instruction "N 1". Therefore this instruction resumes a
//         run that would end at the next edge.
`include "ppmc_assert.svh"
`default_nettype none

module pmc006_start_check
  import pmc006_pkg::*;
(
    input  wire logic            clk_i,
    input  wire logic            rst_ni,
    input  wire exec_cmd_t       cmd_i,         // instruction in progress
    input  wire logic            legal_i,       // 1: the data of cmd_i are accepted
    input  wire logic            exec_i,        // strobe: cmd_i is executed
    input  wire motor_settings_t settings_i,    // parameter registers
    input  wire logic            busy_i,        // 1: a motion is in progress
    input  wire logic            locked_i,      // 1: an EXT flag is set
    input  wire logic            ext_event_i,   // strobe: an EXT flag is set at the next edge
    input  wire logic            stall_stop_i,  // 1: a stall stops the motion
    input  wire logic            key_stop_i,    // strobe: the RESET key stops the motion
    output logic                 start_o,       // strobe: start a motion with a number of steps
    output logic                 run_o,         // strobe: start a speed run
    output logic                 halt_o,        // 1: stop the motion immediately
    output logic                 speed_o,       // 0: decelerate and end a speed run
    output logic                 speed_mode_o   // register SPEED_MODE
);

  logic limits_q, endless_q, exec_ok, can_start, run_req;

  // stall_stop_i is omitted here: a stall only stops a motion in progress, so it does not prevent a start.
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

  // limits_q = 1: VSTART and VSTOP are at most VMAX. This comparison is registered. Instructions are
  // several cycles apart, so limits_q is up to date when start_o uses it.
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
