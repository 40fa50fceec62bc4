// SPDX-License-Identifier: Apache-2.0
// ppmc_bridge_pkg: constants and types of the UART bridge, such as codes of operations (ops), results, NAK
//         codes, line rates and CRC.
// Rules:  docs/uart_bridge.md.
`default_nettype none

package ppmc_bridge_pkg;

  // A design uses only some of the items of this package.
  // verilator lint_off UNUSEDPARAM

  localparam logic [7:0] FLAG = 8'h7E;
  localparam logic [7:0] ESCAPE = 8'h7D;
  localparam int unsigned ESCAPE_BIT = 5;  // bit that is inverted in an escaped byte
  localparam logic [7:0] PROTOCOL_VERSION = 8'd1;
  localparam logic [15:0] DEFAULT_LIMIT_MS = 16'd250;  // default time limit of a wait
  localparam int unsigned SILENCE_MS = 100;  // maximum silence inside a frame
  localparam int unsigned TRIAL_MS = 1000;  // time in which a new rate must be confirmed

  // Ops without a register number: bits 3:0 of an op whose bits 7:4 are OpSystem.
  typedef enum logic [3:0] {
    SysNop,
    SysIdent,
    SysRate,
    SysEvents,
    SysTimeout,
    SysReset,
    SysPins,
    SysStraps,
    SysCount,
    SysZero,
    SysCount2,   // COUNT of axis 2
    SysZero2,
    SysVersion,
    SysRecord,
    SysRecorded
  } sys_e;

  // Bits 7:4 of an op.
  typedef enum logic [3:0] {
    OpSystem,
    OpWrite,
    OpRead,
    OpReadN,
    OpPost,
    OpCall,
    OpGet,
    OpWait,
    OpWriteN,
    OpFetch
  } op_group_e;

  typedef enum logic [2:0] {
    ResDone,
    ResTimeout,
    ResRefused,
    ResIllegal,
    ResOverflow,
    ResInterrupted
  } result_e;

  // Result of a script. It is valid from the end of the script until the next script begins.
  typedef struct packed {
    result_e    result;
    logic [7:0] pos;     // position of the op that ended the script
    logic [7:0] last;    // last byte that the script has read; 0: no byte
    logic [8:0] length;  // number of data bytes in the answer
  } script_result_t;

  // Settings that scripts make, from the script engine to the other blocks of the bridge.
  typedef struct packed {
    logic       valid;   // strobe: op and arg are valid
    sys_e       op;      // RATE, EVENTS, RECORD or another op
    logic [2:0] arg;     // first operand
    logic [7:0] straps;  // strap outputs, set by op STRAPS
  } bridge_cmd_t;

  // Operand of op RECORD.
  localparam logic [1:0] RECORD_END = 2'd0;
  localparam logic [1:0] RECORD_BEGIN = 2'd1;
  localparam logic [1:0] RECORD_REWIND = 2'd2;

  // What an op needs first.
  typedef enum logic [2:0] {
    NeedNothing,  // the op is complete
    NeedOperand,
    NeedCheck,    // check of the number that the code of the op contains
    NeedByte,     // one byte to be stored in the answer
    NeedBlock     // bytes to be stored in the answer, or a pause
  } op_need_e;

  // Block of 16 bytes for the answer.
  typedef enum logic [1:0] {
    BlockIdent,
    BlockVersion,
    BlockRecorded
  } block_e;

  typedef enum logic [3:0] {
    NakNone,
    NakFraming,
    NakCrc,
    NakLong,
    NakShort,
    NakSilence,
    NakAbort,
    NakBusy,
    NakSeq
  } nak_e;

  // Line rate of a code in baud (UB-LIN-02).
  function automatic int unsigned rate_hz(int unsigned code, int unsigned baud);
    unique case (code)
      1: return 230_400;
      2: return 460_800;
      3: return 921_600;
      4: return 1_000_000;
      5: return 2_000_000;
      6: return 3_000_000;
      default: return baud;
    endcase
  endfunction

  function automatic bit is_available(int unsigned code, int unsigned clk_hz, int unsigned baud);
    return code <= 6 && 64'(clk_hz) >= 64'd5 * 64'(rate_hz(code, baud));
  endfunction

  // Highest available code. The codes are in the order of their rates.
  function automatic int unsigned top_code(int unsigned clk_hz, int unsigned baud);
    int unsigned top;
    top = 0;
    for (int unsigned code = 1; code <= 6; code++) if (is_available(code, clk_hz, baud)) top = code;
    return top;
  endfunction

  // Bits of the phase accumulators. Rounding the step must not move the last edge of a character by more
  // than a quarter of a cycle at the slowest rate: 10 * (clk / rate) / (2 * step) <= 1/4.
  function automatic int unsigned phase_width(int unsigned clk_hz, int unsigned baud);
    longint unsigned ratio;
    int unsigned slowest;
    slowest = baud < 230_400 ? baud : 230_400;
    ratio   = 64'(clk_hz) / 64'(slowest) + 64'd1;
    return 32'($clog2(64'd20 * ratio * ratio));
  endfunction

  // Step of a phase accumulator, rounded to the nearest integer.
  function automatic longint unsigned phase_step(int unsigned rate, int unsigned clk_hz, int unsigned width);
    return ((64'(rate) << (width + 1)) / 64'(clk_hz) + 64'd1) >> 1;
  endfunction

  // CRC-16 (polynomial 1021h) after one more byte (UB-FRM-03).
  function automatic logic [15:0] crc_next(logic [15:0] crc, logic [7:0] data);
    logic [7:0] mix;
    mix = crc[15:8] ^ data;
    mix = mix ^ (mix >> 4);
    return {crc[7:0], 8'd0} ^ {mix[3:0], 12'd0} ^ {3'd0, mix, 5'd0} ^ {8'd0, mix};
  endfunction

  // verilator lint_on UNUSEDPARAM

endpackage

`default_nettype wire
