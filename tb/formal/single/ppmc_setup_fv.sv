// SPDX-License-Identifier: Apache-2.0
// ppmc_setup_fv: proves that motor type, step type and polarity do not change between the first
// initialisation and Excitation OFF, and that operations require a complete initialisation.
`include "ppmc_fv.svh"
`default_nettype none

module ppmc_setup_fv
  import ppmc_code_pkg::*;
(
    input wire logic       clk_i,
    input wire logic       init_i,
    input wire init_code_t code_i,
    input wire logic       phase_init_i,
    input wire logic       positive_i,
    input wire logic       ready_i,
    input wire logic       off_i
);

  setup_t setup_o;
  logic   initialised_o;

  `FV_RESET

  ppmc_setup dut (.*);

  logic open_q;  // 1: an initialisation is in progress
  always_ff @(posedge clk_i) open_q <= rst_ni && (init_i || (open_q && !ready_i));

  // ppmc_proc_time asserts phase_init_i only in the first initialisation. An initialisation that has begun
  // also ends.
  `FV_ASSUME(home_in_the_first, !phase_init_i || !initialised_o)
  `FV_ASSUME(ready_behind_init, !ready_i || open_q)
  `FV_ASSUME(one_at_a_time, !(off_i && (init_i || open_q)) && !(init_i && open_q))

  logic homed_q;
  always_ff @(posedge clk_i) homed_q <= rst_ni && (homed_q || phase_init_i);

  `FV_ASSERT(p104_ini_06_motor_frozen, !($past(rst_ni && initialised_o && !off_i)
             && initialised_o) || {setup_o.motor, setup_o.half, setup_o.positive} == $past
             ({setup_o.motor, setup_o.half, setup_o.positive}))
  `FV_ASSERT(p104_phs_02_idle_polarity_of_reset, homed_q || !setup_o.positive)
  `FV_ASSERT(p104_ini_08_ready_starts_operations, !$past(rst_ni && !initialised_o && !ready_i)
             || !initialised_o)
  `FV_ASSERT(p104_phs_05_off_ends_it, !$past(rst_ni && off_i) || !(initialised_o || setup_o.chop))
  `FV_ASSERT(p104_ini_05_clock_taken, !$past(rst_ni && init_i) || setup_o.external == $past(code_i.external))
  `FV_ASSERT(p104_ini_05_clock_kept, $past(init_i || !rst_ni) || setup_o.external == $past(setup_o.external))
  `FV_COVER(seen_second,
            initialised_o && setup_o.chop && setup_o.external && setup_o.motor != code_i.motor && init_i)

endmodule

`default_nettype wire
