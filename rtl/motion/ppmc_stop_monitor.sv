// SPDX-License-Identifier: Apache-2.0
// ppmc_stop_monitor: detects the causes that end or decelerate a motion, and stores them for the finish
//         status.
// Rules:  P104-LIM-01..10, P104-STP-01/03/05, P104-FDC-01/04, P104-END-02/04/05; P2104-FDC-02, P2104-OPR-09;
//         STMC-IN-03/04, STMC-DEC-03..06, STMC-FIN-02/03.
// Timing: stop_o and forced_o are combinational. Therefore a cause that is active in a cycle also acts on a
//         pulse at the end of this cycle.
`include "ppmc_assert.svh"
`default_nettype none

module ppmc_stop_monitor
  import ppmc_motion_pkg::*;
#(
    parameter bit StopAtSlow = 1'b0,  // 1: at the start-up rate, a deceleration request stops immediately
    parameter bit SlowAlways = 1'b0,  // 1: in POUT mode, slow-down limits also act outside the plateau
    parameter bit SlowOrigin = 1'b0   // 1: a slow-down limit ends an origin search immediately
) (
    input  wire logic      clk_i,
    input  wire logic      rst_ni,
    input  wire logic      clear_i,          // strobe: a new operation starts; clear the causes
    input  wire logic      complete_i,       // strobe: the count is complete; clear the causes
    input  wire logic      armed_i,          // 1 before the first pulse and between pulses
    input  wire op_t       op_i,             // current operation
    input  wire switches_t switches_i,       // switches, synchronised
    input  wire logic      top_i,            // 1: the running interval is on the plateau
    input  wire logic      at_start_rate_i,  // 1: the running interval has the start-up rate
    input  wire logic      dec_i,            // 1: the natural deceleration has begun
    input  wire logic      halt_i,           // strobe: immediate stop command
    input  wire logic      decel_i,          // strobe: deceleration stop command
    input  wire logic      slow_i,           // slow_seen_o, directly or delayed; 1: act on a slow-down limit
    output logic           slow_seen_o,      // 1: a slow-down limit is effective; not valid with stop_o
    output logic           stop_o,           // 1: end the motion now, without a further pulse
    output logic           forced_o,         // 1: forced deceleration is requested; not valid with stop_o
    output logic           flagged_o,        // registered: forced deceleration was requested
    output stop_cause_t    cause_o           // causes of the end of the motion; valid until clear_i
);

  logic limit, slow, halt, block, hard, slow_now, decel_now, can_request;
  logic unused_bits;

  assign unused_bits = &{1'b0, op_i.single, op_i.pout_only, top_i, at_start_rate_i};

  assign limit = op_i.ccw ? switches_i.limit_ccw : switches_i.limit_cw;
  assign slow = op_i.ccw ? switches_i.slow_ccw : switches_i.slow_cw;
  assign halt = halt_i || (decel_i && !op_i.ramp);
  assign block = SlowOrigin && op_i.origin && slow;
  assign hard = armed_i && (limit || switches_i.alarm || halt || block || (switches_i.origin && op_i.origin));
  assign stop_o = hard || (StopAtSlow && at_start_rate_i && (slow_now || decel_now));

  // A deceleration can be requested only once. An immediate end at the same edge has priority, but
  // slow_seen_o and forced_o do not include this priority. They are evaluated only together with a
  // pulse, and no pulse occurs at an immediate end.
  assign can_request = armed_i && op_i.ramp && !flagged_o && !dec_i;
  assign slow_seen_o = can_request && slow && (SlowAlways || top_i || !op_i.pout_only);
  assign slow_now = can_request && slow_i;
  assign decel_now = can_request && decel_i;
  assign forced_o = flagged_o || slow_now || decel_now;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      flagged_o <= 1'b0;
      cause_o   <= '0;
    end else if (clear_i || complete_i) begin
      flagged_o <= 1'b0;
      cause_o   <= '0;
    end else begin
      flagged_o <= flagged_o || (!hard && forced_o);
      if (stop_o) begin
        cause_o.alarm <= switches_i.alarm;
        cause_o.limit <= limit;
      end
      cause_o.stop <= cause_o.stop || (!hard && decel_now) || (armed_i && halt);
      cause_o.slow <= cause_o.slow || (!hard && slow_now) || (armed_i && block);
    end
  end

`ifndef SYNTHESIS
  `PPMC_ASSERT(p104_fdc_04, !($past(flagged_o) && !flagged_o) || $past(clear_i || complete_i))
`endif

endmodule

`default_nettype wire
