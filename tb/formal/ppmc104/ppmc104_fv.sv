// SPDX-License-Identifier: Apache-2.0
// ppmc104_fv: proves a complete PPMC-104 from its bus pins to its motor pins, with TIMING = "FAST", a clock
// of 8 MHz and a crystal of 16 MHz (a pulse has 40 cycles, a quantum 2 cycles). A word of the ramp table may
// have any value in every cycle, and a table build takes five cycles. Host, switches, clock pin and reset
// pin are unconstrained.
`include "ppmc_fv.svh"
`default_nettype none

module ppmc104_fv
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
    input wire logic       csel,
    input wire logic       vsel,
    input wire logic       clock,
    input wire logic       l1_n,
    input wire logic       l2_n,
    input wire logic       l3_n,
    input wire logic       l4_n,
    input wire logic       cnp_n,
    input wire logic       alm_n,
    input wire logic [3:0] auxi
);

  localparam bit IdleLevel = 1'b1;
  logic [7:0] d_o;
  logic d_oe, int_n, aux_n, hold, pout_n, dir;
  logic [3:0] auxo;
  logic [5:1] s;

  `FV_RESET

  ppmc104 #(
      .CLK_HZ    (8_000_000),
      .XTAL_HZ   (16_000_000),
      .PHASE_IDLE(IdleLevel)
  ) dut (
      .clk  (clk_i),
      .rst_n(rst_ni && pin_rst_n),
      .*
  );

  logic pout_nq;

  `include "single/ppmc_single_part.svh"
  `include "single/ppmc_axis_part.svh"

  assign limit_cw_n = l1_n;
  assign limit_ccw_n = l2_n;
  assign alarm_n = alm_n;
  assign moved = pout_nq && !pout_n;
  assign positive_now = code_q[3];
  assign is_read = wr_a0 && wr_data[7:3] == 5'b10000 && wr_data[2:0] inside {3'd0, 3'd1, 3'd2, 3'd3, 3'd5};
  assign pins_at_rest = pout_n && s == '1 && !dir && int_n && !d_oe && aux_n && auxo == '1;

  always_ff @(posedge clk_i or negedge on)
    if (!on) pout_nq <= 1'b1;
    else pout_nq <= pout_n;

  `FV_ASSERT(no_pulse_at_standstill, pout_n || busy_h[0])
  `FV_ASSERT(no_pulse_with_wrong_dir, pout_n || dir == ccw_q)

  `FV_COVER(seen_limit, blocked_q && ccw_q && busy_h[1])
  `FV_COVER(seen_answer, load && complete_q)
  `FV_COVER(seen_step, moved && index_q == 4'd2)
  `FV_COVER(ready_seen, alarm_age_q > 6'd40 && busy_h[0] && !motion.busy && complete_q)

endmodule

`default_nettype wire
