// SPDX-License-Identifier: Apache-2.0
// Macros of the proofs (docs/proofs.md): Boolean properties, $past at most. A wrapper has the clock clk_i; FV_RESET
// makes rst_ni, low in the first clk only. A cover is a trace that must exist from reset on: FV_COVERS makes of it an
// assertion that has to fail, and hides the others.
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
