// SPDX-License-Identifier: Apache-2.0
// ppmc312_serial_pkg: types of the serial station for instruction codes, polled reports and replies.
// Rules:  P312-SER-20, P312-SER-30 (END codes), P312-SER-40..44.
`default_nettype none

package ppmc312_serial_pkg;

  // A design uses only some of the items of this package.
  // verilator lint_off UNUSEDPARAM

  // ---- instruction code of the serial mode ---------------------------------------------------------

  typedef struct packed {
    logic       is_known;
    logic       local_read;   // codes 40h, 4Eh, 4Fh: the station itself sends the reply
    logic       has_inner;    // event registration: the block contains an embedded block
    logic [7:0] code;         // code of the same instruction on the parallel bus
    logic [3:0] size;         // bytes of the parallel block, from header to last parameter
    logic       has_flags;    // 1: the first parameter is generated, 0: it is received
    logic [7:0] flags;        // first parameter; valid with has_flags
    logic [2:0] reply_bytes;  // data bytes of the reply; 0: acknowledgement only
  } serial_code_t;

  localparam logic [7:0] S_END = 8'h40;
  localparam logic [7:0] S_ERROR = 8'h4e;
  localparam logic [7:0] S_COUNTS = 8'h4f;

  // ---- result of a poll ---------------------------------------------------------------------------

  typedef struct packed {
    logic [3:0]                        report_class;    // class of the first pending report; 0: no report
    ppmc312_link_pkg::trigger_result_e trigger_result;  // class 2: result of an instruction
    ppmc312_pkg::end_cause_t           cause;           // class 5: cause of the end; determines the END code
    logic                              discarded;       // class 6: a change was discarded
    logic [7:0]                        data;            // class 6: changed bits of the input
    logic                              outside;         // classes 7, 8; 1: outside the range, 0: inside
  } poll_result_t;

  function automatic logic [7:0] end_code(ppmc312_pkg::end_cause_t c);
    return {
      2'b00,
      {2{c != '0}},
      c.nos || c.low,
      c.dec || c.stp || c.del,
      c.org || c.dec || c.stp || c.stl,
      c.als || c.low || c.stp || c.stl
    };
  endfunction

  // ---- byte for the write window ------------------------------------------------------------------

  typedef struct packed {
    logic       we;
    logic [3:0] addr;  // position in the block, 0 = header
    logic [7:0] data;
  } block_write_t;

  // ---- reply --------------------------------------------------------------------------------------

  // The values are bits 5:4 of the control code of the reply.
  typedef enum logic [1:0] {
    ReplyBusy     = 2'b00,
    ReplyReady    = 2'b01,
    ReplyData     = 2'b10,
    ReplySpecific = 2'b11
  } reply_kind_e;

  typedef struct packed {
    reply_kind_e     kind;
    logic [2:0]      count;          // number of data bytes
    logic            from_response;  // 1: the response queue contains the data bytes
    logic [2:0][7:0] data;           // from_response = 0: data bytes, data[0] first
  } reply_t;

  // verilator lint_on UNUSEDPARAM

endpackage

`default_nettype wire
