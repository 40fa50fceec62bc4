// SPDX-License-Identifier: Apache-2.0
// ppmc_code_pkg: what the single-axis parts (PPMC-104BFP, J105 STMC) have in common of their command set: bits of
// the codes, error numbers, and what a byte makes such a part do.
// Rules:  P104-CMD-01..04, P104-ERR-00, P104-INI-01; STMC section 2.4 (error numbers), 3.0, 3.1.
`default_nettype none

package ppmc_code_pkg;

  // A design uses only some of these constants.
  // verilator lint_off UNUSEDPARAM

  // Error numbers as shown in status bits 6..4 (P104-ERR-00).
  typedef enum logic [2:0] {
    ErrUndefined  = 3'd0,  // also: a stop with no motion
    ErrBusy       = 3'd1,
    ErrNotReady   = 3'd2,  // operation before initialisation
    ErrData       = 3'd3,  // data byte nobody asked for
    ErrStepsHigh  = 3'd4,
    ErrRates      = 3'd5,  // a rate is not legal, or PA too small
    ErrDataBusy   = 3'd6,  // as ErrData, during a motion
    ErrDecelAgain = 3'd7
  } error_e;

  typedef enum logic [3:0] {
    KindUndefined,
    KindInit,
    KindHalt,       // Immediate Stop
    KindDecel,      // Decelerating Stop
    KindOperation,
    KindRead,
    KindSwitching,
    KindAuxOut,
    KindExcOff,     // Excitation OFF, AUX ON while busy
    KindAuxOn,
    KindAuxOff
  } kind_e;

  // What a read command shows: low three bits of the codes 10 000 xxx.
  localparam logic [2:0] SEL_FINISH = 3'b000;
  localparam logic [2:0] SEL_INPUTS = 3'b001;
  localparam logic [2:0] SEL_OUTPUTS = 3'b010;
  localparam logic [2:0] SEL_REMAINING = 3'b011;
  localparam logic [2:0] SEL_AUX_IN = 3'b101;

  // Bits of the initialisation code.
  typedef struct packed {
    logic [1:0] prefix;    // 00
    logic       chop;      // S: chop at rest
    logic       external;  // C: base clock from the pin
    logic       positive;  // L: high is on
    logic       half;      // E: half step
    logic [1:0] motor;     // MM
  } init_code_t;

  // Bits of an operation code.
  typedef struct packed {
    logic       pout_only;  // the J105 STMC has no such operations
    logic       prefix;
    logic       ignored;
    logic       silent;     // I: no interrupt at the end
    logic       ccw;        // D
    logic [2:0] op;
  } op_code_t;

  typedef struct packed {
    kind_e      kind;
    logic [2:0] params;  // bytes that follow
  } decoded_t;

  // What a taken byte makes the part do; all at the C-event, one bit an action.
  typedef struct packed {
    logic init;     // initialisation accepted
    logic start;    // operation
    logic halt;     // Immediate Stop
    logic decel;    // Decelerating Stop
    logic exc_off;
    logic aux_on;
    logic aux_off;
    logic aux_out;  // auxiliary output data
    logic switching;
    logic read;
  } action_t;

  // What a command unit remembers between two bytes.
  typedef struct packed {
    logic        error;   // the last byte was faulty
    logic [2:0]  number;  // then the error number, else parameters still to come
    logic [7:0]  code;    // code that they are for
    logic [31:0] params;  // those that came, the last one in the high bits
  } asking_t;

  // What the initialisation sets beside the ramp (ppmc_setup).
  typedef struct packed {
    logic       external;  // base clock from the pin
    logic       chop;      // chop at rest; 0 until an initialisation is complete
    logic       positive;  // phases: high is on
    logic       half;      // half step
    logic [1:0] motor;     // phases of the motor, as motor_e
  } setup_t;

  // verilator lint_on UNUSEDPARAM

endpackage

`default_nettype wire
