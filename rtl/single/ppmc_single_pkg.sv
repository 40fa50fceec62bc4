// SPDX-License-Identifier: Apache-2.0
// ppmc_single_pkg: types that connect ppmc_single with the device around it, and the device configuration.
// Rules:  those of ppmc_single.
// How:    ppmc_single outputs the current byte (rx_byte_t), and the device returns the meaning of this byte
//         (decoded_byte_t). From both, ppmc_single forms the command with all its parameters and outputs it
//         (command_req_t), and the device returns the result of the check of this command (check_result_t).
//         There are four structs instead of two, so that no struct depends combinationally on itself.
`default_nettype none

package ppmc_single_pkg;

  // A design uses only some of the items of this package.
  // verilator lint_off UNUSEDPARAM

  import ppmc_code_pkg::*;
  import ppmc_motion_pkg::*;

  // Differences between the single-axis devices, in addition to the meaning of their bytes.
  typedef struct packed {
    int unsigned step_bits;         // bits of PA, at most 16
    int unsigned steps_min;         // smallest PA
    int unsigned steps_max;         // largest PA
    int unsigned quantum_xtal;      // crystal cycles in a quantum
    int unsigned fast_quanta;       // period of the fast internal base clock, quanta
    int unsigned slow_quanta;       // period of the slow internal base clock, quanta
    int unsigned extra_quanta;      // extra time of an interval, quanta; 0: no extra time
    int unsigned hold_quanta;       // time at standstill until HOLD, quanta
    int unsigned hold_rest_cycles;  // cycles added to hold_quanta
    int unsigned chop_unit;         // quanta in a unit of the chopper times; 0: no units
    int unsigned chop_bits;         // used bits of the chopper base times
    // 1: stop and end rules of the J105 STMC. There is no pulse output, so the last pulse ends the motion. A
    // stop at the start-up rate, and a slow-down limit in an origin search, end the motion
    // immediately. Bit 7 of the finish status is always 1. Ramps have no separate processing times.
    bit          stmc_stop_rules;
  } part_cfg_t;

  // Current byte and its position in the command.
  typedef struct packed {
    logic [7:0] data;  // byte from the host
    logic [2:0] params_left;  // remaining parameters, including this byte
    logic [7:0] code_held;  // code whose parameters are being collected
    logic [31:0] params;  // parameters received so far, the last in the high bits
  } rx_byte_t;

  // Meaning of the current byte in this device.
  typedef struct packed {
    decoded_t   decoded;  // byte as a code
    logic [7:0] data;     // byte in the form in which parameters are stored
  } decoded_byte_t;

  // Command that the host requests with the current byte.
  typedef struct packed {
    logic [7:0]  code;    // code of an action, in FAST or at its C-event
    logic [31:0] params;  // parameters of code, the last in the high bits
  } command_req_t;

  // Result of the check of command_req_t.
  typedef struct packed {
    cmd_error_e  error;       // error in command_req_t.params; ErrUndefined: no error
    logic        is_checked;  // error applies to code_held
    logic [2:0]  select;      // data selected by the read code
    logic [31:0] setup;       // rx_byte_t.params as an initialisation sets them
  } check_result_t;

  // Pins of the motor, each registered.
  typedef struct packed {
    logic [5:1] s;       // phases
    logic       hold;    // at standstill for the hold time
    logic       pout_n;  // pulse, L = active
    logic       dir;     // 0 = CW
  } motor_t;

  // verilator lint_on UNUSEDPARAM

endpackage

`default_nettype wire
