// SPDX-License-Identifier: Apache-2.0
// ppmc2104_pkg: codes, error numbers, limits and types that only the PPMC-2104AFP has.
// Rules:  P2104-CMD-01..03, P2104-INI-01/02, P2104-AUX-04..06, P2104-OPR-03; error numbers:
//         docs/ppmc2104/README.md, 5.2.
`default_nettype none

package ppmc2104_pkg;

  // A design uses only some of the items of this package.
  // verilator lint_off UNUSEDPARAM

  import ppmc_op_pkg::*;

  localparam int unsigned AXES = 2;

  localparam int unsigned RATE_BITS = 8;
  localparam int unsigned STEP_BITS = 14;
  localparam int unsigned COUNT_BITS = 24;

  localparam int unsigned STEPS_MIN = 4;  // smallest number of acceleration pulses PA
  localparam int unsigned STEPS_MAX = 11_220;
  localparam int unsigned RATE_GAP = 2;  // RL must be at least RH + 2

  localparam int unsigned QUANTUM_XTAL = 4;  // crystal cycles per quantum
  localparam int unsigned WIDTH_XTAL = 80;  // 5 us: pulse width, direction set-up time, release of INT
  localparam int unsigned CLOCK_OUT_XTAL = 2;  // half period of clk_o in crystal cycles

  localparam int unsigned HOLD_QUANTA = 512;  // unit of the hold delay in quanta, 128 us
  localparam logic [7:0] HOLD_DEFAULT = 8'h18;
  localparam logic [7:0] CHOP_ON_DEFAULT = 8'h53;  // default on time, in units of two quanta (0.5 us)
  localparam logic [7:0] CHOP_OFF_DEFAULT = 8'hA6;

  // Error numbers, as the host reads them.
  typedef enum logic [3:0] {
    ErrNone      = 4'd0,
    ErrUndefined = 4'd1,
    ErrData      = 4'd2,   // data byte that no code needs
    ErrAbandoned = 4'd3,   // code while data bytes are expected
    ErrInitial   = 4'd4,   // the instruction needs an initialised axis
    ErrBusy      = 4'd5,
    ErrStopped   = 4'd6,   // stop of an axis that does not move
    ErrRefused   = 4'd7,   // a limit, the alarm or the origin prevents the start
    ErrDecel     = 4'd8,   // a deceleration stop is not possible
    ErrRates     = 4'd9,   // RL < RH + 2, PA too small, or rate 0 with the internal clock
    ErrSteps     = 4'd10,  // PA too large
    ErrSwitching = 4'd11,
    ErrRateOne   = 4'd12,  // too fast, even if only this axis operates
    ErrRateTwo   = 4'd13   // too fast while the other axis operates
  } cmd_error_e;

  typedef enum logic [3:0] {
    CmdUndefined,
    CmdInit,
    CmdHalt,       // Immediate stop
    CmdDecel,      // Deceleration stop
    CmdOperation,
    CmdRead,
    CmdErrorRead,
    CmdSwitching,
    CmdHoldDelay,
    CmdExcOff,
    CmdAuxOut,
    CmdAuxIn
  } cmd_kind_e;

  // Bits 2:0 of the codes 10A0 0xxx.
  localparam logic [2:0] SEL_END = 3'b000;
  localparam logic [2:0] SEL_INPUTS = 3'b001;
  localparam logic [2:0] SEL_OUTPUTS = 3'b010;
  localparam logic [2:0] SEL_REMAINING = 3'b011;
  localparam logic [2:0] SEL_SWITCHING = 3'b100;
  localparam logic [2:0] SEL_HOLD_DELAY = 3'b101;
  localparam logic [2:0] SEL_ERROR = 3'b110;

  // Bits of the initial setting code; the letters are the names in the manual.
  typedef struct packed {
    logic [1:0] prefix;    // always 00
    logic       second;    // A, 1: axis 2
    logic       chop;      // S, 1: chop at standstill
    logic       external;  // C, 1: base clock from the EXTCK pin
    logic       half;      // E, 1: half step
    logic [1:0] motor;     // MM, type of motor
  } init_code_t;

  // Bits of an operation code; the letters are the names in the manual.
  typedef struct packed {
    logic       pout_only;  // P, 1: POUT mode
    logic       prefix;     // always 1
    logic       second;     // A, 1: axis 2
    logic       silent;     // I, 1: no interrupt at the end
    logic       ccw;        // D, 1: CCW
    logic [2:0] op;
  } op_code_t;

  typedef struct packed {
    cmd_kind_e  kind;
    logic [2:0] params;  // number of data bytes that follow
  } decoded_t;

  function automatic decoded_t decode(logic [7:0] code);
    decoded_t d;
    d = '{kind: CmdUndefined, params: 3'd0};
    unique case (code[7:6])
      2'b00: if (code[1:0] != 2'b00) d = '{kind: CmdInit, params: 3'd4};
      2'b01: begin
        if (code[2:0] == 3'b000) d.kind = CmdHalt;
        else if (code[2:0] == 3'b001) d.kind = CmdDecel;
        else d = '{kind: CmdOperation, params: op_params(code[2:0])};
      end
      2'b10:
      if (code[4:3] == 2'b00) begin
        unique case (code[2:0])
          SEL_SWITCHING:  d = '{kind: CmdSwitching, params: 3'd2};
          SEL_HOLD_DELAY: d = '{kind: CmdHoldDelay, params: 3'd1};
          SEL_ERROR:      d.kind = CmdErrorRead;
          3'b111:         ;
          default:        d.kind = CmdRead;
        endcase
      end
      default:
      unique case (code[2:0])
        3'b000:                   if (code[4:3] == 2'b00) d.kind = CmdExcOff;
        3'b001:                   if (!code[3]) d.kind = CmdAuxOut;
        3'b010:                   if (code[5:3] == 3'b000) d.kind = CmdAuxIn;
        OP_ACC_DEC, OP_CONT_HIGH: d = '{kind: CmdOperation, params: op_params(code[2:0])};
        default:                  ;
      endcase
    endcase
    return d;
  endfunction

  // Actions of a byte for one axis.
  typedef struct packed {
    logic init;        // an initial setting is accepted
    logic start;       // start of an operation
    logic halt;        // Immediate stop
    logic decel;       // Deceleration stop
    logic exc_off;
    logic switching;
    logic hold_delay;
    logic read;        // read of end status, inputs, outputs, remaining pulses or error code
  } axis_action_t;

  // Actions of a byte: those of each axis, and the auxiliary instructions, which belong to no axis.
  typedef struct packed {
    axis_action_t [AXES:1] axis;
    logic                  aux_out;
    logic                  aux_in;
  } action_t;

  // Error of an instruction, and the axis for which it is stored.
  typedef struct packed {
    logic [AXES:1] axis;    // axis in error; 0: no error
    cmd_error_e    number;
  } error_report_t;

  // Pin levels of an axis after the synchroniser.
  typedef struct packed {
    logic run;
    logic csel;
    logic org;
    logic alm;
    logic fl;
    logic fhl;
    logic bl;
    logic bhl;
  } pin_levels_t;

  // Settings of an axis, made by the host (ppmc2104_setup).
  typedef struct packed {
    logic                 initialised;  // 0: state INITIAL
    logic [RATE_BITS-1:0] slow;         // start-up rate RL
    logic [RATE_BITS-1:0] fast;         // high-speed rate RH
    logic [STEP_BITS-1:0] steps;        // acceleration pulses PA
    logic                 chop;         // S, 1: chop at standstill
    logic                 external;     // C, 1: base clock from the EXTCK pin
    logic                 half;         // E, 1: half step
    logic [1:0]           motor;        // MM, type of motor as in motor_e
    logic [7:0]           on;           // on time of the chopper in units of two quanta
    logic [7:0]           off;          // off time of the chopper in units of two quanta
    logic [7:0]           hold_delay;   // hold delay in units of HOLD_QUANTA, minus 1
  } setup_t;

  // State of an axis, as far as the command unit needs it.
  typedef struct packed {
    logic   busy;
    logic   moving;    // waiting for pulse 1, or outputting pulses
    logic   decel_ok;  // 1: a deceleration stop is accepted
    setup_t setup;
  } axis_summary_t;

  // verilator lint_on UNUSEDPARAM

endpackage

`default_nettype wire
