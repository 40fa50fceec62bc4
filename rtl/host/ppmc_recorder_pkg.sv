// SPDX-License-Identifier: Apache-2.0
// ppmc_recorder_pkg: format of the records of a recorder.
// Rules:  UB-REC-02.
`default_nettype none

package ppmc_recorder_pkg;

  // A design uses only some of the items of this package.
  // verilator lint_off UNUSEDPARAM

  localparam int unsigned MIN_TIME_BITS = 14;  // minimum number of time bits per record

  // Number of bytes of a record with `width` levels.
  function automatic int unsigned record_bytes(int unsigned width);
    return (width + MIN_TIME_BITS + 7) / 8;
  endfunction

  // verilator lint_on UNUSEDPARAM

endpackage

`default_nettype wire
