// SPDX-License-Identifier: Apache-2.0
// ppmc312_stage_pkg: types of the motion along a stage table.
// Rules:  P312-GEN-06 (t(x)), P312-MOT-20.
`default_nettype none

package ppmc312_stage_pkg;

  // A design uses only some of these constants.
  // verilator lint_off UNUSEDPARAM

  // A constant rate and what the look-up in the table has found for it.
  typedef struct packed {
    logic [15:0] rate;   // base clocks of an interval
    logic        slows;  // a deceleration from it has stages
    logic [6:0]  ge;     // last stage with at least this rate
    logic [6:0]  ge1;    // the same plus 1; no such stage: the first one in use
    logic [6:0]  gt1;    // last stage with a higher rate, plus 1
  } target_t;

  // Where a walk down the table begins.
  typedef struct packed {
    logic [6:0]  stage;
    logic        part;   // not with all pulses of this stage,
    logic [23:0] left;   // but with so many
  } walk_t;

  // A ramp as an initialisation gives it, or as a curve is described when its transfer begins.
  typedef struct packed {
    logic        cosine;  // sigmoid; 00 only
    logic        split;   // acceleration and deceleration side of their own
    logic [2:0]  base;    // base clock, see ppmc312_interval
    logic [15:0] start;   // start-up rate
    logic [15:0] stop;    // stop rate; not split: the same
    logic [15:0] fast;    // high-speed rate
    logic [23:0] acc;     // pulses of the sides
    logic [23:0] dec;     // not split: the same
  } curve_t;

  // The table in force.
  typedef struct packed {
    logic        valid;      // there is one
    logic        split;      // acceleration and deceleration side of their own
    logic [2:0]  base;       // base clock, see ppmc312_interval
    logic [6:0]  first_acc;  // first stage of a side
    logic [6:0]  first_dec;
    logic [15:0] rate_acc;   // and its rate
    logic [15:0] rate_dec;
    logic [15:0] fast;       // high-speed rate
    logic [23:0] acc;        // pulses of the sides
    logic [23:0] dec;
  } table_t;

  // A word on its way into the table.
  typedef struct packed {
    logic        rate;   // strobes: which columns
    logic        acc;
    logic        dec;
    logic [6:0]  stage;  // 0 .. 126
    logic [23:0] data;   // low bits for a rate
  } entry_t;

  // Where a read port of the table looks, and what it has there two clk later.
  typedef struct packed {
    logic       side;   // 0 pulses of the acceleration side, 1 of the deceleration side
    logic [6:0] stage;  // 0 .. 126, the fastest one
  } look_t;

  typedef struct packed {
    logic [15:0] rate;    // base clocks of an interval
    logic [23:0] pulses;
  } stage_t;

  // What the planner shall do. All but start stand still while it is busy.
  typedef struct packed {
    logic        start;    // strobe
    logic        ramp;     // plan acceleration and deceleration; else look the rate up only
    logic        endless;  // the operation has no end of its own
    logic [15:0] rate;     // base clocks of an interval
    logic [31:0] count;    // pulses, at least 1
  } plan_order_t;

  // An operation along the table, planned.
  typedef struct packed {
    logic        endless;  // no end of its own
    logic        climb;    // begins with acceleration
    logic [31:0] count;    // pulses
    logic [23:0] dec;      // pulses of the deceleration
    walk_t from;           // where it begins
    target_t     to;       // constant rate
  } plan_t;

  // verilator lint_on UNUSEDPARAM

endpackage

`default_nettype wire
