// SPDX-License-Identifier: Apache-2.0
// ppmc312_pkg: instruction codes, statuses, accept table, instruction lengths, reports and errors of the
//         PPMC-312.
// Rules:  P312-STA-01 (accept table), P312-BLK-01 (lengths); docs/ppmc312/README.md, Answers and reports
//         (reports, errors, causes).
`default_nettype none

package ppmc312_pkg;

  // A design uses only some of the items of this package.
  // verilator lint_off UNUSEDPARAM

  // ---- sizes --------------------------------------------------------------------------------------

  localparam int unsigned RATE_BITS = 16;
  localparam int unsigned BLOCK_BITS = 5;  // address within a block of 32 bytes
  localparam int unsigned WIDTH_XTAL = 80;  // pulse width TW in crystal periods

  // ---- instruction codes --------------------------------------------------------------------------

  localparam logic [7:0] I_INIT = 8'h00;
  localparam logic [7:0] I_FREE = 8'h01;
  localparam logic [7:0] I_INPOS = 8'h02;
  localparam logic [7:0] I_ENCODE = 8'h03;
  localparam logic [7:0] I_LOCK_POS = 8'h04;
  localparam logic [7:0] I_LIMIT = 8'h05;
  localparam logic [7:0] I_END = 8'h06;
  localparam logic [7:0] I_ORIGIN = 8'h10;
  localparam logic [7:0] I_ZERO = 8'h11;
  localparam logic [7:0] I_EXC_ON = 8'h20;
  localparam logic [7:0] I_EXC_OFF = 8'h21;
  localparam logic [7:0] I_CCLR = 8'h22;
  localparam logic [7:0] I_CLAMP = 8'h23;
  localparam logic [7:0] I_ACLR = 8'h24;
  localparam logic [7:0] I_AUX_IN = 8'h25;
  localparam logic [7:0] I_AUX_OUT = 8'h26;
  localparam logic [7:0] I_PINS = 8'h27;
  localparam logic [7:0] I_MASK = 8'h28;
  localparam logic [7:0] I_VERSION = 8'h40;
  localparam logic [7:0] I_TABLE = 8'h41;
  localparam logic [7:0] I_POS = 8'h42;
  localparam logic [7:0] I_POS_SET = 8'h43;
  localparam logic [7:0] I_LOCK = 8'h44;
  localparam logic [7:0] I_SYNC = 8'h45;
  localparam logic [7:0] I_EVT_READ = 8'h47;
  localparam logic [7:0] I_EVT_SET = 8'h49;
  localparam logic [7:0] I_STATUS = 8'h4d;
  localparam logic [7:0] I_HALT = 8'h80;
  localparam logic [7:0] I_DECEL = 8'h81;
  localparam logic [7:0] I_MOVE = 8'h82;
  localparam logic [7:0] I_CONST = 8'h83;
  localparam logic [7:0] I_STEP = 8'h84;
  localparam logic [7:0] I_HIGH = 8'h85;
  localparam logic [7:0] I_CONT = 8'h86;
  localparam logic [7:0] I_RAMP = 8'h87;
  localparam logic [7:0] I_SPEED = 8'h88;
  localparam logic [7:0] I_RESET = 8'hff;

  // ---- statuses: one-hot, in the bit order of the condition byte ----------------------------------

  typedef enum logic [5:0] {
    StatusIni = 6'b000001,
    StatusNor = 6'b000010,
    StatusAcc = 6'b000100,
    StatusFix = 6'b001000,
    StatusAbn = 6'b010000,
    StatusWrn = 6'b100000
  } status_e;

  // ---- properties of an instruction code ----------------------------------------------------------

  typedef struct packed {
    logic       is_known;
    logic       has_ov;         // if bit 2 (OV) of the first parameter is 1, the instruction is stored
    logic       starts_motion;  // the instruction starts pulses
    logic       has_rate;       // parameters 1 and 2 are a rate
    logic       zero_is_rh;     // a rate of 0 selects RH
    logic       has_count;      // parameters 3 .. 6 are a number of pulses
    logic [5:0] states_ov0;     // statuses that accept the code with OV = 0
    logic [5:0] states_ov1;     // statuses that accept the code with OV = 1
    logic [4:0] len_long;       // longer valid length of code and parameters in bytes
    logic [4:0] len_short;      // shorter valid length in bytes; at most len_long
  } instr_info_t;

  localparam logic [5:0] STATES_STANDSTILL = StatusIni | StatusNor;
  localparam logic [5:0] STATES_RUNNING = StatusAcc | StatusFix;
  localparam logic [5:0] STATES_OV1 = StatusNor | StatusAcc | StatusFix;
  localparam logic [5:0] STATES_ALL = 6'b111111;

  function automatic instr_info_t common_info(logic [5:0] states_ov0, logic [4:0] len);
    return
    '{
        is_known: 1'b1,
        has_ov: 1'b0,
        starts_motion: 1'b0,
        has_rate: 1'b0,
        zero_is_rh: 1'b0,
        has_count: 1'b0,
        states_ov0: states_ov0,
        states_ov1: states_ov0,
        len_long: len,
        len_short: len
    }
    ;
  endfunction

  function automatic instr_info_t instr_info(logic [7:0] code);
    instr_info_t i;
    i = common_info(STATES_ALL, 5'd1);
    unique case (code)
      I_INIT: begin
        i = common_info(STATES_STANDSTILL, 5'd14);
        i.len_short = 5'd9;
      end
      I_FREE: begin
        i = common_info(STATES_STANDSTILL, 5'd4);
        i.len_short = 5'd3;
      end
      I_INPOS, I_ENCODE: i = common_info(STATES_STANDSTILL, 5'd4);
      I_LOCK_POS: i = common_info(STATES_STANDSTILL, 5'd5);
      I_LIMIT: i = common_info(StatusNor, 5'd3);
      I_END: i = common_info(STATES_STANDSTILL, 5'd2);
      I_EXC_ON, I_EXC_OFF, I_CCLR, I_CLAMP, I_TABLE: i = common_info(STATES_STANDSTILL, 5'd1);
      I_ACLR: i = common_info(STATES_STANDSTILL | StatusAbn | StatusWrn, 5'd1);
      I_AUX_IN, I_PINS, I_VERSION, I_STATUS, I_RESET: i = common_info(STATES_ALL, 5'd1);
      I_AUX_OUT, I_POS: i = common_info(STATES_ALL, 5'd2);
      I_MASK: i = common_info(STATES_STANDSTILL, 5'd3);
      I_POS_SET: i = common_info(STATES_STANDSTILL, 5'd6);
      I_LOCK: i = common_info(StatusNor, 5'd1);
      I_SYNC: i = common_info(StatusNor | StatusWrn, 5'd1);
      I_EVT_READ: begin
        i = common_info(StatusNor, 5'd2);
        i.len_short = 5'd1;
      end
      I_EVT_SET: i = common_info(StatusNor, 5'd2);
      I_HALT, I_DECEL: begin
        i = common_info(STATES_RUNNING, 5'd6);
        i.len_short = 5'd2;
      end
      I_MOVE: begin
        i = common_info(StatusNor, 5'd8);
        i.len_short = 5'd6;
      end
      I_CONST: i = common_info(StatusNor, 5'd8);
      I_STEP: i = common_info(StatusNor, 5'd2);
      I_HIGH, I_CONT, I_ORIGIN, I_ZERO: i = common_info(StatusNor, 5'd4);
      I_RAMP: begin
        i = common_info(StatusFix, 5'd8);
        i.len_short = 5'd4;
      end
      I_SPEED: begin
        i = common_info(STATES_RUNNING, 5'd8);
        i.len_short = 5'd4;
      end
      default: i.is_known = 1'b0;
    endcase
    if (code inside {I_HALT, I_DECEL, I_MOVE, I_CONST, I_HIGH, I_CONT, I_RAMP, I_SPEED}) begin
      i.has_ov = 1'b1;
      i.states_ov1 = STATES_OV1;
    end
    i.starts_motion = code inside {I_ORIGIN, I_ZERO, I_MOVE, I_CONST, I_STEP, I_HIGH, I_CONT};
    i.has_rate      = code inside {I_ORIGIN, I_ZERO, I_MOVE, I_CONST, I_HIGH, I_CONT, I_RAMP, I_SPEED};
    i.zero_is_rh    = code inside {I_ZERO, I_MOVE, I_CONST, I_HIGH, I_CONT};
    i.has_count     = code inside {I_MOVE, I_CONST};
    return i;
  endfunction

  // ---- reports, error numbers ---------------------------------------------------------------------

  localparam logic [7:0] A_STOP = 8'he0;
  localparam logic [7:0] A_UNLOCK = 8'he1;
  localparam logic [7:0] A_HOLD_END = 8'he2;
  localparam logic [7:0] A_ENCODE = 8'he3;
  localparam logic [7:0] A_INPOS = 8'he4;
  localparam logic [7:0] A_STORED = 8'he8;
  localparam logic [7:0] A_AUX = 8'he9;
  localparam logic [7:0] A_PARAM = 8'hf0;
  localparam logic [7:0] A_STATUS = 8'hf1;
  localparam logic [7:0] A_LIMIT = 8'hf2;
  localparam logic [7:0] A_ALARM = 8'hf4;
  localparam logic [7:0] A_COMMAND = 8'hf5;
  localparam logic [7:0] A_SIZE = 8'hf6;
  localparam logic [7:0] A_FULL = 8'hf7;
  localparam logic [7:0] A_EVENT = 8'hf8;
  localparam logic [7:0] A_OVERRIDE = 8'hf9;

  localparam logic [7:0] E_INIT_LEN = 8'h00;
  localparam logic [7:0] E_RATE = 8'h01;
  localparam logic [7:0] E_SPREAD = 8'h02;
  localparam logic [7:0] E_ORDER = 8'h03;
  localparam logic [7:0] E_CLOSE = 8'h04;
  localparam logic [7:0] E_TOO_FEW_PULSES = 8'h05;
  localparam logic [7:0] E_FREE_HEADER = 8'h10;
  localparam logic [7:0] E_FREE_STAGES = 8'h11;
  localparam logic [7:0] E_FREE_LONG = 8'h15;
  localparam logic [7:0] E_FREE_SIZE = 8'h16;
  localparam logic [7:0] E_FREE_LAST = 8'h17;
  localparam logic [7:0] E_FREE_RATE = 8'h18;
  localparam logic [7:0] E_FREE_PULSES = 8'h19;
  localparam logic [7:0] E_FREE_SUM = 8'h1a;
  localparam logic [7:0] E_RATE_RANGE = 8'h20;
  localparam logic [7:0] E_TRIGGER = 8'h21;
  localparam logic [7:0] E_OPERAND = 8'h23;
  localparam logic [7:0] E_EVT_NUMBER = 8'h24;
  localparam logic [7:0] E_EVT_LEN = 8'h25;
  localparam logic [7:0] E_INPOS_ZERO = 8'h26;
  localparam logic [7:0] E_ENCODE_ZERO = 8'h27;

  // Causes of the end of a motion, in the bit order of the byte in report E0. The value is one-hot.
  typedef struct packed {logic als, nos, org, low, dec, stp, del, stl;} end_cause_t;

  // verilator lint_on UNUSEDPARAM

endpackage

`default_nettype wire
