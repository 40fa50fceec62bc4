// SPDX-License-Identifier: Apache-2.0
// ppmc_bank_plan_fv: proves the limits of a visit's decisions: when a byte is accepted, which actions require
// a byte, that GO is acted on once, and the times of a start and of GO.
`include "ppmc_fv.svh"
`default_nettype none

module ppmc_bank_plan_fv
  import ppmc_bank_pkg::*;
  import ppmc_code_pkg::*;
  import ppmc_motion_pkg::*;
(
    input wire logic                 clk_i,
    input wire walk_t                walk_i,
    input wire pace_t                pace_i,
    input wire setting_t             setting_i,
    input wire rest_t                rest_i,
    input wire logic                 over_i,
    input wire seen_t                seen_i,
    input wire facts_t               facts_i,
    input wire logic                 free_i,
    input wire logic                 extra_i,
    input wire mail_t                mail_i,
    input wire logic                 new_i,
    input wire decoded_t             decoded_i,
    input wire cmd_error_e           value_i,
    input wire parser_state_t        asking_i,
    input wire logic          [17:0] due_i,
    input wire logic          [17:0] after_i
);

  localparam int unsigned Quantum = 25, Round = 32, Width = 20 * Quantum;  // cycles

  parser_state_t asking_o;
  logic take_o, anew_o;
  logic [7:0] code_o;
  logic [31:0] params_o;
  plan_t plan_o;
  logic [17:0] add_o;
  logic last;  // the byte is the last one of an initialisation

  `FV_RESET

  ppmc_bank_plan #(
      .Quantum (Quantum),
      .Round   (Round),
      .TimeBits(18)
  ) dut (
      .*
  );

  assign last = !mail_i.command && asking_i.code[7:6] == 2'b00 && !asking_i.error && asking_i.number == 3'd1;

  `FV_ASSUME(at_rest_nothing_runs, walk_i.busy || !(walk_i.run || walk_i.low))
  `FV_ASSUME(known_kind, decoded_i.kind <= CmdAuxOff && decoded_i.params <= 3'd4)

  logic bank_hsk_02_takes_none_holds;
  assign bank_hsk_02_takes_none_holds =
      !take_o || !(plan_o.finish || plan_o.ready || plan_o.toggle || plan_o.proceed || plan_o.refuse ||
      (facts_i.go && seen_i.mask));
  `FV_ASSERT(bank_hsk_02_takes_none, bank_hsk_02_takes_none_holds)
  `FV_ASSERT(bank_hsk_01_takes_what_is_new, !take_o || new_i)
  `FV_ASSERT(bank_hsk_05_waits_for_the_builder, !(take_o && last) || free_i)
  logic bank_hsk_02_takes_the_others_holds;
  assign bank_hsk_02_takes_the_others_holds =
      take_o || !new_i || plan_o.finish || setting_i.building || (facts_i.go && seen_i.mask) ||
      plan_o.toggle || (last && !free_i);
  `FV_ASSERT(bank_hsk_02_takes_the_others, bank_hsk_02_takes_the_others_holds)
  logic a_byte_for_what_a_host_wants_holds;
  assign a_byte_for_what_a_host_wants_holds =
      take_o || !(plan_o.start || plan_o.init || plan_o.exc_off || plan_o.switching || plan_o.read ||
      plan_o.halt || plan_o.flag_stop);
  `FV_ASSERT(a_byte_for_what_a_host_wants, a_byte_for_what_a_host_wants_holds)
  `FV_ASSERT(
      bank_grp_02_goes_on_or_is_refused,
      (plan_o.proceed || plan_o.refuse) == (facts_i.go && seen_i.mask) && !(plan_o.proceed && plan_o.refuse))
  `FV_ASSERT(bank_grp_02_refused_is_an_error, !plan_o.refuse || asking_o.error)
  `FV_ASSERT(bank_grp_02_first_pulse,
             !plan_o.proceed || plan_o.finish || plan_o.rise || (anew_o && add_o == due_i))
  `FV_ASSERT(bank_mot_01_first_pulse, !plan_o.start || (anew_o && add_o == 18'(Width - Round)))
  `FV_ASSERT(bank_mot_04_ends_at_rest, !plan_o.finish || !(plan_o.pulse || plan_o.rise || plan_o.start))
  logic p104_err_00_nothing_by_a_fault_holds;
  assign p104_err_00_nothing_by_a_fault_holds =
      !(take_o && asking_o.error) || !(plan_o.start || plan_o.init || plan_o.exc_off || plan_o.switching ||
      plan_o.read || plan_o.halt || plan_o.flag_stop);
  `FV_ASSERT(p104_err_00_nothing_by_a_fault, p104_err_00_nothing_by_a_fault_holds)
  `FV_COVER(seen_go, plan_o.proceed && new_i)
  `FV_COVER(seen_start, plan_o.start && take_o)

endmodule

`default_nettype wire
