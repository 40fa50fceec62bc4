// SPDX-License-Identifier: Apache-2.0
// ppmc_motion_pkg: types that the motion blocks share; nothing of any host.
`default_nettype none

package ppmc_motion_pkg;

  // A design uses only some of these constants.
  // verilator lint_off UNUSEDPARAM

  // Number of motor phases, coded as in the family's initialisation byte (P104-INI-01).
  typedef enum logic [1:0] {
    MotorNone = 2'b00,
    Motor3    = 2'b01,
    Motor4    = 2'b10,
    Motor5    = 2'b11
  } motor_e;

  // What an operation is; latched by the axis at its start.
  typedef struct packed {
    logic ramp;       // accelerates and decelerates by the ramp table
    logic single;     // one pulse, no wait for a base clock
    logic origin;     // ends at the origin
    logic pout_only;  // phases stand still; slow-down limit seen on the plateau only
    logic ccw;        // direction
  } op_t;

  // Base clock of an operation; latched by the axis at its start.
  typedef struct packed {
    logic external;  // edges of the clock pin
    logic slow;      // slow internal base clock
    logic extra;     // extra time in every interval
  } base_t;

  // Why a motion ended before its last pulse (P104-END-04); bit order of the finish status.
  typedef struct packed {
    logic stop;   // stop command
    logic alarm;  // ALM
    logic limit;  // limit of the direction
    logic slow;   // slow-down limit of the direction
  } cause_t;

  // Levels of the switches after the synchroniser, 1 = active.
  typedef struct packed {
    logic limit_cw;
    logic limit_ccw;
    logic slow_cw;
    logic slow_ccw;
    logic origin;
    logic alarm;
  } switches_t;

  // How the motion of an axis stands.
  typedef struct packed {
    logic  busy;     // from its start until the last pulse has run out
    logic  moving;   // before pulse 1 or between pulses, not yet stopping
    logic  running;  // between pulses
    logic  gated;    // in the RUN gate
    logic  dec;      // decelerating, forced or natural
    logic  top;      // on the plateau of the ramp
    op_t   op;       // the running or last operation
    base_t base;     // its base clock
  } motion_t;

  // What a motion does at the coming edge.
  typedef struct packed {
    logic pulse;     // a pulse begins
    logic last;      // with pulse: the last one
    logic complete;  // with pulse: and the count is complete
    logic stop;      // immediate end
    logic done;      // the motion is over
  } event_t;

  // Times of the chopper: a phase lasts its base time and as many units; it is looked at when the phase begins.
  typedef struct packed {
    logic [31:0] on_base;    // quanta, at least 1
    logic [31:0] off_base;   // the same for the OFF phase
    logic [7:0]  on_units;   // units set by the host
    logic [7:0]  off_units;
  } chop_t;

  // Phases of a motor, 1 = energised. There is no table: full step turns the pair of phases by one place. Half step
  // takes, in turn, the phases that the pattern and its turned self share (AND) or cover together (OR); a 5-phase
  // motor starts with OR, the others with AND. pair: two neighbours are on, an even index of the half-step table.
  function automatic logic [5:1] turned(logic [5:1] pattern, motor_e motor, logic ccw);
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

  function automatic logic [5:1] stepped(logic [5:1] pattern, logic pair, logic half, motor_e motor,
                                         logic ccw);
    logic [5:1] t;
    t = turned(pattern, motor, ccw);
    if (half) t = (pair == (motor == Motor5)) ? pattern | t : pattern & t;
    return t;
  endfunction

  // verilator lint_on UNUSEDPARAM

endpackage

`default_nettype wire
