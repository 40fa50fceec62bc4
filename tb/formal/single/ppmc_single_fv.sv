// SPDX-License-Identifier: Apache-2.0
// ppmc_single_fv: ppmc_single in a PPMC-104 with its decoder. For any bus accesses and switches, proves
// that each block fulfils the assumptions in the proofs of the other blocks, and that an error is
// valid until the next byte is accepted.
`include "ppmc_fv.svh"
`default_nettype none

module ppmc_single_fv
  import ppmc_code_pkg::*;
(
    input wire logic       clk_i,
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

  logic [7:0] d_o;
  logic d_oe, int_n, aux_n, hold, pout_n, dir;
  logic [3:0] auxo;
  logic [5:1] s;

  `FV_RESET

  ppmc104 dut (
      .clk  (clk_i),
      .rst_n(rst_ni),
      .*
  );

  logic on;  // 1: the device is out of reset
  action_t act;
  logic busy, building, init_open_q;
  logic [31:0] ramp_data;  // parameters of the ramp that is being built
  logic [15:0] rates;  // rates of the current ramp
  decoded_t decoded;

  assign on        = dut.rst_core_n;
  assign act       = dut.u_single.act_o;
  assign busy      = dut.u_single.motion_o.busy;
  assign building  = dut.u_single.building;
  assign ramp_data = dut.u_single.check_result_i.setup;
  assign rates     = {dut.u_single.slow, dut.u_single.fast};
  assign decoded   = dut.u_single.decoded_byte_i.decoded;

  always_ff @(posedge clk_i) init_open_q <= on && (act.init || (init_open_q && !dut.u_single.ready_init));

  // These assertions are assumptions in the proofs of axis, finish status, table, builder, setup, mailbox,
  // command and command check.
  `FV_ASSERT(start_at_rest, !on || !act.start || !(busy || dut.u_single.event_now.done || building))
  `FV_ASSERT(table_once, !on || !(act.init && building))
  `FV_ASSERT(ramp_stands, !$past(on) || !busy || rates == $past(rates))
  `FV_ASSERT(ramp_stands_while_built, !($past(on && building) && building) || ramp_data == $past(ramp_data))
  `FV_ASSERT(home_in_the_first, !on || !dut.u_single.phase_init || !dut.u_single.initialised)
  `FV_ASSERT(ready_behind_init, !on || !dut.u_single.ready_init || init_open_q)
  `FV_ASSERT(init_alone, !on || !(act.exc_off && (act.init || init_open_q)) && !(act.init && init_open_q))
  `FV_ASSERT(take_when_ready, !on || !dut.u_single.take || dut.u_single.ready)
  `FV_ASSERT(known_kind, decoded.kind <= CmdAuxOff && decoded.params <= 3'd4)
  `FV_ASSERT(params_fit_the_kind,
             decoded.params == '0 || decoded.kind inside {CmdInit, CmdOperation, CmdSwitching, CmdAuxOut})

  `FV_ASSERT(p104_sta_04_error_stands, !$past(on) || $past(dut.u_single.take) || dut.u_single.status == $past
             (dut.u_single.status))
  `FV_COVER(seen_error, dut.u_single.status[3] && dut.u_single.ready)
  `FV_COVER(seen_init, building)

endmodule

`default_nettype wire
