// SPDX-License-Identifier: Apache-2.0
// ppmc_code_pkg: command set that the single-axis devices (PPMC-104BFP, J105 STMC) share. Contains the bits
//         of the codes, the error numbers and the actions of a byte.
// Rules:  P104-CMD-01..04, P104-ERR-00, P104-INI-01; docs/stmc/README.md, 5 (errors), 6.1 (codes), 6.2.
`default_nettype none

package ppmc_code_pkg;

  // A design uses only some of the items of this package.
  // verilator lint_off UNUSEDPARAM

  // Error numbers in status bits 6:4 (P104-ERR-00).
  typedef enum logic [2:0] {
    ErrUndefined  = 3'd0,  // undefined code, or stop command without a motion
    ErrBusy       = 3'd1,
    ErrNotReady   = 3'd2,  // operation before an initialisation
    ErrData       = 3'd3,  // data byte that was not requested
    ErrStepsHigh  = 3'd4,
    ErrRates      = 3'd5,  // invalid rate, or PA too small
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
    CmdExcOff,     // Excitation OFF; during a motion: AUX ON
    CmdAuxOn,
    CmdAuxOff
  } cmd_kind_e;

  // Data that a read command selects: bits 2:0 of the codes 10 000 xxx.
  localparam logic [2:0] SEL_FINISH = 3'b000;
  localparam logic [2:0] SEL_INPUTS = 3'b001;
  localparam logic [2:0] SEL_OUTPUTS = 3'b010;
  localparam logic [2:0] SEL_REMAINING = 3'b011;
  localparam logic [2:0] SEL_AUX_IN = 3'b101;

  // Bits of the initialisation code; the letters are the names in the manual.
  typedef struct packed {
    logic [1:0] prefix;    // always 00
    logic       chop;      // S, 1: chop at standstill
    logic       external;  // C, 1: base clock from the pin
    logic       positive;  // L, 1: high = energised
    logic       half;      // E, 1: half step
    logic [1:0] motor;     // MM, type of motor
  } init_code_t;

  // Bits of an operation code; the letters are the names in the manual.
  typedef struct packed {
    logic       pout_only;  // P, 1: POUT mode; not in the J105 STMC
    logic       prefix;
    logic       ignored;
    logic       silent;     // I, 1: no interrupt at the end
    logic       ccw;        // D, 1: CCW
    logic [2:0] op;
  } op_code_t;

  typedef struct packed {
    cmd_kind_e  kind;
    logic [2:0] params;  // number of parameter bytes that follow
  } decoded_t;

  // Actions of a byte, one bit each. They are requested when the byte is accepted (its C-event).
  typedef struct packed {
    logic init;     // an initialisation is accepted
    logic start;    // start of an operation
    logic halt;     // Immediate Stop
    logic decel;    // Decelerating Stop
    logic exc_off;
    logic aux_on;
    logic aux_off;
    logic aux_out;  // data for the auxiliary output
    logic switching;
    logic read;
  } action_t;

  // State that a command unit keeps between two bytes.
  typedef struct packed {
    logic        error;   // 1: the last byte was faulty
    logic [2:0]  number;  // error = 1: error number; error = 0: number of missing parameters
    logic [7:0]  code;    // code to which the parameters belong
    logic [31:0] params;  // parameters received so far; the last one is in bits 31:24
  } parser_state_t;

  // Settings of the initialisation (ppmc_setup), except the ramp.
  typedef struct packed {
    logic       external;  // 1: base clock from the pin
    logic       chop;      // 1: chop at standstill; 0 until an initialisation is complete
    logic       positive;  // phases, 1: high = energised
    logic       half;      // 1: half step
    logic [1:0] motor;     // type of motor as in motor_e
  } setup_t;

  // verilator lint_on UNUSEDPARAM

endpackage

`default_nettype wire
