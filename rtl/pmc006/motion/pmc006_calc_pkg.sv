// SPDX-License-Identifier: Apache-2.0
// pmc006_calc_pkg: the language of the planner: instructions of pmc006_calc, its operands and conditions.
// Rules:  P006-MOT-10..23, P006-EXC-20..23 (what the program in pmc006_calc.asm computes).
// How:    an instruction is {operation, aux, operand} or {jump, condition, target}. hi and lo are the accumulator
//         pair of the one adder; hi alone takes part in sums.
`default_nettype none

package pmc006_calc_pkg;

  typedef enum logic [3:0] {
    OpHalt,
    OpLoad,   // hi = operand
    OpAdd,    // hi = hi + operand; carry
    OpSub,    // hi = hi - operand; carry = it was not greater
    OpStore,  // word = hi
    OpMul,    // {hi, lo} = (hi + operand * the low n bits of lo) and the rest of lo, rotated right by n
    OpDiv,    // lo = {hi, lo} / operand, hi = remainder
    OpRoot,   // hi = 0: square root of lo into the output VN, which must be 0
    OpOut,    // output = hi, or raise a coefficient
    OpSet,    // phase and shape of the ramp
    OpJump
  } op_e;

  // aux of a load, sum or division.
  typedef enum logic [3:0] {
    Plain,
    Dec,    // RWay with nd
    Low,    // the result goes to lo, hi = 0
    LowDec
  } where_e;

  // aux of a multiplication: its steps.
  typedef enum logic [3:0] {
    N1,
    N2,
    N4,
    N16,
    N32
  } steps_e;

  // aux of an output.
  typedef enum logic [3:0] {
    OutNext,   // Vn
    OutSpeed,  // V and Vn
    OutBump,   // Bn = hi >> 6
    OutLead,   // Wn = min(64, hi)
    OutAcc,    // na = na + 1
    OutDec     // nd = nd + 1
  } out_e;

  typedef enum logic [5:0] {
    // words of the calculator's memory
    MLt     = 6'h00,  // live target last used
    MU      = 6'h01,  // progress of the ramp
    MDu     = 6'h02,  // its increment; 0 stands for 2^32
    MV1     = 6'h03,  // its first speed
    MDv     = 6'h04,  // and its height
    MLeft   = 6'h05,  // R of this update tick
    MT      = 6'h06,
    MX      = 6'h07,
    MWay1   = 6'h08,  // way of the acceleration, steps
    MWay2   = 6'h09,  // of the deceleration
    MSlack  = 6'h0a,  // margin(VT)
    // constants
    K0      = 6'h10,
    K1      = 6'h11,
    K3      = 6'h1c,
    K4      = 6'h12,
    K100    = 6'h13,
    K150    = 6'h14,
    K153    = 6'h15,
    K325    = 6'h16,
    K416    = 6'h17,
    K20000  = 6'h18,
    K54400  = 6'h19,
    K3x2p16 = 6'h1a,  // 196608
    K2p31   = 6'h1b,
    // the motion's registers and its settings as sampled
    RV      = 6'h20,
    RVe     = 6'h21,
    RLeft   = 6'h22,  // R
    RVmax   = 6'h23,
    RAdc    = 6'h24,  // h << 6
    RAdc9   = 6'h25,  // h[9] << 6
    RCur    = 6'h26,
    RCcomp  = 6'h27,
    RScomp  = 6'h28,
    RMstep  = 6'h29,  // 1, 2, 4, .. 128
    // of the calculator
    RLo     = 6'h2a,
    RMid    = 6'h2b,  // {hi, lo} >> 16
    RMargin = 6'h2c,  // margin(hi): (hi >> 12) + 4
    RRoot   = 6'h2d,  // 4 * VN + 1
    RRate   = 6'h2e,  // 17 << na or, for a ramp that falls, nd
    RWay    = 6'h2f   // 3400 << na, with Dec nd
  } operand_e;

  typedef enum logic [3:0] {
    Always,
    IfCarry,
    IfNotCarry,
    IfZero,      // hi = 0
    IfShort,     // kind L
    IfSpeed,     // kind V
    IfStop,      // speed mode has been switched off
    IfAnalog,
    IfPlan,      // before t = 0
    IfEnding,    // phase STOP or END
    IfRamp,      // phase RAMP, DEC or STOP
    IfLive,      // phase CRUISE or RAMP
    IfUp,        // the ramp rises
    IfSmooth,    // the ramp is an S
    IfAcc5,      // na = 5
    IfDec5       // nd = 5
  } cond_e;

  // Bit 2: a ramp; without it, what follows the ramp.
  typedef enum logic [2:0] {
    PhCruise = 3'b000,
    PhCreep  = 3'b001,
    PhEnd    = 3'b010,
    PhRamp   = 3'b100,
    PhDec    = 3'b101,
    PhStop   = 3'b110
  } phase_e;

  // Of a set: bit 3 of aux says that the ramp is over, bits 2..0 which of phase, up and smooth are set.
  typedef struct packed {
    op_e op;
    logic [3:0] aux;  // as where_e, steps_e, out_e or cond_e
    logic [8:0] low;  // operand, jump target or {phase_e, up, smooth}
  } instr_t;

  // ---- written by `make rom` from pmc006_calc.asm: where the program is entered, how long it is ------------------

  localparam logic [8:0] EntryPlan = 9'd0;
  localparam logic [8:0] EntryTick = 9'd1;
  localparam int unsigned ProgramWords = 280;

  // ---- end of what is written --------------------------------------------------------------------------------

endpackage

`default_nettype wire
