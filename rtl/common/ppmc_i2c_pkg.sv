// SPDX-License-Identifier: Apache-2.0
// ppmc_i2c_pkg: commands of the I2C master.
// Rules:  docs/pmc006/README.md, 14 (EEPROM).
`default_nettype none

package ppmc_i2c_pkg;

  // A design uses only some of the items of this package.
  // verilator lint_off UNUSEDPARAM

  typedef enum logic [2:0] {
    CmdNone,
    CmdStart,
    CmdStop,
    CmdByte,
    CmdFree    // clock pulses until SDA is high, at most nine
  } i2c_cmd_e;

  // verilator lint_on UNUSEDPARAM

endpackage

`default_nettype wire
