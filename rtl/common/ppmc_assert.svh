// SPDX-License-Identifier: Apache-2.0
// Assertion macro for Boolean properties whose only temporal operator is $past. The same source line works in
// the simulator Verilator and in proofs with read_slang. label_ names the rule, or the contract of the block,
// that the assertion checks. The macro uses clk_i and rst_ni of the module in which it is used. It disables
// the warning SYNCASYNCNET, because Verilator counts `disable iff` as a synchronous use of the asynchronous
// reset.
`ifndef PPMC_ASSERT_SVH
`define PPMC_ASSERT_SVH

`define PPMC_ASSERT(label_, prop_) \
  /* verilator lint_save */ /* verilator lint_off SYNCASYNCNET */ \
  label_ : assert property (@(posedge clk_i) disable iff (!rst_ni) (prop_)); \
  /* verilator lint_restore */

`endif
