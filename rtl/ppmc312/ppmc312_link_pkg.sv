// SPDX-License-Identifier: Apache-2.0
// ppmc312_link_pkg: what the rooms of the PPMC-312 say to each other: front end, instructions, motor side.
// Rules:  sections 2.3, 10.1..10.3; P312-GEN-04, P312-RSP-10/20/21, P312-PRT-04, P312-MON-01..06.
// Note:   all fields are synchronous to clk; one that lasts a single clk is called a strobe. Signals whose name ends
//         in _n are active low, as on the pin; all others are active high.
`default_nettype none

package ppmc312_link_pkg;

  // A design uses only some of these constants.
  // verilator lint_off UNUSEDPARAM

  import ppmc312_pkg::*;
  import ppmc312_stage_pkg::*;

  // ---- front end to instructions: a block of the host, in logical order ------------------------------------------

  typedef struct packed {
    logic                valid;  // one waits, until it is done
    logic [BLOCK_BITS:0] size;   // its bytes, 1 .. 32; stands with valid
  } offer_t;

  // ---- an instruction on its way ---------------------------------------------------------------------------------

  // Who asked for it; coded as RESP of the answer's header.
  typedef enum logic [1:0] {
    SrcHost     = 2'b00,
    SrcEvent    = 2'b01,
    SrcOverride = 2'b11
  } source_e;

  localparam int unsigned PARAMS = 13;  // parameters of the longest instruction

  // A block, parameters at their place in the long form of the instruction, missing ones 0. An
  // initial setting without sides of their own has those of the acceleration for both.
  typedef struct packed {
    source_e                source;
    logic [BLOCK_BITS:0]    size;    // from the host: bytes written, 1 .. 32
    logic [7:0]             head;    // header
    logic [7:0]             len;     // length as written: bytes of code and parameters
    logic [7:0]             code;
    logic [PARAMS-1:0][7:0] par;     // par[0] is the first one
  } block_t;

  // ---- pins of the motor side ------------------------------------------------------------------------------------

  typedef struct packed {logic alm_n, end_n, index_n, org_n, fhl_n, bhl_n, fl_n, bl_n;} levels_t;

  // All inputs but EXTCK, synchronous.
  typedef struct packed {
    levels_t    plain;   // as on the pins
    levels_t    levels;  // filtered
    logic [1:0] evt_n;   // [n] is event pin n, as on the pin
    logic [1:0] fell;    // strobes: event n has become low, filtered
    logic       run;     // 1: starts go ahead
    logic       epin;    // encoder: counts with its rising edge
    logic       epdir;   // 0 up, 1 down
    logic [7:0] auxi;    // generalized input
  } inputs_t;

  typedef struct packed {
    logic       pout;     // 1: a pulse is active
    logic       dir;      // 0 CW, 1 CCW
    logic       intlk_n;  // interlock control runs
    logic       exon_n;   // excitation
    logic       cclr_n;   // counter clear, 24.576 ms
    logic       aclr_n;   // alarm clear, 24.576 ms
    logic       zclmp_n;  // zero clamp
    logic       cd_n;     // current reduction
    logic [5:0] auxo_n;   // generalized output
  } outputs_t;

  // ---- instructions to motion ------------------------------------------------------------------------------------

  typedef struct packed {
    logic ccw;     // direction
    logic zero;    // zero return: a second phase follows
    logic origin;  // ends at the origin (constant-speed search)
    logic index;   // the origin needs INDEX, too
  } op_t;

  typedef struct packed {
    logic start;  // strobe: op along plan; only at rest
    op_t op;  // stands with start
    logic change;  // strobe: another rate, plan.to
    plan_t plan;  // steady from start to t0; its rate until 2 clk after change
    logic home;  // steady the same: one pulse at the start-up rate instead of plan.to, whatever plan.dec is
    logic pos_halt;  // strobe: an immediate stop is due at this position
    logic settled;  // everything that has been triggered is processed
  } motion_order_t;

  // ---- what motions look at, as instructions have set it ---------------------------------------------------------

  typedef struct packed {
    logic [15:0] limit_rate;  // HSL, base clocks: the high-speed limits count at this rate and faster ones
    logic        end_watch;   // END is monitored
    logic        ungated;     // RUN is not monitored
  } settings_t;

  // ---- state of the motor side -----------------------------------------------------------------------------------

  typedef struct packed {
    status_e     status;
    logic        end_wait;   // a motion waits for END
    settings_t   settings;
    logic [31:0] pos;        // position, pulses, two's complement
    logic [31:0] enc;        // the encoder's, edges
    logic        counted;    // strobe: pos has just been counted
    logic        lock;       // interlock control runs
    logic [1:0]  window_on;  // monitors, [0] in-position, [1] encode: enabled
    logic [1:0]  outside;    // enabled, and outside
  } axis_state_t;

  // ---- reports of the motor side ---------------------------------------------------------------------------------

  typedef struct packed {
    logic       valid;  // strobe
    logic [1:0] code;   // 0 pin; multiple occurrence: 1 of class 2, 2 of class 3 or 4, 3 of class 5
  } alarm_t;

  typedef struct packed {
    alarm_t alarm;   // class 1
    logic   unlock;  // class 3, strobe: interlock control ends
    logic   held;    // class 4, strobe: a held start goes ahead
    logic   stop;    // class 5, strobe: a motion has ended
    cause_t cause;   // why; with stop
  } notice_t;

  // Monitors, classes 7 and 8: [0] in-position, [1] encode.
  typedef struct packed {
    logic [1:0] waits;    // a report waits
    logic [1:0] outside;  // what it will say: 1 outside, 0 inside
  } windows_t;

  typedef struct packed {
    logic [1:0] load;  // strobe: it is being loaded
    logic [1:0] read;  // strobe: it has been read; both in one clk: taken at once
  } window_take_t;

  // ---- instructions to reports: class 2 --------------------------------------------------------------------------

  typedef struct packed {
    logic                  we;
    logic [BLOCK_BITS-1:0] addr;  // logical: 0 = header
    logic [7:0]            data;
  } answer_byte_t;

  // What came of a triggered instruction.
  typedef enum logic [1:0] {
    DoneOverride = 2'b00,  // 28
    DoneEvent    = 2'b01,  // 29
    FailEvent    = 2'b10,  // 4A
    FailOverride = 2'b11   // 4B
  } triggered_e;

  typedef struct packed {
    logic                valid;  // strobe: an answer is complete
    logic                host;   // it answers the host
    triggered_e          what;   // if not: what came of it
    logic [BLOCK_BITS:0] size;   // bytes, 3 .. 32
  } commit_t;

  // The store of class 2, two places.
  typedef struct packed {
    logic full;       // an answer waits to be read
    logic full_host;  // it answers the host
    logic waits;      // a second one waits behind it
  } class2_t;

  // What the serial station looks at.
  typedef struct packed {
    logic       valid;  // strobe: the host's block is executed
    logic [7:0] code;   // what it has come to; one clk later
    logic [2:0] first;  // low bits of the first byte behind the code; one clk later
  } answered_t;

  // verilator lint_on UNUSEDPARAM

endpackage

`default_nettype wire
