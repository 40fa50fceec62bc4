// SPDX-License-Identifier: Apache-2.0
// Assertion macros: Boolean properties with $past only, so that one line runs in Verilator and proves under
// read_slang.
// The label is the rule (or block contract) it guards. Uses clk_i and rst_ni of the module it stands in.
`ifndef PPMC_ASSERT_SVH
`define PPMC_ASSERT_SVH

`define PPMC_ASSERT(label_, prop_) \
  label_ : assert property (@(posedge clk_i) disable iff (!rst_ni) (prop_));

`endif
