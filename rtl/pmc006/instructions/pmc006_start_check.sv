// SPDX-License-Identifier: Apache-2.0
// pmc006_start_check: decides which motion is started, resumed or stopped, by instructions and by other causes.
// Rules:  sections 4.1..4.3, P006-STA-01..04/10/11/13/14/16/18/19, P006-CMD-55, P006-EXT-11.
// Timing: start_o, run_o and halt_o are combinational, in the cycle before the edge on which BUSY changes. At
//         most one is high in a cycle. speed_o already includes N = 1 of its cycle: this resumes a motion
//         that would end on that edge.
`include "ppmc_assert.svh"
`default_nettype none

module pmc006_start_check
  import pmc006_pkg::*;
(
    input  wire logic      clk_i,
    input  wire logic      rst_ni,
    input  wire order_t    order_i,     // instruction
    input  wire logic      legal_i,     // the data of order_i are in range
    input  wire logic      act_i,       // order_i is executed in this cycle
    input  wire settings_t settings_i,  // parameter registers
    input  wire logic      busy_i,      // a motion is in progress
    input  wire logic      locked_i,    // an EXT flag is set
    input  wire logic      ext_i,       // an EXT flag is being set
    input  wire logic      stall_i,     // stop caused by a stall
    input  wire logic      key_i,       // RESET key
    output logic           start_o,     // a motion of counted steps begins
    output logic           run_o,       // a run at constant speed begins
    output logic           halt_o,      // the motion stops immediately
    output logic           speed_o,     // 0: stop request for a speed run
    output logic           mode_o       // register SPEED_MODE
);

  logic limits_q, endless_q, good, free, begins;

  // A stall only stops a running motion, so it does not prevent a start.
  assign good = act_i && legal_i && !ext_i && !key_i;
  assign free = !busy_i && !settings_i.free && !locked_i;

  assign start_o = good && order_i.op == I_STEP && free && limits_q;
  assign begins = good && order_i.op == I_RUN && order_i.data[0];
  assign run_o = begins && free && settings_i.vmax != '0;
  assign halt_o = ext_i || stall_i || key_i || (act_i && order_i.op == I_ABORT) ||
      (act_i && legal_i && order_i.op == I_FREE && order_i.data[0]);
  assign speed_o = mode_o || (begins && busy_i && endless_q);

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) mode_o <= 1'b0;
    else if (halt_o) mode_o <= 1'b0;
    else if (act_i && legal_i && order_i.op == I_RUN && !order_i.data[0]) mode_o <= 1'b0;
    else mode_o <= run_o || speed_o;
  end

  // limits_q: VSTART and VSTOP are at most VMAX. It is one cycle late; no instruction can change them in
  // between.
  always_ff @(posedge clk_i) begin
    limits_q <= {2'b00, settings_i.vstart} <= settings_i.vmax && {2'b00, settings_i.vstop} <= settings_i.vmax;
    if (start_o || run_o) endless_q <= run_o;
  end

  logic unused_bits;
  assign unused_bits = &{1'b0, order_i, settings_i};

`ifndef SYNTHESIS
  `PPMC_ASSERT(p006_sta_14, !((start_o || run_o) && halt_o))
  `PPMC_ASSERT(p006_sta_16, !mode_o || busy_i)
`endif

endmodule

`default_nettype wire
