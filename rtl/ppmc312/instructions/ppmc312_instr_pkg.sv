// SPDX-License-Identifier: Apache-2.0
// ppmc312_instr_pkg: types of the signals between the blocks that process instructions. These blocks are
//         check, response, instruction queue, set-up and moves.
// Rules:  docs/ppmc312/README.md, Instruction blocks, Answers and reports; P312-OVR-01/10, P312-EVT-01/04,
//         P312-CMD-FC-1..10.
// Note:   a strobe is high for one cycle.
`default_nettype none

package ppmc312_instr_pkg;

  // A design uses only some of the items of this package.
  // verilator lint_off UNUSEDPARAM

  import ppmc312_pkg::*;

  // ---- check and response -------------------------------------------------------------------------

  typedef enum logic [2:0] {
    CheckOk,
    CheckData,     // data block of a free-curve transfer
    CheckParam,    // response F0 with an error number
    CheckStatus,   // response F1
    CheckCommand,  // response F5
    CheckSize      // response F6
  } check_e;

  // Kind of a response. ppmc312_response_rom contains its layout.
  typedef enum logic [4:0] {
    // results of an executed instruction, selected by its code
    KindCode,         // no data
    KindNumber,       // response_t.number
    KindPar,          // first parameter
    KindFlag,         // new state of the setting that the instruction toggles
    KindAuxi,
    KindPins,
    KindVersion,
    KindPos,
    KindEntries,      // event buffer
    KindState,
    KindTable,        // data blocks follow
    KindProgress,     // free curve: next list, remaining stages
    // other responses
    KindBoot,
    KindSums,         // free curve: complete
    KindStored,
    KindFull,
    KindParam,        // with the echo of the instruction
    KindStatus,
    KindLimit,
    KindCommand,
    KindSize,
    KindFailEvent,
    KindFailOverride
  } response_kind_e;

  function automatic response_kind_e result_kind(logic [7:0] code);
    unique case (code)
      I_END:                                                        return KindPar;
      I_LOCK, I_SYNC:                                               return KindFlag;
      I_AUX_IN:                                                     return KindAuxi;
      I_PINS:                                                       return KindPins;
      I_VERSION:                                                    return KindVersion;
      I_POS:                                                        return KindPos;
      I_EVT_READ:                                                   return KindEntries;
      I_STATUS:                                                     return KindState;
      I_TABLE:                                                      return KindTable;
      I_FREE:                                                       return KindProgress;
      I_MOVE, I_CONST, I_HIGH, I_CONT, I_ORIGIN, I_ZERO, I_EVT_SET: return KindNumber;
      default:                                                      return KindCode;
    endcase
  endfunction

  // Source of a byte of a response: one of the bytes that ppmc312_response_writer lists in this order. With
  // source 0, bits 12:5 are the byte.
  typedef enum logic [12:0] {
    ByteNone,      // after the last byte
    ByteCode,      // code of the instruction
    BytePar,       // first parameter
    ByteLen,       // length byte of the instruction
    ByteEcho,      // byte of the instruction, as received
    ByteEchoLen,   // length byte of a response with an echo
    ByteNumber,    // response_t.number
    ByteStatus,    // response_t.status
    ByteFlag,
    ByteAuxi,
    BytePins[2],
    ByteState[3],
    ByteCount,     // entries of an event buffer
    ByteNext,      // next entry of an event buffer
    ByteEntry,     // code of an entry of an event buffer
    ByteLeft,      // remaining stages of a list of a free curve
    ByteUsed[3],   // stages of the table
    BytePos[4],    // position
    ByteSum[6]     // acceleration and deceleration pulses of the table
  } byte_source_e;

  // A response before it is written.
  typedef struct packed {
    response_kind_e kind;
    logic [7:0]     number;  // first byte after the code, if the layout contains ByteNumber
    status_e        status;  // status of the device, for ByteStatus
  } response_t;

  // Commands to the blocks that write responses and the data blocks of a table read. All fields except
  // hold_data are strobes.
  typedef struct packed {
    logic write;       // write the response
    logic hold_data;   // level: hold the data that the response may contain
    logic table_open;  // begin a table read, which sends data blocks
    logic table_next;  // write the next data block
  } response_cmd_t;

  typedef struct packed {
    logic                  written;     // strobe: the response is written
    logic [BLOCK_BITS-1:0] echo_addr;   // byte of the instruction that the echo needs two cycles later
    logic                  table_more;  // more data blocks follow
    logic                  table_done;  // strobe: a data block is written
  } response_status_t;

  // ---- instruction queue: instructions that wait for a trigger ------------------------------------

  // Write port of the instruction queue. All bytes of an entry precede entry_done.
  typedef struct packed {
    logic        we;          // strobe: write data at addr
    logic        to_event;    // 1: event buffer n, 0: command FIFO
    logic        n;
    logic [3:0]  addr;        // byte of the block, 0 = header
    logic [7:0]  data;        // byte to be written
    logic        entry_done;  // strobe: the entry is complete
    logic [7:0]  code;        // instruction code
    logic [1:0]  trig;        // bits 1:0 of the flags; x0: position, 01: event 0, 11: event 1
    logic [31:0] pos;         // trigger position in pulses
  } enqueue_t;

  // Removal from the instruction queue. All fields except from_event and n are strobes.
  typedef struct packed {
    logic       take;        // remove the triggered entry, which is executed now
    logic       from_event;  // with take, 1: event buffer n, 0: command FIFO
    logic       n;
    logic       all;         // remove all entries
    logic       fifo;        // empty the command FIFO
    logic [1:0] events;      // empty event buffer [n]
    logic [1:0] highest;     // remove the highest entry of event buffer [n]
  } dequeue_t;

  // Contents of the instruction queue.
  typedef struct packed {
    logic            fifo_triggered;    // a triggered entry of the command FIFO is pending
    logic [1:0]      fifo_trig;         // trigger of the oldest triggered entry of the command FIFO
    logic [1:0]      events_triggered;  // event buffer [n] has been triggered
    logic [3:0]      fifo_count;        // entries of the command FIFO, 0 .. 8
    logic [1:0]      fifo_uses_event;   // an entry of the FIFO waits for event pin [n]
    logic [1:0][2:0] event_count;       // entries of event buffer [n], 0 .. 4
    logic [1:0][1:0] event_next;        // next entry of event buffer [n], 0 .. 3
  } queue_status_t;

  // ---- set-up: initial setting and free curve -----------------------------------------------------

  // Commands to the set-up; strobes.
  typedef struct packed {
    logic build;  // build the table of an initial setting that passed the check
    logic open;   // begin a free curve, whose code block passed the check
    logic data;   // process a data block of a free curve that passed the check
    logic fail;   // a set-up has failed
  } setup_cmd_t;

  // Progress of a free curve.
  typedef struct packed {
    logic        complete;     // the curve is complete
    logic [1:0]  next_list;    // 0: rates, 1: acceleration, 2: deceleration
    logic [6:0]  stages_left;  // remaining stages of list next_list
    logic [23:0] acc_sum;      // acceleration pulses; valid with complete
    logic [23:0] dec_sum;      // deceleration pulses; valid with complete
  } curve_progress_t;

  typedef struct packed {
    logic                  transfer;  // a free-curve transfer is open
    logic                  done;      // strobe: build or data has ended
    logic                  failed;    // with done: the set-up has failed
    logic [7:0]            error;     // with failed: error number of response F0
    curve_progress_t       progress;  // with done: progress of the free curve
    logic [BLOCK_BITS-1:0] addr;      // number of the block byte that is used two cycles later
  } setup_status_t;

  // ---- moves and rate changes ---------------------------------------------------------------------

  typedef struct packed {
    logic       done;         // strobe: the start or rate change is finished
    logic       at_limit;     // with done: a limit prevents the start
    logic       rejected;     // with done: the current status does not allow the start
    logic [7:0] status_byte;  // with done: status byte of the response
  } move_status_t;

  // verilator lint_on UNUSEDPARAM

endpackage

`default_nettype wire
