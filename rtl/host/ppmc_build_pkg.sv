// SPDX-License-Identifier: Apache-2.0
// ppmc_build_pkg: what a bitstream was built from, for op VERSION. The tools of this project give it as PPMC_BUILD
//         (scripts/flow/build_id.py); with others it is 0, which says that nobody knows.
// Rules:  docs/uart_bridge.md, UB-VER.
`default_nettype none

package ppmc_build_pkg;

  // A design uses only some of these constants.
  // verilator lint_off UNUSEDPARAM

`ifndef PPMC_BUILD
  `define PPMC_BUILD 128'h0
`endif

  localparam logic [127:0] Build = `PPMC_BUILD;  // first byte of the answer in the low bits

  // verilator lint_on UNUSEDPARAM

endpackage

`default_nettype wire
