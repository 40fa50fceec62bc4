// SPDX-License-Identifier: Apache-2.0
// ppmc_bank_pkg: register numbers of a bank, types of the signals between its blocks for one axis, and the
//         state of an axis in RAM.
// Rules:  BANK-GEN-01..04, BANK-WIN-01..03.
`default_nettype none

package ppmc_bank_pkg;

  // A design uses only some of the items of this package.
  // verilator lint_off UNUSEDPARAM

  import ppmc_code_pkg::*;
  import ppmc_motion_pkg::*;

  // Registers of the window, a[3:0] (BANK-WIN-02, BANK-WIN-03).
  localparam logic [3:0] REG_DATA = 4'h0;
  localparam logic [3:0] REG_STATUS = 4'h1;
  localparam logic [3:0] REG_CONFIG = 4'h2;
  localparam logic [3:0] REG_POSITION = 4'h4;  // 4 to 7, lowest byte first
  localparam logic [3:0] REG_MASK = 4'h8;
  localparam logic [3:0] REG_MAP = 4'h9;
  localparam logic [3:0] REG_GO = 4'hA;
  localparam logic [3:0] REG_STOP = 4'hB;
  localparam logic [3:0] REG_INFO = 4'hC;
  localparam logic [7:0] INFO_MARK = 8'h42;
  localparam logic [7:0] INFO_VERSION = 8'h01;

  // Byte in the input buffer. It is new while its number seq differs from the seq of the last accepted byte.
  typedef struct packed {
    logic [1:0] seq;
    logic       is_command;  // 1: command, 0: parameter
    logic [7:0] data;
  } in_buf_t;

  // Progress of the host in reading a response. seq identifies the response.
  typedef struct packed {
    logic [1:0] seq;
    logic [1:0] bytes_read;
  } read_progress_t;

  // Response to a read command.
  typedef struct packed {
    logic [1:0]  seq;
    logic [1:0]  bytes;  // number of bytes: 0, 1 or 3
    logic [23:0] data;   // response; first byte in bits 7:0
  } read_data_t;

  // Status register of an axis, and seq of the last accepted byte.
  typedef struct packed {
    logic [1:0] ack_seq;
    logic       error;
    logic [2:0] number;   // error number, or number of missing parameters
    logic       busy;
  } axis_status_t;

  // State of the command unit, except the last command and its parameters (last_cmd_t).
  typedef struct packed {
    logic [1:0] ack_seq;  // seq of the last accepted byte
    logic       error;
    logic [2:0] number;   // error number, or number of missing parameters
  } parser_t;

  // Last command and its parameters, written with each accepted byte.
  typedef struct packed {
    logic [7:0]  code;
    logic [23:0] params;  // the last parameter is in bits 23:16
  } last_cmd_t;

  // Settings of an initialisation, written when its last byte is accepted.
  typedef struct packed {
    logic                              chop;   // 1: chop at standstill
    logic [7:0]                        slow;   // start-up rate
    logic [7:0]                        fast;   // high-speed rate
    logic [ppmc104_pkg::STEP_BITS-1:0] steps;  // acceleration pulses PA
  } ramp_t;

  // Lengths of the chopper phases in units. They are written when the host sets them.
  typedef struct packed {
    logic [7:0] off;
    logic [7:0] on;
  } chop_units_t;

  // Timing of the running interval.
  typedef struct packed {
    logic       slow_base;   // base clock, 1: 125 kHz, 0: 500 kHz
    logic       extra_time;  // 1: extra time of 7.5 us
    logic       decel;       // 1: the deceleration has begun
    // Rate of the running interval. During acceleration, after the end of the low time, this field is the
    // rate of the next interval.
    logic [7:0] rate;
  } interval_t;

  // State of a motion. At standstill, two fields have another meaning: decel_margin is the number of
  // remaining pulses, which the host can read; ramp_level is the number of remaining units of a chopper
  // phase.
  typedef struct packed {
    logic        busy;
    logic        more_pulses;    // 1: at least one more pulse must be ordered
    logic        last_ordered;   // 1: the last pulse has been ordered
    logic        held;           // 1: the axis waits for GO
    logic        pulse_low;      // 1: the start of a pulse was ordered, but its end was not
    logic        pulse_unseen;   // 1: no visit since the order of the last pulse has sampled pout_n = 0
    logic        decel_forced;   // 1: deceleration was requested
    logic        decel_natural;  // 1: deceleration has begun because of the pulse count
    logic        flag_stop;      // 1: a command requested the deceleration
    logic        flag_slow;      // 1: a slow-down limit requested the deceleration
    logic [2:0]  op;             // operation
    logic        pout_only;      // 1: POUT mode, the phases do not change
    logic        ccw;            // 1: CCW
    logic        silent;         // 1: no interrupt at the end
    logic [24:0] decel_margin;   // (pulses after the next pulse) - 1 - (index of the running interval)
    logic [14:0] ramp_level;     // index of the running interval + 1
  } motion_state_t;

  // Progress of an initialisation.
  typedef struct packed {
    logic initialised;
    logic building;     // 1: the ramp table is being built
  } init_state_t;

  // Phases, chopper, finish status, and sequence number of the last response.
  typedef struct packed {
    logic        hold;             // level of the pin hold
    logic        chop;             // 1: chop at standstill
    logic        phases_on;        // chopper, 1: the phases are on
    logic        chop_programmed;  // 1: the host has set the times of the chopper
    logic [1:0]  motor;            // type of motor (motor_e)
    logic        half;             // 1: half step
    logic        positive;         // 0: s is inverted
    logic        two_phases;       // 1: two adjacent phases are on (ppmc_motion_pkg)
    logic [5:1]  pattern;          // phases, 1: on
    logic        finish_unread;    // 1: the host has not read the finish status
    logic        irq_pending;      // 1: the axis has a pending interrupt
    stop_cause_t cause;            // cause of the end of the last motion
    logic [1:0]  read_data_seq;    // seq of the last stored response
  } output_state_t;

  // State of the pin block and of the switches of an axis, sampled by a visit.
  typedef struct packed {
    logic      armed;     // 1: pulses may be output
    logic      pout_n;    // level of the pin pout_n
    logic      stop;      // armed = 0 because of STOP or a stop command
    logic      alarm_n;   // 0: armed = 0 because of an alarm
    logic      limit;     // armed = 0 because of a limit
    logic      in_group;  // 1: the axis is a member of the group
    switches_t switches;
  } pin_status_t;

  // Command of a visit to the pin block. halt is executed immediately. pulse, pulse_end and set_pins are
  // executed in one cycle of the next round; at most one of these three is 1.
  typedef struct packed {
    logic       halt;       // 1: output no more pulses
    logic       pulse;      // 1: begin a pulse
    logic       pulse_end;  // 1: end the pulse
    logic       set_pins;   // 1: set dir, hold and s
    logic       arm;        // with set_pins: pulses may follow; with pulse: another pulse may follow
    logic       search;     // 1: the origin ends the motion
    logic       ccw;        // level of dir; selects the limit that ends the motion
    logic       hold;       // level of hold
    logic [5:1] s;          // levels of s
  } pin_cmd_t;

  // Comparisons of a visit. They are made one cycle before the decisions.
  typedef struct packed {
    logic edge_in_round;    // the awaited edge occurs in the next round
    logic rate_mismatch;    // the rate does not match the index of the interval yet
    logic margin_zero;      // motion_state_t.decel_margin is 0
    logic margin_negative;  // motion_state_t.decel_margin is negative
    logic ramp_bottom;      // motion_state_t.ramp_level is 0 or 1
    logic ramp_top;         // the running interval has index PA
    logic go;               // GO is active for this visit
    logic table_idle;       // no table is being built for this axis
  } compare_t;

  // Decisions of a visit.
  typedef struct packed {
    logic       start;          // start an operation
    logic       go_accept;      // GO: schedule pulse 1
    logic       go_reject;      // GO: reject, because no operation is waiting
    logic       finish;         // end a motion
    logic       init_done;      // complete an initialisation
    logic       init;           // begin an initialisation
    logic       first_init;     // with init: the first one since reset or Excitation OFF
    logic       exc_off;        // execute Excitation OFF
    logic       switching;      // set the times of the chopper
    logic       read;           // execute a read command
    logic [2:0] read_select;    // data that the read command selects
    logic       halt;           // execute a stop command that acts immediately
    logic       abort_motion;   // the pin block has ended the motion
    logic       cancel_pulse;   // with abort_motion: the last ordered pulse was not output
    logic       flag_stop;      // decelerate because of a command
    logic       flag_slow;      // decelerate because of a slow-down limit
    logic       pulse;          // order a pulse
    logic       last_pulse;     // with pulse: it is the last pulse
    logic       level_up;       // with pulse: increment ramp_level
    logic       level_down;     // with pulse: decrement ramp_level
    logic       decel_point;    // with pulse: begin the deceleration
    logic       decel_natural;  // with pulse: decelerate because of the pulse count
    logic       pulse_end;      // order the end of a low time
    logic       rate_next;      // change the rate by one
    logic       chop_edge;      // order an edge of the chopper
    logic       chop_unit;      // one unit of the chopper phase has passed
    logic       hold_running;   // count the hold time
    logic       hold_end;       // end the hold time
  } decision_t;

  // Command set of the PPMC-104 without the commands that a bank does not have (BANK-GEN-03).
  function automatic decoded_t decode(logic [7:0] code);
    decoded_t d;
    logic unsupported;
    d = ppmc104_pkg::decode(code);
    unsupported = d.kind inside {CmdAuxOut, CmdAuxOn, CmdAuxOff} || (d.kind == CmdInit && code[4])
        || (d.kind == CmdRead && code[2:0] == SEL_AUX_IN);
    if (unsupported) d = '{kind: CmdUndefined, params: 3'd0};
    return d;
  endfunction

  // verilator lint_on UNUSEDPARAM

endpackage

`default_nettype wire
