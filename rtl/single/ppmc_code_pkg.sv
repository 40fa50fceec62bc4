// SPDX-License-Identifier: Apache-2.0
// ppmc_code_pkg: common command set of the single-axis devices (PPMC-104BFP, J105 STMC): bits of the codes,
//         error numbers, and actions of a byte.
// Rules:  P104-CMD-01..04, P104-ERR-00, P104-INI-01; docs/stmc/README.md, 5 (errors), 6.1 (codes), 6.2.
`default_nettype none

package ppmc_code_pkg;

  // A design uses only some of the items of this package.
  // verilator lint_off UNUSEDPARAM

  // Error numbers in status bits 6..4 (P104-ERR-00).
  typedef enum logic [2:0] {
    ErrUndefined  = 3'd0,  // also: a stop command without a motion
    ErrBusy       = 3'd1,
    ErrNotReady   = 3'd2,  // operation before initialisation
    ErrData       = 3'd3,  // data byte that was not requested
    ErrStepsHigh  = 3'd4,
    ErrRates      = 3'd5,  // illegal rate, or PA too small
    ErrDataBusy   = 3'd6,  // as ErrData, during a motion
    ErrDecelAgain = 3'd7
  } cmd_error_e;

  typedef enum logic [3:0] {
    CmdUndefined,
    CmdInit,
    CmdHalt,       // Immediate Stop
    CmdDecel,      // Decelerating Stop
    CmdOperation,
    CmdRead,
    CmdSwitching,
    CmdAuxOut,
    CmdExcOff,     // Excitation OFF, AUX ON while busy
    CmdAuxOn,
    CmdAuxOff
  } cmd_kind_e;

  // Data that a read command selects: low three bits of the codes 10 000 xxx.
  localparam logic [2:0] SEL_FINISH = 3'b000;
  localparam logic [2:0] SEL_INPUTS = 3'b001;
  localparam logic [2:0] SEL_OUTPUTS = 3'b010;
  localparam logic [2:0] SEL_REMAINING = 3'b011;
  localparam logic [2:0] SEL_AUX_IN = 3'b101;

  // Bits of the initialisation code.
  typedef struct packed {
    logic [1:0] prefix;    // 00
    logic       chop;      // S: chop at standstill
    logic       external;  // C: base clock from the pin
    logic       positive;  // L: high = energised
    logic       half;      // E: half step
    logic [1:0] motor;     // MM
  } init_code_t;

  // Bits of an operation code.
  typedef struct packed {
    logic       pout_only;  // not in the J105 STMC
    logic       prefix;
    logic       ignored;
    logic       silent;     // I: no interrupt at the end
    logic       ccw;        // D
    logic [2:0] op;
  } op_code_t;

  typedef struct packed {
    cmd_kind_e  kind;
    logic [2:0] params;  // bytes that follow
  } decoded_t;

  // Actions of an accepted byte, one bit each; they take place at the C-event.
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

  // State that a command unit keeps between two bytes.
  typedef struct packed {
    logic        error;   // the last byte was faulty
    logic [2:0]  number;  // error number if error = 1, else number of remaining parameters
    logic [7:0]  code;    // code of the parameters
    logic [31:0] params;  // parameters received so far, the last in the high bits
  } parser_state_t;

  // Settings of the initialisation (ppmc_setup), without the ramp.
  typedef struct packed {
    logic       external;  // base clock from the pin
    logic       chop;      // chop at standstill; 0 until an initialisation is complete
    logic       positive;  // phases: high = energised
    logic       half;      // half step
    logic [1:0] motor;     // phases of the motor, as motor_e
  } setup_t;

  // verilator lint_on UNUSEDPARAM

endpackage

`default_nettype wire
