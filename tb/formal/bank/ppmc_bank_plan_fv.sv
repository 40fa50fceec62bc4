// SPDX-License-Identifier: Apache-2.0
// ppmc_bank_plan_fv: proves when a byte is accepted, which actions require a byte, that GO acts once, and
// the times of a start and of GO.
`include "ppmc_fv.svh"
`default_nettype none

module ppmc_bank_plan_fv
  import ppmc_bank_pkg::*;
  import ppmc_code_pkg::*;
  import ppmc_motion_pkg::*;
(
    input wire logic                 clk_i,
    input wire motion_state_t        motion_i,
    input wire interval_t            interval_i,
    input wire init_state_t          init_state_i,
    input wire output_state_t        outputs_i,
    input wire logic                 hold_end_i,
    input wire pin_status_t          pin_status_i,
    input wire compare_t             compare_i,
    input wire logic                 builder_free_i,
    input wire logic                 extra_time_i,
    input wire in_buf_t              in_buf_i,
    input wire logic                 in_buf_new_i,
    input wire decoded_t             decoded_i,
    input wire cmd_error_e           param_error_i,
    input wire parser_state_t        parser_i,
    input wire logic          [17:0] after_low_i
);

  localparam int unsigned Quantum = 25, Round = 32, WidthCycles = 20 * Quantum;  // cycles

  parser_state_t parser_o;
  logic take_o, restart_time_o;
  logic [7:0] code_o;
  logic [31:0] params_o;
  decision_t decision_o;
  logic [17:0] add_cycles_o;
  logic completes_init;  // 1: the byte is the last byte of an initialisation

  `FV_RESET

  ppmc_bank_plan #(
      .Quantum (Quantum),
      .Round   (Round),
      .TimeBits(18)
  ) dut (
      .*
  );

  assign completes_init =
      !in_buf_i.is_command && parser_i.code[7:6] == 2'b00 && !parser_i.error && parser_i.number == 3'd1;

  logic go;  // 1: GO acts on this axis
  logic host_action;  // 1: an action that a host requests with a byte
  assign go = compare_i.go && pin_status_i.in_group;
  assign host_action =
      decision_o.start || decision_o.init || decision_o.exc_off || decision_o.switching || decision_o.read ||
      decision_o.halt || decision_o.flag_stop;

  `FV_ASSUME(no_pulse_at_standstill, motion_i.busy || !(motion_i.more_pulses || motion_i.pulse_low))
  `FV_ASSUME(valid_kind, decoded_i.kind <= CmdAuxOff && decoded_i.params <= 3'd4)

  logic bank_hsk_02_accepts_no_byte_holds;
  assign bank_hsk_02_accepts_no_byte_holds =
      !take_o || !(decision_o.finish || decision_o.init_done || decision_o.chop_edge ||
      decision_o.go_accept || decision_o.go_reject || go);
  `FV_ASSERT(bank_hsk_02_accepts_no_byte, bank_hsk_02_accepts_no_byte_holds)
  `FV_ASSERT(bank_hsk_01_accepts_only_new_bytes, !take_o || in_buf_new_i)
  `FV_ASSERT(bank_hsk_05_waits_for_builder, !(take_o && completes_init) || builder_free_i)
  logic bank_hsk_02_accepts_otherwise_holds;
  assign bank_hsk_02_accepts_otherwise_holds =
      take_o || !in_buf_new_i || decision_o.finish || init_state_i.building || go || decision_o.chop_edge ||
      (completes_init && !builder_free_i);
  `FV_ASSERT(bank_hsk_02_accepts_otherwise, bank_hsk_02_accepts_otherwise_holds)
  `FV_ASSERT(host_action_needs_a_byte, take_o || !host_action)
  `FV_ASSERT(bank_grp_02_accepted_or_rejected, 2'(decision_o.go_accept) + 2'(decision_o.go_reject) == 2'(go))
  `FV_ASSERT(bank_grp_02_reject_is_an_error, !decision_o.go_reject || parser_o.error)
  logic bank_grp_02_first_pulse_holds;
  assign bank_grp_02_first_pulse_holds =
      !decision_o.go_accept || (restart_time_o && add_cycles_o == 18'(WidthCycles - Round));
  `FV_ASSERT(bank_grp_02_first_pulse, bank_grp_02_first_pulse_holds)
  `FV_ASSERT(bank_mot_01_first_pulse,
             !decision_o.start || (restart_time_o && add_cycles_o == 18'(WidthCycles - Round)))
  `FV_ASSERT(bank_mot_04_no_edge_at_the_end,
             !decision_o.finish || !(decision_o.pulse || decision_o.pulse_end || decision_o.start))
  `FV_ASSERT(p104_err_00_no_action_on_error, !(take_o && parser_o.error) || !host_action)
  `FV_COVER(seen_go, decision_o.go_accept && in_buf_new_i)
  `FV_COVER(seen_start, decision_o.start && take_o)

endmodule

`default_nettype wire
