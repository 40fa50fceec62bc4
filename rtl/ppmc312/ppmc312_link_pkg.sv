// SPDX-License-Identifier: Apache-2.0
// ppmc312_link_pkg: types of the signals between front end, instructions and motor side of the PPMC-312.
// Rules:  docs/ppmc312/README.md, Pins, Answers and reports; P312-GEN-04, P312-RSP-10/20/21, P312-PRT-04,
//         P312-MON-01..06.
// Note:   all fields are synchronous to clk. A strobe is high for one cycle. Names that end in _n are active
//         low, as on the pin; all others are active high.
`default_nettype none

package ppmc312_link_pkg;

  // A design uses only some of the items of this package.
  // verilator lint_off UNUSEDPARAM

  import ppmc312_pkg::*;
  import ppmc312_stage_pkg::*;

  // ---- front end -> instructions: block from the host, in logical order ---------------------------

  typedef struct packed {
    logic                valid;  // level: a block is pending; 0 after it is processed
    logic [BLOCK_BITS:0] size;   // bytes of the block, 1 .. 32; stable while valid
  } host_block_t;

  // ---- current instruction ------------------------------------------------------------------------

  // Source of an instruction. The value is the field RESP in the header of the response.
  typedef enum logic [1:0] {
    SrcHost     = 2'b00,
    SrcEvent    = 2'b01,
    SrcOverride = 2'b11
  } source_e;

  localparam int unsigned PARAMS = 13;  // number of parameters of the longest instruction

  // An instruction block. Each parameter is stored at its position in the long form of the instruction; a
  // missing parameter is 0. Exception: an initial setting in which bit 4 of par[0] is 0 describes only one
  // ramp, for acceleration and deceleration. Its stop rate is then stored equal to its start-up rate, and its
  // deceleration pulses equal to its acceleration pulses.
  typedef struct packed {
    source_e                source;
    logic [BLOCK_BITS:0]    size;    // bytes that the host has written, 1 .. 32
    logic [7:0]             head;    // header
    logic [7:0]             len;     // length byte: number of bytes of code and parameters
    logic [7:0]             code;
    logic [PARAMS-1:0][7:0] par;     // par[0] is the first parameter
  } block_t;

  // ---- pins of the motor side ---------------------------------------------------------------------

  typedef struct packed {logic alm_n, end_n, index_n, org_n, fhl_n, bhl_n, fl_n, bl_n;} motor_inputs_t;

  // All inputs except EXTCK, synchronised.
  typedef struct packed {
    motor_inputs_t unfiltered;  // levels of the pins
    motor_inputs_t filtered;    // levels after the time filters
    logic [1:0]    evt_n;       // [n]: event pin n, not filtered
    logic [1:0]    evt_fall;    // strobes: falling edge of event n, filtered
    logic          run;         // 0: RUN holds starts
    logic          epin;        // encoder, counted at its rising edge
    logic          epdir;       // 0: up, 1: down
    logic [7:0]    auxi;        // generalized input
  } inputs_t;

  typedef struct packed {
    logic       pout;     // 1: a pulse is active
    logic       dir;      // 0: CW, 1: CCW
    logic       intlk_n;  // interlock; low: interlock control is active
    logic       exon_n;   // excitation
    logic       cclr_n;   // counter clear, 24.576 ms
    logic       aclr_n;   // alarm clear, 24.576 ms
    logic       zclmp_n;  // zero clamp
    logic       cd_n;     // current reduction
    logic [5:0] auxo_n;   // generalized output
  } outputs_t;

  // ---- instructions -> motion ---------------------------------------------------------------------

  typedef struct packed {
    logic ccw;     // 1: CCW
    logic zero;    // zero return: a second phase follows
    logic origin;  // search at constant rate: ends at the origin
    logic index;   // 1: the origin requires INDEX as well as ORG
  } operation_t;

  typedef struct packed {
    logic start;  // strobe, only at standstill: start op along profile
    operation_t op;  // operation; valid with start
    logic change;  // strobe: change the rate to profile.target
    profile_t profile;  // stable from start to t0 (start of the motion); target: until 2 cycles after change
    logic single_pulse;  // 1: one pulse at the start-up rate; stable like profile
    logic pos_halt;  // strobe: the position of an immediate stop is reached
    logic triggers_done;  // 1: all triggered instructions have been processed
  } motion_req_t;

  // ---- settings for motions, made by instructions -------------------------------------------------

  typedef struct packed {
    logic [15:0] limit_rate;  // rate limit HSL in base clocks; high-speed limits act at this and faster rates
    logic end_monitored;  // 1: END is monitored
    logic run_ignored;  // 1: RUN is not monitored
  } motion_settings_t;

  // ---- state of the motor side --------------------------------------------------------------------

  typedef struct packed {
    status_e          status;
    logic             end_wait;   // a motion waits for END
    motion_settings_t settings;
    logic [31:0]      pos;        // position, pulses, two's complement
    logic [31:0]      enc;        // encoder position, edges
    logic             counted;    // strobe: a pulse has been counted in pos
    logic             lock;       // interlock control is active
    logic [1:0]       window_on;  // monitor is enabled, [0]: in-position, [1]: encode
    logic [1:0]       outside;    // monitor is enabled, and the position is outside its range
  } axis_state_t;

  // ---- reports of the motor side ------------------------------------------------------------------

  typedef struct packed {
    logic       valid;  // strobe: an alarm
    logic [1:0] code;   // 0: pin; 1 to 3: multiple occurrence (1: class 2, 2: class 3 or 4, 3: class 5)
  } alarm_event_t;

  typedef struct packed {
    alarm_event_t alarm;  // class 1: alarm
    logic unlock;  // class 3, strobe: interlock control ends
    logic hold_end;  // class 4, strobe: RUN releases a start that it held
    logic stop;  // class 5, strobe: a motion has ended
    end_cause_t cause;  // cause of the end; valid with stop
  } axis_event_t;

  // Monitors, classes 7 and 8: [0] in-position, [1] encode.
  typedef struct packed {
    logic [1:0] pending;  // a report is pending
    logic [1:0] outside;  // contents of the report; 1: outside the range, 0: inside
  } monitor_req_t;

  typedef struct packed {
    logic [1:0] load;  // strobe: the report is being loaded
    logic [1:0] read;  // strobe: the report has been read; may coincide with load
  } monitor_ack_t;

  // ---- instructions -> reports: class 2 -----------------------------------------------------------

  typedef struct packed {
    logic                  we;
    logic [BLOCK_BITS-1:0] addr;  // byte of the response in logical order, 0 = header
    logic [7:0]            data;  // byte at addr
  } response_write_t;

  // Result of a triggered instruction. Each comment is the hexadecimal code in the reply to a poll.
  typedef enum logic [1:0] {
    DoneOverride = 2'b00,  // 28
    DoneEvent    = 2'b01,  // 29
    FailEvent    = 2'b10,  // 4A
    FailOverride = 2'b11   // 4B
  } trigger_result_e;

  typedef struct packed {
    logic                valid;           // strobe: a response is complete
    logic                host;            // the response is to an instruction of the host
    trigger_result_e     trigger_result;  // valid if host = 0: result of the triggered instruction
    logic [BLOCK_BITS:0] size;            // bytes of the response, 3 .. 32
  } response_done_t;

  // State of the two-entry queue of class 2.
  typedef struct packed {
    logic full;       // a response can be read
    logic full_host;  // the response that can be read is to an instruction of the host
    logic pending;    // another, newer response waits
  } response_queue_t;

  // Result of a block from the host, for the serial station.
  typedef struct packed {
    logic       valid;  // strobe: the block has been executed
    logic [7:0] code;   // code of the response, in the cycle after `valid`
    logic [2:0] first;  // bits 2:0 of the first byte after the code, in the cycle after `valid`
  } host_result_t;

  // verilator lint_on UNUSEDPARAM

endpackage

`default_nettype wire
