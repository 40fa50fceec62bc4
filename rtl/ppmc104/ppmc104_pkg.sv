// SPDX-License-Identifier: Apache-2.0
// ppmc104_pkg: codes, error numbers and limits of the PPMC-104BFP; what makes this part differ from its
// sisters.
// Rules:  P104-CMD-01..04, P104-ERR-00, P104-INI-01/03, P104-SW-04.
`default_nettype none

package ppmc104_pkg;

  import ppmc_op_pkg::*;

  localparam int unsigned RATE_BITS = 8;
  localparam int unsigned STEP_BITS = 14;
  localparam int unsigned COUNT_BITS = 24;

  localparam int unsigned STEPS_MIN = 4;  // acceleration pulses PA
  localparam int unsigned STEPS_MAX = 11_220;

  localparam int unsigned QUANTUM_XTAL = 4;  // crystal cycles a quantum
  localparam int unsigned HOLD_QUANTA = 136_000;  // 34 ms

  // Chopper times in quanta (P104-SW-04).
  localparam int unsigned CHOP_UNIT = 12;
  localparam int unsigned CHOP_ON_DEFAULT = 260;
  localparam int unsigned CHOP_OFF_DEFAULT = 435;
  localparam int unsigned CHOP_ON_VSEL_H = 108;
  localparam int unsigned CHOP_OFF_VSEL_H = 132;
  localparam int unsigned CHOP_ON_VSEL_L = 100;
  localparam int unsigned CHOP_OFF_VSEL_L = 115;

  // Error numbers as shown in status bits 6..4 (P104-ERR-00).
  typedef enum logic [2:0] {
    ErrUndefined  = 3'd0,  // also: a stop with no motion
    ErrBusy       = 3'd1,
    ErrNotReady   = 3'd2,  // operation before initialisation
    ErrData       = 3'd3,  // data byte nobody asked for
    ErrStepsHigh  = 3'd4,
    ErrRates      = 3'd5,  // RH > RL, or PA too small
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

  // Low three bits of the codes 10 000 xxx.
  localparam logic [2:0] SEL_FINISH = 3'b000;
  localparam logic [2:0] SEL_INPUTS = 3'b001;
  localparam logic [2:0] SEL_OUTPUTS = 3'b010;
  localparam logic [2:0] SEL_REMAINING = 3'b011;
  localparam logic [2:0] SEL_SWITCHING = 3'b100;
  localparam logic [2:0] SEL_AUX_IN = 3'b101;
  localparam logic [2:0] SEL_AUX_OUT = 3'b110;

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
    logic       pout_only;
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

  function automatic decoded_t decode(logic [7:0] code);
    decoded_t d;
    d = '{kind: KindUndefined, params: 3'd0};
    unique case (code[7:6])
      2'b00: if (code[1:0] != 2'b00) d = '{kind: KindInit, params: 3'd4};
      2'b01: begin
        if (code[2:0] == 3'b000) d.kind = KindHalt;
        else if (code[2:0] == 3'b001) d.kind = KindDecel;
        else d = '{kind: KindOperation, params: op_params(code[2:0])};
      end
      2'b10:
      if (code[5:3] == 3'b000) begin
        unique case (code[2:0])
          SEL_SWITCHING: d = '{kind: KindSwitching, params: 3'd2};
          SEL_AUX_OUT:   d = '{kind: KindAuxOut, params: 3'd1};
          3'b111:        ;
          default:       d.kind = KindRead;
        endcase
      end
      default:
      unique case (code[2:0])
        3'b000:                   d.kind = KindExcOff;
        3'b001:                   d.kind = KindAuxOn;
        3'b010:                   d.kind = KindAuxOff;
        OP_ACC_DEC, OP_CONT_HIGH: d = '{kind: KindOperation, params: op_params(code[2:0])};
        default:                  ;
      endcase
    endcase
    return d;
  endfunction

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

  // What the host has set (ppmc104_setup).
  typedef struct packed {
    logic [RATE_BITS-1:0] slow;       // start-up rate RL
    logic [RATE_BITS-1:0] fast;       // high-speed rate RH
    logic [STEP_BITS-1:0] steps;      // acceleration pulses PA
    logic                 external;   // base clock from the pin
    logic                 chop;       // chop at rest; 0 until an initialisation is complete
    logic                 positive;   // phases: high is on
    logic                 half;       // half step
    logic [1:0]           motor;      // phases of the motor, as motor_e
    logic [8:0]           on_base;    // chopper, quanta
    logic [8:0]           off_base;
    logic [7:0]           on_units;   // chopper, units of CHOP_UNIT quanta
    logic [7:0]           off_units;
  } setup_t;

endpackage

`default_nettype wire
