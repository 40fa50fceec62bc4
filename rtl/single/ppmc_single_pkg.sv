// SPDX-License-Identifier: Apache-2.0
// ppmc_single_pkg: what ppmc_single and the part around it tell each other, and what makes two parts differ.
// Rules:  none of its own.
// How:    the byte at hand goes out (sent_t), its meaning comes back (meaning_t); with that meaning the parameters are
//         whole and go out (asked_t), and the verdict on them comes back (verdict_t). Four bundles and not two, so
//         that none of them depends on itself.
`default_nettype none

package ppmc_single_pkg;

  // A design uses only some of these constants.
  // verilator lint_off UNUSEDPARAM

  import ppmc_code_pkg::*;
  import ppmc_motion_pkg::*;

  // What makes the parts with one axis differ beside the meaning of their bytes.
  typedef struct packed {
    int unsigned step_bits;     // of PA, at most 16
    int unsigned steps_min;     // smallest PA
    int unsigned steps_max;     // largest PA
    int unsigned quantum_xtal;  // crystal cycles a quantum
    int unsigned fast_quanta;   // fast internal base clock, quanta a period
    int unsigned slow_quanta;   // slow internal base clock
    int unsigned extra_quanta;  // extra time of an interval; 0: there is none
    int unsigned hold_quanta;   // time at rest until HOLD
    int unsigned hold_rest;     // clk more
    int unsigned chop_unit;     // quanta a unit of the chopper's times; 0: no units
    int unsigned chop_bits;     // bits of the chopper's base times that count
    // 1: the J105 STMC's rules of stops and ends. No pulse output, so that the last pulse ends the motion; a stop at
    // the start-up rate, and a slow-down limit in a search for the origin, end it at once; bit 7 of the finish status
    // is always 1; ramps have no processing times of their own.
    bit          stmc_ends;
  } traits_t;

  // The byte at hand and where it stands.
  typedef struct packed {
    logic [7:0]  data;    // the byte
    logic [2:0]  left;    // parameters to come, this byte included
    logic [7:0]  held;    // code that parameters are collected for
    logic [31:0] params;  // those that came, the last one in the high bits
  } sent_t;

  // What the byte means in this part.
  typedef struct packed {
    decoded_t   decoded;  // as a code
    logic [7:0] data;     // as a parameter: how it is kept
  } meaning_t;

  // What the host asks for, with the byte at hand.
  typedef struct packed {
    logic [7:0]  code;    // code that an action belongs to, FAST or at its C-event
    logic [31:0] params;  // its parameters, the last one in the high bits
  } asked_t;

  // What the part says to it.
  typedef struct packed {
    error_e      value;   // what is wrong with asked_t.params; ErrUndefined: nothing
    logic        judged;  // value counts for the code that is held
    logic [2:0]  select;  // what the read code shows
    logic [31:0] setup;   // sent_t.params as an initialisation sets them
  } verdict_t;

  // Pins of the motor, each a flip-flop.
  typedef struct packed {
    logic [5:1] s;       // phases
    logic       hold;    // at rest for the hold time
    logic       pout_n;  // pulse, L = active
    logic       dir;     // 0 = CW
  } motor_t;

  // verilator lint_on UNUSEDPARAM

endpackage

`default_nettype wire
