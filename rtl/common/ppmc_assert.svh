// SPDX-License-Identifier: Apache-2.0
// Assertion macros for Boolean properties that use only $past, so that one line works both in Verilator and
// in proofs with read_slang. The label is the rule (or the contract of the block) that the assertion
// checks. The macro uses clk_i and rst_ni of the module that contains it. Flip-flops have an
// asynchronous reset, but Verilator counts `disable iff` as a synchronous use of it (SYNCASYNCNET).
`ifndef PPMC_ASSERT_SVH
`define PPMC_ASSERT_SVH

`define PPMC_ASSERT(label_, prop_) \
  /* verilator lint_save */ /* verilator lint_off SYNCASYNCNET */ \
  label_ : assert property (@(posedge clk_i) disable iff (!rst_ni) (prop_)); \
  /* verilator lint_restore */

`endif
