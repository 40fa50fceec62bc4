// SPDX-License-Identifier: Apache-2.0
// ppmc_build_pkg: identification of the sources of a bitstream, for operation VERSION. The tools of this
//         project pass the value as macro PPMC_BUILD (openppmc/sources.py). With other tools, the
//         value is 0, which means "unknown".
// Rules:  docs/uart_bridge.md, UB-VER.
`default_nettype none

package ppmc_build_pkg;

  // Designs without a UART bridge do not use the constant.
  // verilator lint_off UNUSEDPARAM

`ifndef PPMC_BUILD
  `define PPMC_BUILD 128'h0
`endif

  localparam logic [127:0] BUILD_ID = `PPMC_BUILD;  // first byte of the answer in bits 7:0

  // verilator lint_on UNUSEDPARAM

endpackage

`default_nettype wire
