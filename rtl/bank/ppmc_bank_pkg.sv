// SPDX-License-Identifier: Apache-2.0
// ppmc_bank_pkg: what the blocks of a bank tell each other about one axis, and what its visits keep in RAM.
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
  localparam logic [3:0] REG_POSITION = 4'h4;  // to 7
  localparam logic [3:0] REG_MASK = 4'h8;
  localparam logic [3:0] REG_MAP = 4'h9;
  localparam logic [3:0] REG_GO = 4'hA;
  localparam logic [3:0] REG_STOP = 4'hB;
  localparam logic [3:0] REG_INFO = 4'hC;
  localparam logic [7:0] INFO_MARK = 8'h42;
  localparam logic [7:0] INFO_VERSION = 8'h01;

  // A byte in the input buffer. It is new while seq differs from what its axis has taken.
  typedef struct packed {
    logic [1:0] seq;
    logic       command;
    logic [7:0] data;
  } mail_t;

  // How far the host has read an answer: seq is that of the answer.
  typedef struct packed {
    logic [1:0] seq;
    logic [1:0] done;  // bytes
  } progress_t;

  typedef struct packed {
    logic [1:0]  seq;
    logic [1:0]  bytes;  // 0, 1 or 3
    logic [23:0] data;   // first byte in the low bits
  } answer_t;

  // What a status register shows of an axis, and the byte it took last.
  typedef struct packed {
    logic [1:0] taken;
    logic       error;
    logic [2:0] number;
    logic       busy;
  } status_t;

  // Command unit, beside the words that it keeps of the host.
  typedef struct packed {
    logic [1:0] taken;   // seq of the byte taken last
    logic       error;
    logic [2:0] number;  // of that error, or of parameters that are missing
  } command_t;

  // Last command and its parameters, written with each byte that is taken.
  typedef struct packed {
    logic [7:0]  code;
    logic [23:0] params;  // the last one in the high bits
  } words_t;

  // An initialisation, written when it is complete.
  typedef struct packed {
    logic                              chop;   // chop at rest
    logic [7:0]                        slow;   // start-up rate
    logic [7:0]                        fast;   // high-speed rate
    logic [ppmc104_pkg::STEP_BITS-1:0] steps;  // acceleration pulses PA
  } ramp_t;

  // Units of the chopper's phases, written when the host sets them.
  typedef struct packed {
    logic [7:0] off;
    logic [7:0] on;
  } units_t;

  // Pace of the running interval.
  typedef struct packed {
    logic       slow;   // base clock 125 kHz
    logic       extra;  // 7.5 us more
    logic       down;   // the way down the ramp has begun
    logic [7:0] rate;   // of the running interval; on the way up and after its low time that of the next one
  } pace_t;

  // Motion. At rest left is what a host reads as remaining pulses, and climb what remains of a chopper's phase.
  typedef struct packed {
    logic        busy;
    logic        run;        // pulses are still to be ordered
    logic        last;       // the last pulse has been ordered
    logic        held;       // waits for GO
    logic        low;        // from the order of a pulse to that of its end
    logic        forced;     // deceleration was asked for
    logic        natural;    // or has begun by count
    logic        flag_stop;  // a command asked for it
    logic        flag_slow;  // a slow-down limit did
    logic [2:0]  op;         // operation
    logic        pout_only;
    logic        ccw;
    logic        silent;     // no interrupt at the end
    logic [24:0] slack;      // pulses after the coming one, less 1, less the index of the running interval
    logic [14:0] climb;      // index of the running interval + 1
  } walk_t;

  // How far an initialisation has come.
  typedef struct packed {
    logic initialised;
    logic building;     // its table is being built
  } setting_t;

  // Phases, chopper, end of the last motion.
  typedef struct packed {
    logic       hold;
    logic       chop;        // chop at rest
    logic       on;          // phases of the chopper
    logic       programmed;  // its times come from the host
    logic [1:0] motor;
    logic       half;
    logic       positive;
    logic       pair;        // see ppmc_motion_pkg
    logic [5:1] pattern;
    logic       fresh;       // finish status not read yet
    cause_t     cause;
    logic [1:0] seq;         // of the answer loaded last
  } rest_t;

  // What a visit sees of its axis' pin cell and switches.
  typedef struct packed {
    logic      armed;     // pulses may come
    logic      emitted;   // the last pulse that was ordered has come
    logic      stop;      // why it is not armed any more
    logic      alarm;
    logic      limit;
    logic      mask;      // member of the group
    switches_t switches;
  } seen_t;

  // What a visit has the pin cell do: at once, or at one clk of the coming round.
  typedef struct packed {
    logic       halt;    // no more pulses, at once
    logic       pulse;   // one of these three, at its clk
    logic       rise;    // the pulse ends
    logic       sets;    // the other pins change
    logic       arm;     // with sets: pulses may come; with pulse: another one may
    logic       search;  // the origin counts
    logic       ccw;     // level of dir, and which limit counts
    logic       hold;
    logic [5:1] s;       // pin levels
  } order_t;

  // Comparisons of a visit, made a clk before it decides.
  typedef struct packed {
    logic fire;   // the awaited edge lies in the coming round
    logic more;   // the rate is not yet that of its index
    logic zero;   // of walk_t: slack is 0
    logic minus;  // slack is negative
    logic foot;   // climb is 0 or 1
    logic full;   // the running interval has index PA
    logic go;     // GO acts in this clk
    logic built;  // no table is being built for this axis
  } facts_t;

  // What a visit decides.
  typedef struct packed {
    logic       start;      // an operation starts
    logic       proceed;    // GO: pulse 1 is timed
    logic       refuse;     // GO: nothing waits for it
    logic       finish;     // a motion ends
    logic       ready;      // an initialisation is complete
    logic       init;       // one begins
    logic       first;      // the first one since reset or Excitation OFF
    logic       exc_off;
    logic       switching;  // times of the chopper
    logic       read;       // a read command
    logic [2:0] select;     // which
    logic       halt;       // a stop command
    logic       kill;       // the motion has been ended
    logic       undo;       // with kill: before the pulse that was ordered last
    logic       flag_stop;  // deceleration by command
    logic       flag_slow;  // and by a slow-down limit
    logic       pulse;      // a pulse is ordered
    logic       last;       // with pulse: the last one
    logic       up;         // with pulse: index + 1
    logic       back;       // with pulse: index - 1
    logic       turn;       // with pulse: the way down begins
    logic       natural;    // with pulse: by count
    logic       rise;       // the end of a low time is ordered
    logic       probe;      // the rate goes on by one
    logic       toggle;     // an edge of the chopper is ordered
    logic       unit;       // one of the units of its phase has passed
    logic       rest;       // hold time runs
    logic       hold;       // and is over
  } plan_t;

  // The command set of the PPMC-104 without what a bank does not have (BANK-GEN-03).
  function automatic decoded_t decode(logic [7:0] code);
    decoded_t d;
    logic refused;
    d = ppmc104_pkg::decode(code);
    refused = d.kind inside {KindAuxOut, KindAuxOn, KindAuxOff} || (d.kind == KindInit && code[4])
        || (d.kind == KindRead && code[2:0] == SEL_AUX_IN);
    if (refused) d = '{kind: KindUndefined, params: 3'd0};
    return d;
  endfunction

  // verilator lint_on UNUSEDPARAM

endpackage

`default_nettype wire
