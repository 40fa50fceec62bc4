// SPDX-License-Identifier: Apache-2.0
// Macros for proofs by induction of blocks that need many cycles from reset to their first action, such as a
// boot or a received byte. A run begins with a reset, or in any state in which the lemmas hold, so that the
// search before the induction finds covers and faults within a few cycles. Reset must satisfy the lemmas.
// FV_ANY_START defines rst_dut_n, the reset of the block, which is free_i in every cycle; assertions are
// disabled in the first cycle. FV_LEMMA asserts a property, and assumes it in the first cycle after that.
`ifndef PPMC_LEMMA_SVH
`define PPMC_LEMMA_SVH

`define FV_ANY_START(free_i_) \
  logic rst_dut_n, later_q; \
  assign rst_dut_n = free_i_; \
  always_ff @(posedge clk_i) later_q <= rst_ni;

`define FV_LEMMA(label_, prop_) \
  `FV_ASSERT(label_, prop_) \
  first_``label_ : assume property (@(posedge clk_i) disable iff (!rst_ni) (later_q || (prop_)));

`endif
