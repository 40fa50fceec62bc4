// SPDX-License-Identifier: Apache-2.0
// Macros for proofs (docs/proofs.md) of Boolean properties whose only temporal operator is $past.
// A wrapper (the module of a proof) has the clock clk_i. FV_RESET defines rst_ni, which is low only in
// the first cycle.
// A cover property requires a witness trace that begins with a reset. If FV_COVERS is defined, FV_COVER is
// an assertion that must fail, and FV_ASSERT is empty.
`ifndef PPMC_FV_SVH
`define PPMC_FV_SVH

`define FV_RESET \
  logic rst_ni = 1'b0; \
  always_ff @(posedge clk_i) rst_ni <= 1'b1;

`define FV_ASSUME(label_, prop_) \
  label_ : assume property (@(posedge clk_i) disable iff (!rst_ni) (prop_));

`ifdef FV_COVERS
`define FV_ASSERT(label_, prop_)
`define FV_COVER(label_, prop_) \
  label_ : assert property (@(posedge clk_i) disable iff (!rst_ni) (!(prop_)));
`else
`define FV_ASSERT(label_, prop_) \
  label_ : assert property (@(posedge clk_i) disable iff (!rst_ni) (prop_));
`define FV_COVER(label_, prop_)
`endif

`endif
