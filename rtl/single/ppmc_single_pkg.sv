// SPDX-License-Identifier: Apache-2.0
// ppmc_single_pkg: types of the signals between ppmc_single and the device that contains it, and the
//         configuration of the device.
// Rules:  see ppmc_single.
// How:    ppmc_single outputs the current byte (rx_byte_t). The device returns the decoded byte
//         (decoded_byte_t). ppmc_single then outputs the command with all its parameters (command_req_t).
//         The device checks this command and returns the result (check_result_t). There are four structs
//         instead of two, so that no struct depends combinationally on itself.
`default_nettype none

package ppmc_single_pkg;

  // A design uses only some of the items of this package.
  // verilator lint_off UNUSEDPARAM

  import ppmc_code_pkg::*;
  import ppmc_motion_pkg::*;

  // Differences between the single-axis devices, except the decoding of their bytes.
  typedef struct packed {
    int unsigned step_bits;         // bits of PA, at most 16
    int unsigned steps_min;         // smallest PA
    int unsigned steps_max;         // largest PA
    int unsigned quantum_xtal;      // crystal cycles per quantum
    int unsigned fast_quanta;       // period of the fast internal base clock in quanta
    int unsigned slow_quanta;       // period of the slow internal base clock in quanta
    int unsigned extra_quanta;      // extra time of an interval in quanta; 0: no extra time
    int unsigned hold_quanta;       // quanta from standstill to HOLD
    int unsigned hold_rest_cycles;  // cycles added to hold_quanta
    int unsigned chop_unit;         // unit of the chopper times in quanta; 0: no units
    int unsigned chop_bits;         // used bits of the chopper base times
    // 1: rules of the J105 STMC for stops and ends. There is no pulse output, so the last pulse ends the
    // motion. A stop at the start-up rate, and a slow-down limit in an origin search, end the motion
    // immediately. Bit 7 of the finish status is always 1. Ramps have no separate processing times.
    bit          stmc_stop_rules;
  } part_cfg_t;

  // Current byte and its position in the command.
  typedef struct packed {
    logic [7:0] data;  // byte from the host
    logic [2:0] params_left;  // missing parameters, including this byte
    logic [7:0] code_held;  // code to which the parameters belong
    logic [31:0] params;  // parameters received so far; the last one is in bits 31:24
  } rx_byte_t;

  // Decoded form of the current byte.
  typedef struct packed {
    decoded_t   decoded;  // byte decoded as a code
    logic [7:0] data;     // byte as a parameter, in the stored form
  } decoded_byte_t;

  // Command that the host requests with the current byte.
  typedef struct packed {
    logic [7:0]  code;    // code of the action; with DATASHEET valid only when the byte is accepted
    logic [31:0] params;  // parameters of code; the last one is in bits 31:24
  } command_req_t;

  // Result of the check of command_req_t.
  typedef struct packed {
    cmd_error_e  error;       // error of command_req_t.params; ErrUndefined: no error
    logic        is_checked;  // 1: error applies to code_held
    logic [2:0]  select;      // data that the read code selects
    logic [31:0] setup;       // rx_byte_t.params as RL, RH and PA of an initialisation
  } check_result_t;

  // Pins of the motor; each is a register.
  typedef struct packed {
    logic [5:1] s;       // phases
    logic       hold;    // high: at standstill for at least the hold time
    logic       pout_n;  // pulse, active low
    logic       dir;     // 0: CW, 1: CCW
  } motor_t;

  // verilator lint_on UNUSEDPARAM

endpackage

`default_nettype wire
