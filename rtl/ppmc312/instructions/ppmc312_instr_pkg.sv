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

  // Source of the last bytes of a response.
  typedef enum logic [1:0] {
    TailNone,
    TailPos,    // 4 bytes: a position
    TailCodes,  // 4 bytes: codes of an event buffer
    TailSums    // 6 bytes: sums of the acceleration and deceleration pulses of the table
  } response_tail_e;

  // Data that an executed instruction returns: the bytes after the code in its response.
  typedef struct packed {
    logic [3:0]      extra;  // number of bytes, 0 .. 9
    logic [2:0][7:0] data;   // first bytes, data[0] first
    response_tail_e  tail;   // source of the last bytes
  } result_data_t;

  // A response without its length byte, which is computed when the response is written.
  typedef struct packed {
    logic [7:0]      head;
    logic [7:0]      code;
    logic [3:0]      extra;  // bytes after the code, 0 .. 9
    logic [2:0][7:0] data;   // first bytes after the code, data[0] first
    response_tail_e  tail;   // source of the last bytes after the code
    logic            echo;   // 1: append the instruction as received
  } response_t;

  // Commands to the blocks that write responses and the data blocks of a table read. All fields except
  // hold_data are strobes.
  typedef struct packed {
    logic write;       // write the response
    logic hold_data;   // level: hold the data of the executed instruction
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
