// SPDX-License-Identifier: Apache-2.0
// pmc006_calc_pkg: operations, operands and conditions of the instruction set of the motion planner
//         pmc006_calc.
// Rules:  P006-MOT-10..23, P006-EXC-20..23, which the program in pmc006_calc.asm implements.
// How:    an instruction is {operation, aux, operand} or {jump, condition, target}. {hi, lo} is the 64-bit
//         accumulator; the adder has 32 bits, and load, add and sub use only hi. V is the current speed, VT
//         the target speed, R the remaining steps, h the analog sample, na and nd are the coefficients of
//         acceleration and deceleration. Vn, Bn and Wn are the next values of V, B and W.
`default_nettype none

package pmc006_calc_pkg;

  // A design uses only some of the items of this package.
  // verilator lint_off UNUSEDPARAM

  typedef enum logic [3:0] {
    OpHalt,
    OpLoad,   // hi = operand
    OpAdd,    // hi = hi + operand; carry = overflow
    OpSub,    // hi = hi - operand; carry = (operand <= hi)
    OpStore,  // word = hi
    OpMul,    // {hi, lo} = ((hi + operand * (lowest n bits of lo)) << (32 - n)) + (lo >> n)
    OpDiv,    // lo = {hi, lo} / operand, hi = remainder
    OpRoot,   // Vn = square root of lo; requires hi = 0 and Vn = 0
    OpOut,    // output = hi, or increment a coefficient
    OpSet,    // set phase and shape of the ramp, see instr_t.low
    OpJump
  } calc_op_e;

  // Field aux of a load, addition, subtraction or division.
  typedef enum logic [3:0] {
    OperandPlain,
    OperandDec,    // RWay uses nd instead of na
    OperandLow,    // the result is stored in lo, and hi = 0
    OperandLowDec
  } operand_mode_e;

  // Field aux of a multiplication: number of steps.
  typedef enum logic [3:0] {
    Steps1,
    Steps2,
    Steps16 = 4'd3,
    Steps32
  } mul_steps_e;

  // Field aux of an output.
  typedef enum logic [3:0] {
    OutNext,   // Vn = hi
    OutSpeed,  // V = Vn = hi
    OutCurrentComp,   // Bn = hi >> 6
    OutLeadAngle,   // Wn = min(64, hi)
    OutAcc,    // na = na + 1
    OutDec     // nd = nd + 1
  } output_sel_e;

  // Operands. Bits 6:5 = 00: word of pmc006_calc_words; 01: table of pmc006_calc_words; 10: register.
  typedef enum logic [6:0] {
    // words that the program writes
    MLt     = 7'h00,  // last target speed
    MU      = 7'h01,  // progress of the ramp
    MDu     = 7'h02,  // increment of MU; 0 represents 2^32
    MV1     = 7'h03,  // first speed of the ramp
    MDv     = 7'h04,  // difference between the last and the first speed of the ramp
    MLeft   = 7'h05,  // R at this update tick
    MT      = 7'h06,  // intermediate result
    MX      = 7'h07,  // intermediate result
    MWay1   = 7'h08,  // acceleration distance, steps
    MWay2   = 7'h09,  // deceleration distance, steps
    MSlack  = 7'h0a,  // margin(VT) + 3
    // constants
    K0      = 7'h10,
    K1      = 7'h11,
    K3      = 7'h12,
    K4      = 7'h13,
    K100    = 7'h14,
    K20000  = 7'h15,
    K54400  = 7'h16,
    K3x2p16 = 7'h17,  // 196608
    K2p31   = 7'h18,
    // tables; bits 2:0 of the address are the coefficient
    RRate   = 7'h20,  // 17 << na, or 17 << nd if the ramp falls
    RWay    = 7'h28,  // 3400 << na; with OperandDec: 3400 << nd
    // registers of the motion, and sampled settings
    RV      = 7'h40,
    RVe     = 7'h41,
    RLeft   = 7'h42,  // R
    RVmax   = 7'h43,
    RAdc    = 7'h44,  // h << 6
    RAdc9   = 7'h45,  // h[9] << 6
    RBase   = 7'h46,  // base code RB of the current
    RCcomp  = 7'h47,
    RScomp  = 7'h48,
    RMstep  = 7'h49,  // microsteps per full step: 1, 2, 4, .. 128
    // registers of pmc006_calc
    RLo     = 7'h4c,
    RMid    = 7'h4d,  // {hi, lo} >> 16
    RMargin = 7'h4e,  // margin(hi): (hi >> 12) + 4
    RRoot   = 7'h4f   // 4 * Vn + 1
  } operand_e;

  typedef enum logic [3:0] {
    CondAlways,
    CondCarry,
    CondNotCarry,
    CondZero,      // hi = 0
    CondShort,     // short move: at most 255 steps
    CondSpeed,     // speed run
    CondStop,      // speed run, and the stop request is active
    CondAnalog,
    CondPlan,      // a motion is being planned (run started by plan_i)
    CondEnding,    // phase STOP or END
    CondRamp,      // phase RAMP, DEC or STOP
    CondLive,      // phase CRUISE or RAMP, and not a short move
    CondUp,        // the ramp rises
    CondSmooth,    // the ramp is an S-curve
    CondAcc5,      // na = 5
    CondDec5       // nd = 5
  } cond_e;

  // Bit 2 = 1: a ramp. The phase that follows this ramp has the same bits 1:0, and bit 2 = 0.
  typedef enum logic [2:0] {
    PhCruise = 3'b000,
    PhCreep  = 3'b001,
    PhEnd    = 3'b010,
    PhRamp   = 3'b100,
    PhDec    = 3'b101,
    PhStop   = 3'b110
  } phase_e;

  // Field aux of OpSet: bit 3 ends the ramp (it clears bit 2 of the phase). Otherwise bits 2, 1, 0 enable the
  // setting of phase, up and smooth.
  typedef struct packed {
    calc_op_e   op;
    logic [3:0] aux;  // operand_mode_e, mul_steps_e, output_sel_e or cond_e
    logic [8:0] low;  // operand, jump target, or {phase_e, up, smooth}
  } instr_t;

  // ---- written by `make rom` from pmc006_calc.asm: entry points and length of the program -----------------

  localparam logic [8:0] ENTRY_PLAN = 9'd0;
  localparam logic [8:0] ENTRY_TICK = 9'd1;
  localparam int unsigned CALC_ROM_WORDS = 272;

  // ---- end of the generated lines -------------------------------------------------------------------------

  // verilator lint_on UNUSEDPARAM

endpackage

`default_nettype wire
