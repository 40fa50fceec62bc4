// SPDX-License-Identifier: Apache-2.0
// ppmc_motion_pkg: types that the motion blocks share. The types do not depend on the host.
`default_nettype none

package ppmc_motion_pkg;

  // A design uses only some of the items of this package.
  // verilator lint_off UNUSEDPARAM

  // Number of motor phases, coded as in the initialisation byte of the PPMC family (P104-INI-01).
  typedef enum logic [1:0] {
    MotorNone = 2'b00,
    Motor3    = 2'b01,
    Motor4    = 2'b10,
    Motor5    = 2'b11
  } motor_e;

  // Operation of an axis; the axis latches it at the start.
  typedef struct packed {
    logic ramp;       // 1: accelerates and decelerates along the ramp table
    logic single;     // 1: one pulse, without waiting for a base clock
    logic origin;     // 1: ends at the origin
    logic pout_only;  // 1: the phases do not change; slow-down limits act only on the plateau
    logic ccw;        // direction, 1: CCW
  } op_t;

  // Base clock of an operation; the axis latches it at the start.
  typedef struct packed {
    logic external;  // 1: edges of the clock pin, 0: internal base clock
    logic slow;      // 1: slow internal base clock
    logic extra;     // 1: extra time in every interval
  } base_clock_t;

  // Causes that ended a motion before its last pulse (P104-END-04), in the bit order of the finish status.
  typedef struct packed {
    logic stop;   // stop command
    logic alarm;  // ALM
    logic limit;  // limit in the direction of the motion
    logic slow;   // slow-down limit in the direction of the motion
  } stop_cause_t;

  // Levels of the switches after the synchroniser, 1: active.
  typedef struct packed {
    logic limit_cw;
    logic limit_ccw;
    logic slow_cw;
    logic slow_ccw;
    logic origin;
    logic alarm;
  } switches_t;

  // State of the motion of an axis.
  typedef struct packed {
    logic        busy;     // 1 from the start until the low time of the last pulse has ended
    logic        moving;   // 1 before pulse 1 and between pulses, if not yet stopping
    logic        running;  // 1 between pulses
    logic        gated;    // 1: waiting in the RUN gate
    logic        dec;      // 1: decelerating, forced or natural
    logic        top;      // 1: on the plateau of the ramp
    op_t         op;       // current or last operation
    base_clock_t base;     // base clock of this operation
  } motion_t;

  // Events of a motion at the next edge.
  typedef struct packed {
    logic pulse;     // a pulse begins
    logic last;      // with pulse: it is the last pulse
    logic complete;  // with pulse: the count is complete
    logic stop;      // immediate end
    logic done;      // the motion has ended
  } motion_event_t;

  // Times of the chopper. A phase lasts its base time plus its units. The base time and the units are
  // sampled when the phase begins.
  typedef struct packed {
    logic [31:0] on_base;    // base time of the ON phase in quanta, at least 1
    logic [31:0] off_base;   // base time of the OFF phase in quanta, at least 1
    logic [7:0]  on_units;   // units of the ON phase, set by the host
    logic [7:0]  off_units;  // units of the OFF phase, set by the host
  } chop_time_t;

  // Phases of a motor, 1: energised. The pattern is computed, not read from a table. A full step rotates the
  // pattern by one phase. Half steps alternately use the AND and the OR of the pattern and the rotated
  // pattern; a 5-phase motor starts with OR, other motors with AND. two_phases = 1: two adjacent phases are
  // on, which is an even index of the half-step table in the manual.
  function automatic logic [5:1] rotate_phases(logic [5:1] pattern, motor_e motor, logic ccw);
    logic [5:1] t;
    if (ccw) begin
      t = {1'b0, pattern[5:2]};
      unique case (motor)
        Motor3:  t[3] = pattern[1];
        Motor4:  t[4] = pattern[1];
        default: t[5] = pattern[1];
      endcase
    end else begin
      t = {pattern[4:1], 1'b0};
      unique case (motor)
        Motor3: begin
          t[4] = 1'b0;
          t[1] = pattern[3];
        end
        Motor4: begin
          t[5] = 1'b0;
          t[1] = pattern[4];
        end
        default: t[1] = pattern[5];
      endcase
    end
    return t;
  endfunction

  function automatic logic [5:1] next_phases(logic [5:1] pattern, logic two_phases, logic half, motor_e motor,
                                             logic ccw);
    logic [5:1] t;
    t = rotate_phases(pattern, motor, ccw);
    if (half) t = (two_phases == (motor == Motor5)) ? pattern | t : pattern & t;
    return t;
  endfunction

  // verilator lint_on UNUSEDPARAM

endpackage

`default_nettype wire
