// SPDX-License-Identifier: Apache-2.0
// ppmc_proc_time_fv: with DATASHEET times, proves that each action takes effect once and in order, and that
// the mailbox opens again. A clock cycle has 3 crystal cycles, so that the times are short.
`include "ppmc_fv.svh"
`default_nettype none

module ppmc_proc_time_fv
  import ppmc_code_pkg::*;
(
    input wire logic       clk_i,
    input wire logic [3:0] what_i,
    input wire logic [7:0] code_i
);

  localparam int unsigned Longest = 200;  // time limit in cycles; not for an initialisation

  action_t act_i, act_o;
  logic [ 7:0] code_o;
  logic [31:0] params_o;
  logic [ 2:0] base_o;
  logic open_o, phase_init_o, ready_o, go_o, end_delay_o;

  `FV_RESET

  ppmc_proc_time #(
      .Datasheet(1'b1),
      .ClkHz    (1_000_000),
      .XtalHz   (3_000_000)
  ) dut (
      .params_i     (32'd0),
      .code_held_i  (8'd0),
      .params_held_i(32'd0),
      .base_i       (3'd0),
      .initialised_i(1'b1),
      .building_i   (1'b0),
      .steps_i      (14'd4),
      .ramp_i       (1'b1),
      .single_i     (1'b0),
      .stop_i       (1'b0),
      .pulse_i      (1'b0),
      .last_i       (1'b0),
      .final_i      (1'b0),
      .*
  );

  // Stimulus: at most one action in a cycle, and only while the mailbox is open. No initialisation is
  // requested, because it takes too long.
  always_comb begin
    act_i = '0;
    if (open_o && rst_ni) begin
      unique case (what_i)
        4'd1: act_i.decel = 1'b1;
        4'd2: act_i.exc_off = 1'b1;
        4'd3: act_i.aux_on = 1'b1;
        4'd4: act_i.aux_off = 1'b1;
        4'd5: act_i.aux_out = 1'b1;
        4'd6: act_i.read = 1'b1;
        4'd7: act_i.switching = 1'b1;
        default: ;
      endcase
    end
  end

  logic wait_q;  // 1: an action was requested and has not taken effect yet
  action_t asked_q;
  logic [7:0] age_q;  // cycles since the request
  action_t at_once;
  always_comb begin
    at_once           = '0;
    at_once.read      = act_i.read;
    at_once.switching = act_i.switching;
  end

  always_ff @(posedge clk_i)
    if (!rst_ni) {wait_q, asked_q, age_q} <= '0;
    else begin
      age_q <= age_q + 1'b1;
      if ((act_i & ~at_once) != '0) {wait_q, asked_q, age_q} <= {1'b1, act_i, 8'd0};
      else if (act_o != '0) wait_q <= 1'b0;
    end

  `FV_ASSERT(at_once_or_later, act_o == at_once || (wait_q && act_o == asked_q))
  `FV_ASSERT(in_time, !wait_q || age_q <= 8'(Longest))
  `FV_ASSERT(p104_ds_01_closed_meanwhile, !(wait_q && open_o))
  `FV_ASSERT(p104_ds_01_opens_again, wait_q || open_o)
  `FV_COVER(seen_delayed, act_o.exc_off && wait_q)

endmodule

`default_nettype wire
