// SPDX-License-Identifier: Apache-2.0
// stmc_fv: proves a complete STMC from its bus pins to its motor pins, with TIMING = "FAST", a clock of 8 MHz
// and a crystal of 16 MHz (a pulse has 40 cycles, a quantum 2 cycles). A word of the ramp table may have
// any value in every cycle, and a table build takes five cycles. Host, switches, clock pin and reset pin are
// unconstrained. The part has no pulse output: a pulse is a change of the phases from one row of the phase
// table to another.
`include "ppmc_fv.svh"
`default_nettype none

module stmc_fv
  import ppmc_code_pkg::*;
  import ppmc_motion_pkg::*;
(
    input wire logic       clk_i,
    input wire logic       pin_rst_n,
    input wire logic       a0,
    input wire logic       cs_n,
    input wire logic       rd_n,
    input wire logic       wr_n,
    input wire logic [7:0] d_i,
    input wire logic       ext_clk,
    input wire logic       l1_n,
    input wire logic       l2_n,
    input wire logic       l3_n,
    input wire logic       l4_n,
    input wire logic       cnp_n,
    input wire logic       mon
);

  localparam bit IdleLevel = 1'b0;
  logic [7:0] d_o;
  logic d_oe, int_n, hold;
  logic [5:1] s;

  `FV_RESET

  stmc #(
      .CLK_HZ    (8_000_000),
      .XTAL_HZ   (16_000_000),
      .PHASE_IDLE(IdleLevel)
  ) dut (
      .clk  (clk_i),
      .rst_n(rst_ni && pin_rst_n),
      .*
  );

  logic [4:0] lines_hq;

  `include "single/ppmc_single_part.svh"
  `include "single/ppmc_axis_part.svh"

  assign limit_cw_n = l1_n;
  assign limit_ccw_n = l2_n;
  assign alarm_n = mon;
  assign moved = homed_q && lines_hq != lines && lines_hq != '0 && lines != '0;
  assign positive_now = code_q[3];
  assign is_read = wr_a0 && wr_data[7] && wr_data[6:3] == '0 && wr_data[2:0] <= 3'd3;
  assign pins_at_rest = s == '0 && int_n && !d_oe;

  always_ff @(posedge clk_i or negedge on)
    if (!on) lines_hq <= '0;
    else lines_hq <= lines;

  `FV_ASSERT(no_pulse_at_standstill, !moved || busy_h[1])

  `FV_COVER(seen_limit, blocked_q && ccw_q && busy_h[1])
  `FV_COVER(seen_answer, load && complete_q)
  `FV_COVER(seen_step, moved && index_q == 4'd2)
  `FV_COVER(ready_seen, alarm_age_q > 6'd1 && busy_h[0] && !motion.busy && complete_q)

endmodule

`default_nettype wire
