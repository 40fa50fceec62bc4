// SPDX-License-Identifier: Apache-2.0
// ppmc312_stage_pkg: types for motions along a stage table.
// Rules:  P312-GEN-06 (t(x)), P312-MOT-20.
`default_nettype none

package ppmc312_stage_pkg;

  // A design uses only some of the items of this package.
  // verilator lint_off UNUSEDPARAM

  // A constant rate and its look-up result in the table.
  typedef struct packed {
    logic [15:0] rate;       // base clocks of an interval
    logic        has_decel;  // 1: a deceleration from this rate uses at least one stage
    logic [6:0]  ge;         // last stage whose rate value is at least `rate`
    logic [6:0]  ge1;        // ge + 1; if no stage qualifies for ge: the first used stage
    logic [6:0]  gt1;        // 1 + last stage whose rate value is above `rate`
  } target_t;

  // Start of a deceleration along the table.
  typedef struct packed {
    logic [6:0]  stage;
    logic        is_partial;  // 1: the deceleration uses only some pulses of `stage`
    logic [23:0] pulses;      // with is_partial: number of used pulses
  } ramp_pos_t;

  // Ramp of an initialisation, or description of a free curve at the start of its transfer.
  typedef struct packed {
    logic        cosine;      // 1: sigmoid ramp; only instruction 00
    logic        split;       // 1: separate acceleration and deceleration sides
    logic [2:0]  base;        // base clock, see ppmc312_interval
    logic [15:0] start_rate;  // start-up rate
    logic [15:0] stop_rate;   // stop rate; if not split: equal to start_rate
    logic [15:0] high_rate;   // high-speed rate
    logic [23:0] acc;         // pulses of the acceleration side
    logic [23:0] dec;         // pulses of the deceleration side; if not split: equal to acc
  } curve_t;

  // The active table.
  typedef struct packed {
    logic        valid;      // 1: a table exists
    logic        split;      // 1: separate acceleration and deceleration sides
    logic [2:0]  base;       // base clock, see ppmc312_interval
    logic [6:0]  first_acc;  // first stage of the acceleration side
    logic [6:0]  first_dec;  // first stage of the deceleration side
    logic [15:0] rate_acc;   // rate of stage first_acc
    logic [15:0] rate_dec;   // rate of stage first_dec
    logic [15:0] high_rate;  // high-speed rate
    logic [23:0] acc;        // pulses of the acceleration side
    logic [23:0] dec;        // pulses of the deceleration side
  } table_t;

  // Write port of the table.
  typedef struct packed {
    logic        we_rate;  // strobe: write the rate of the stage
    logic        we_acc;
    logic        we_dec;
    logic [6:0]  stage;    // 0 .. 126
    logic [23:0] data;     // data; a rate uses bits 15:0
  } table_write_t;

  // Address of a read port of the table. The data (stage_t) are valid two cycles later.
  typedef struct packed {
    logic       side;   // 0: pulses of the acceleration side, 1: of the deceleration side
    logic [6:0] stage;  // 0 .. 126; 126 is the fastest
  } table_addr_t;

  typedef struct packed {
    logic [15:0] rate;    // base clocks of an interval
    logic [23:0] pulses;
  } stage_t;

  // Command to the planner. All fields except start are stable while the planner is busy.
  typedef struct packed {
    logic        start;    // strobe: start the planner
    logic        ramp;     // 1: plan acceleration and deceleration, 0: only look up the rate
    logic        endless;  // 1: the operation runs until it is stopped
    logic [15:0] rate;     // base clocks of an interval
    logic [31:0] count;    // pulses, at least 1
  } profile_req_t;

  // A planned operation along the table.
  typedef struct packed {
    logic        endless;            // 1: the operation runs until it is stopped
    logic        starts_with_accel;  // 1: begins with acceleration, 0: with the constant rate
    logic [31:0] count;              // pulses
    logic [23:0] dec_pulses;         // pulses of the deceleration
    ramp_pos_t   decel_start;        // start of the deceleration
    target_t     target;             // constant rate
  } profile_t;

  // verilator lint_on UNUSEDPARAM

endpackage

`default_nettype wire
