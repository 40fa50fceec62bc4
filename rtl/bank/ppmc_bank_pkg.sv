// SPDX-License-Identifier: Apache-2.0
// ppmc_bank_pkg: types that the blocks of a bank exchange for one axis, and the state of an axis in RAM.
// Rules:  BANK-GEN-01..04, BANK-WIN-01..03.
`default_nettype none

package ppmc_bank_pkg;

  // A design uses only some of these constants.
  // verilator lint_off UNUSEDPARAM

  import ppmc_code_pkg::*;
  import ppmc_motion_pkg::*;

  // Registers of the window, a[3:0] (BANK-WIN-02, -03).
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

  // Byte in the input buffer. It is new while seq differs from that of the byte accepted last.
  typedef struct packed {
    logic [1:0] seq;
    logic       command;
    logic [7:0] data;
  } mail_t;

  // Number of bytes of an answer that the host has read; seq is that of the answer.
  typedef struct packed {
    logic [1:0] seq;
    logic [1:0] done;  // bytes read
  } progress_t;

  typedef struct packed {
    logic [1:0]  seq;
    logic [1:0]  bytes;  // number of bytes: 0, 1 or 3
    logic [23:0] data;   // first byte in the low bits
  } answer_t;

  // Status register of an axis, and seq of the byte that the axis accepted last.
  typedef struct packed {
    logic [1:0] taken;
    logic       error;
    logic [2:0] number;
    logic       busy;
  } status_t;

  // State of the command unit, in addition to words_t.
  typedef struct packed {
    logic [1:0] taken;   // seq of the byte accepted last
    logic       error;
    logic [2:0] number;  // error number, or number of missing parameters
  } command_t;

  // Last command and its parameters, written with each accepted byte.
  typedef struct packed {
    logic [7:0]  code;
    logic [23:0] params;  // the last one in the high bits
  } words_t;

  // Settings of an initialisation, written when its last byte is accepted.
  typedef struct packed {
    logic                              chop;   // chop at standstill
    logic [7:0]                        slow;   // start-up rate
    logic [7:0]                        fast;   // high-speed rate
    logic [ppmc104_pkg::STEP_BITS-1:0] steps;  // acceleration pulses PA
  } ramp_t;

  // Units of the chopper phases, written when the host sets them.
  typedef struct packed {
    logic [7:0] off;
    logic [7:0] on;
  } units_t;

  // Timing of the running interval.
  typedef struct packed {
    logic       slow;   // base clock of 125 kHz
    logic       extra;  // extra time of 7.5 us
    logic       down;   // the deceleration has begun
    logic [7:0] rate;   // of the running interval; while accelerating, after the low time: of the next one
  } pace_t;

  // State of a motion. At standstill, slack is the number of remaining pulses that a host reads, and climb is
  // the number of remaining units of a chopper phase.
  typedef struct packed {
    logic        busy;
    logic        run;        // pulses are left to be ordered
    logic        last;       // the last pulse has been ordered
    logic        held;       // waits for GO
    logic        low;        // from the order of a pulse to the order of its end
    logic        forced;     // deceleration was requested
    logic        natural;    // deceleration has begun by pulse count
    logic        flag_stop;  // deceleration was requested by a command
    logic        flag_slow;  // deceleration was requested by a slow-down limit
    logic [2:0]  op;         // operation
    logic        pout_only;
    logic        ccw;
    logic        silent;     // no interrupt at the end
    logic [24:0] slack;      // pulses after the next one - 1 - index of the running interval
    logic [14:0] climb;      // index of the running interval + 1
  } walk_t;

  // Progress of an initialisation.
  typedef struct packed {
    logic initialised;
    logic building;     // the ramp table is being built
  } setting_t;

  // Phases, chopper and end of the last motion.
  typedef struct packed {
    logic        hold;
    logic        chop;        // chop at standstill
    logic        on;          // state of the chopper: phases on
    logic        programmed;  // the times of the chopper are set by the host
    logic [1:0]  motor;
    logic        half;
    logic        positive;
    logic        pair;        // see ppmc_motion_pkg
    logic [5:1]  pattern;
    logic        fresh;       // finish status not read yet
    stop_cause_t cause;
    logic [1:0]  seq;         // seq of the answer loaded last
  } rest_t;

  // State of the pin cell and switches of an axis, as a visit samples them.
  typedef struct packed {
    logic      armed;     // pulses may be output
    logic      emitted;   // the last ordered pulse has been output
    logic      stop;      // cause of armed = 0: stop
    logic      alarm;     // cause of armed = 0: alarm
    logic      limit;     // cause of armed = 0: limit
    logic      mask;      // member of the group
    switches_t switches;
  } seen_t;

  // Order of a visit to the pin cell: executed immediately, or in one cycle of the next round.
  typedef struct packed {
    logic       halt;    // no more pulses, immediately
    logic       pulse;   // a pulse begins; at most one of pulse, rise, sets is 1
    logic       rise;    // the pulse ends
    logic       sets;    // the other pins change
    logic       arm;     // with sets: pulses may follow; with pulse: another pulse may follow
    logic       search;  // the origin ends the motion
    logic       ccw;     // level of dir; selects the limit
    logic       hold;
    logic [5:1] s;       // pin levels
  } order_t;

  // Comparisons of a visit, made one cycle before the decisions.
  typedef struct packed {
    logic fire;   // the awaited edge is in the next round
    logic more;   // the rate is not yet the rate of its index
    logic zero;   // walk_t.slack is 0
    logic minus;  // walk_t.slack is negative
    logic foot;   // walk_t.climb is 0 or 1
    logic full;   // the running interval has index PA
    logic go;     // GO acts in this cycle
    logic built;  // no table is being built for this axis
  } facts_t;

  // Decisions of a visit.
  typedef struct packed {
    logic       start;      // an operation starts
    logic       proceed;    // GO: pulse 1 is scheduled
    logic       refuse;     // GO: no operation is waiting
    logic       finish;     // a motion ends
    logic       ready;      // an initialisation is complete
    logic       init;       // an initialisation begins
    logic       first;      // with init: first one since reset or Excitation OFF
    logic       exc_off;
    logic       switching;  // the times of the chopper are set
    logic       read;       // a read command
    logic [2:0] select;     // data selected by the read command
    logic       halt;       // a stop command that acts immediately
    logic       kill;       // the pin cell has ended the motion
    logic       undo;       // with kill: the last ordered pulse was not output
    logic       flag_stop;  // deceleration by a command
    logic       flag_slow;  // deceleration by a slow-down limit
    logic       pulse;      // a pulse is ordered
    logic       last;       // with pulse: last pulse
    logic       up;         // with pulse: index + 1
    logic       back;       // with pulse: index - 1
    logic       turn;       // with pulse: the deceleration begins
    logic       natural;    // with pulse: deceleration by pulse count
    logic       rise;       // the end of a low time is ordered
    logic       probe;      // the rate changes by one
    logic       toggle;     // an edge of the chopper is ordered
    logic       unit;       // one unit of the chopper phase has passed
    logic       rest;       // the hold time is running
    logic       hold;       // the hold time has ended
  } plan_t;

  // Command set of the PPMC-104 without the commands that a bank does not have (BANK-GEN-03).
  function automatic decoded_t decode(logic [7:0] code);
    decoded_t d;
    logic refused;
    d = ppmc104_pkg::decode(code);
    refused = d.kind inside {CmdAuxOut, CmdAuxOn, CmdAuxOff} || (d.kind == CmdInit && code[4])
        || (d.kind == CmdRead && code[2:0] == SEL_AUX_IN);
    if (refused) d = '{kind: CmdUndefined, params: 3'd0};
    return d;
  endfunction

  // verilator lint_on UNUSEDPARAM

endpackage

`default_nettype wire
