// SPDX-License-Identifier: Apache-2.0
// ppmc312_instr_pkg: what the blocks that process instructions say to each other: verdict, answer, instructions
// that wait, set-up, moves.
// Rules:  sections 3.1..3.5, 10.1, 10.2; P312-OVR-01/10, P312-EVT-01/04, P312-CMD-FC-1..10.
// Note:   strobes last one clk.
`default_nettype none

package ppmc312_instr_pkg;

  // A design uses only some of these constants.
  // verilator lint_off UNUSEDPARAM

  import ppmc312_pkg::*;

  // ---- judgement and answer --------------------------------------------------------------------------------------

  typedef enum logic [2:0] {
    VerdictGo,
    VerdictData,     // a block of a free-curve transfer
    VerdictPar,      // F0 with an error number
    VerdictStatus,   // F1
    VerdictCommand,  // F5
    VerdictSize      // F6
  } verdict_e;

  // What the last bytes of an answer are, if they do not stand in it.
  typedef enum logic [1:0] {
    TailNone,
    TailPos,    // 4: a position
    TailCodes,  // 4: codes of an event buffer
    TailSums    // 6: pulses of both sides of the table
  } tail_e;

  // What an executed instruction tells: bytes behind the code of its answer.
  typedef struct packed {
    logic [3:0]      extra;  // so many, 0 .. 9
    logic [2:0][7:0] data;   // the first ones, data[0] first
    tail_e           tail;   // the last ones
  } told_t;

  // An answer: length and class come from where it goes.
  typedef struct packed {
    logic [7:0]      head;
    logic [7:0]      code;
    logic [3:0]      extra;  // bytes behind the code, 0 .. 9
    logic [2:0][7:0] data;   // the first of these, data[0] first
    tail_e           tail;   // the last of these
    logic            echo;   // then the instruction as received
  } answer_t;

  // To who writes answers and the blocks of a table read; strobes but for keep.
  typedef struct packed {
    logic answer;      // write the answer
    logic keep;        // no strobe: what it tells stands
    logic table_open;  // a table read begins: its data blocks are to follow
    logic table_next;  // write the next one
  } write_order_t;

  typedef struct packed {
    logic                  answered;    // strobe: the answer is written
    logic [BLOCK_BITS-1:0] echo_addr;   // byte of the instruction that its echo needs, two clk ahead
    logic                  table_more;  // data blocks are to come
    logic                  table_done;  // strobe: one is written
  } write_state_t;

  // ---- instructions that wait for a trigger ----------------------------------------------------------------------

  // Into the store: bytes first, then the entry.
  typedef struct packed {
    logic        we;        // strobe: data
    logic        to_event;  // into event buffer n, else into the command FIFO
    logic        n;
    logic [3:0]  addr;      // byte of the block, 0 = header
    logic [7:0]  data;
    logic        put;       // strobe: the entry is complete
    logic [7:0]  code;      // of the instruction
    logic [1:0]  trig;      // bits 1:0 of its flags: x0 position, 01 event 0, 11 event 1
    logic [31:0] pos;       // position that triggers it, pulses
  } put_t;

  // Out of the store; strobes.
  typedef struct packed {
    logic       take;        // the triggered entry is taken
    logic       from_event;  // of event buffer n, else of the command FIFO
    logic       n;
    logic       all;         // everything is removed
    logic       fifo;        // the command FIFO
    logic [1:0] events;      // event buffers
    logic [1:0] highest;     // the highest entry of an event buffer
  } remove_t;

  // What the store has.
  typedef struct packed {
    logic            due;          // the command FIFO has something to be executed
    logic [1:0]      due_trig;     // that this has triggered
    logic [1:0]      events;       // the event buffers
    logic [3:0]      fifo_count;   // entries, 0 .. 8
    logic [1:0]      fifo_events;  // the FIFO has one that waits for this event pin
    logic [1:0][2:0] event_count;  // entries, 0 .. 4
    logic [1:0][1:0] event_next;   // which one is next, 0 .. 3
  } stored_t;

  // ---- set-up: initial setting and free curve --------------------------------------------------------------------

  // Strobes.
  typedef struct packed {
    logic build;  // initial setting, judged
    logic open;   // code block of a free curve, judged
    logic data;   // data block of one, judged
    logic fail;   // a set-up has failed
  } setup_order_t;

  // How far a free curve is.
  typedef struct packed {
    logic        complete;  // the curve is
    logic [1:0]  which;     // what comes next: 0 rates, 1 acceleration, 2 deceleration
    logic [6:0]  left;      // stages of this list to come
    logic [23:0] acc_sum;   // pulses of the sides, when it is
    logic [23:0] dec_sum;
  } progress_t;

  typedef struct packed {
    logic                  transfer;  // a free-curve transfer is open
    logic                  done;      // strobe, after build or data
    logic                  bad;       // with done: it has failed
    logic [7:0]            error;     // with bad: number of F0
    progress_t             progress;  // with done
    logic [BLOCK_BITS-1:0] addr;      // byte of the block that it needs, two clk ahead
  } setup_state_t;

  // ---- moves and rate changes ------------------------------------------------------------------------------------

  typedef struct packed {
    logic       done;     // strobe
    logic       limited;  // with done: a limit is in the way
    logic       refused;  // with done: no longer at rest
    logic [7:0] kind;     // with done: status byte of the answer
  } move_state_t;

  // verilator lint_on UNUSEDPARAM

endpackage

`default_nettype wire
