// SPDX-License-Identifier: Apache-2.0
// Assertion macros: Boolean properties with $past only, so that one line runs in Verilator and proves under
// read_slang.
// The label is the rule (or block contract) it guards. Uses clk_i and rst_ni of the module it stands in.
// The reset of flip-flops is asynchronous; Verilator counts `disable iff` as a synchronous use (SYNCASYNCNET).
`ifndef PPMC_ASSERT_SVH
`define PPMC_ASSERT_SVH

`define PPMC_ASSERT(label_, prop_) \
  /* verilator lint_save */ /* verilator lint_off SYNCASYNCNET */ \
  label_ : assert property (@(posedge clk_i) disable iff (!rst_ni) (prop_)); \
  /* verilator lint_restore */

`endif
