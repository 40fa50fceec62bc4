// SPDX-License-Identifier: Apache-2.0
// ppmc312_exec: processes one instruction at a time, from the host or triggered: fetch, check, execution,
//         answer.
// Rules:  P312-BLK-01/02, P312-OVR-01/03/04, P312-EVT-02/03, P312-RSP-20, P312-PAR-06, sections 3.1..3.5,
//         10.1.
// Timing: do_o follows offer_i.valid by 24 cycles; the answer is complete 5 + bytes cycles later. Set-ups,
//         starts and rate changes add a wait in between. blk_done_o is asserted when the answer is stored.
// Note:   do_o is the command to the other blocks to execute block_o.
`include "ppmc_assert.svh"
`default_nettype none

module ppmc312_exec
  import ppmc312_pkg::*;
  import ppmc312_link_pkg::*;
  import ppmc312_instr_pkg::*;
  import ppmc312_stage_pkg::*;
(
    input  wire logic                          clk_i,        // clock
    input  wire logic                          rst_ni,       // reset, asynchronous
    input  wire logic                          serial_i,     // 1: answers never wait to be read
    input  wire logic                          boot_i,       // leaving a reset by an instruction: report it
    output logic                               reset_o,      // strobe: reset the device
    // sources of instructions
    input  wire offer_t                        offer_i,      // block from the host
    output logic                               blk_done_o,   // strobe: the block is processed and answered
    output logic              [BLOCK_BITS-1:0] byte_addr_o,  // byte of the block or entry, 0 = header
    input  wire logic         [           7:0] byte_i,       // byte at byte_addr_o, two cycles later
    input  wire stored_t                       stored_i,     // stored instructions
    output remove_t                            remove_o,     // removal from the store
    output put_t                               put_o,        // write port of the store
    // state of the device
    input  wire axis_state_t                   state_i,      // state of the motor side
    input  wire table_t                        table_i,      // active table
    input  wire told_t                         told_i,       // data that block_o returns
    input  wire logic                          open_i,       // the processing time of block_o has passed
    output logic                               idle_o,       // 1: no instruction is being processed
    // execution
    output block_t                             block_o,      // instruction in progress
    output logic                               do_o,         // strobe: execute block_o
    output logic                               multi_o,      // strobe, one cycle late: multiple occurrence
    output setup_order_t                       setup_o,      // initial setting, free curve
    input  wire setup_state_t                  setup_i,      // state of the set-up
    output logic                               move_o,       // strobe: a start or a rate change
    input  wire move_state_t                   move_i,       // result of move_o
    // answers
    output answer_t                            answer_o,     // stable while it is written, until commit_o
    output write_order_t                       write_o,      // write commands
    input  wire write_state_t                  write_i,      // state of the writing
    output logic                               hold_o,       // 1: an answer follows soon
    output logic                               commit_o,     // strobe: the answer is complete
    input  wire class2_t                       class2_i      // answers that wait to be read
);

  typedef enum logic [3:0] {
    StBoot,
    StIdle,
    StFetch,
    StFirst,    // checks for reset and unread answers; comparisons settle
    StSettle,
    StAct,
    StWait,     // processing time of 26 and 80; the verdict is held
    StSetup,
    StPace,     // remaining processing time
    StCopy,
    StMove,
    StWrite,
    StReadback
  } state_e;

  state_e state_q, state_d;
  info_t info;
  verdict_e verdict;
  source_e source;
  answer_t next;
  logic move_ends, setup_ends;
  logic [7:0] error, code, flags;
  logic ov, host, start, fetch_done, n, n_q, lost, copy, act, go, registers, unread, idle_read;
  logic host_wait_q, fails, slow;
  logic settle_q, reset_q, plain_q, build_q, used, full, inner, empty, evt_n, unused_busy, write_q, ready;
  logic [2:0] evt_count;
  logic [BLOCK_BITS-1:0] step_addr;

  assign code  = block_o.code;
  assign flags = block_o.par[0];
  assign host  = block_o.source == SrcHost;

  // ---- selection ----------------------------------------------------------------------------------

  assign ready = offer_i.valid && !host_wait_q;

  ppmc312_arbiter u_arbiter (
      .clk_i,
      .rst_ni,
      .idle_i    (state_q == StIdle),
      .occupied_i(class2_i.full || class2_i.waits || host_wait_q),
      .host_i    (ready),
      .stored_i,
      .start_o   (start),
      .source_o  (source),
      .n_o       (n),
      .lost_o    (lost)
  );

  ppmc312_fetch u_fetch (
      .clk_i,
      .rst_ni,
      .start_i   (start),
      .source_i  (source),
      .size_i    (offer_i.size),
      .copy_i    (copy),
      .inner_i   (inner),
      .busy_o    (unused_busy),
      .done_o    (fetch_done),
      .block_o,
      .addr_o    (step_addr),
      .data_i    (byte_i),
      .put_we_o  (put_o.we),
      .put_addr_o(put_o.addr),
      .put_data_o(put_o.data)
  );

  ppmc312_instr_rom u_instr_rom (
      .clk_i,
      .code_i(code),
      .info_o(info)
  );

  ppmc312_instr_check u_check (
      .clk_i,
      .rst_ni,
      .block_i   (block_o),
      .info_i    (info),
      .keep_i    (state_q inside {StAct, StWait}),
      .status_i  (state_i.status),
      .end_wait_i(state_i.end_wait),
      .transfer_i(setup_i.transfer),
      .table_i,
      .verdict_o (verdict),
      .error_o   (error),
      .ov_o      (ov)
  );

  always_comb begin
    unique case (state_q)
      StSetup: byte_addr_o = setup_i.addr;
      StWrite: byte_addr_o = write_i.echo_addr;
      default: byte_addr_o = step_addr;
    endcase
  end

  assign hold_o = act || state_q inside {StWrite, StReadback} || write_i.table_more;
  assign idle_o = state_q == StIdle;

  // A reset is always executed. No other instruction of the host is executed while the last answer is unread.
  assign reset_o = state_q == StFirst && reset_q;
  assign unread = state_q == StFirst && host && class2_i.full_host && !reset_o;

  // ---- requested actions --------------------------------------------------------------------------

  assign act = state_q == StAct && !slow;
  assign slow = !open_i && verdict == VerdictGo && !ov && code inside {I_AUX_OUT, I_HALT};
  assign go = act && verdict == VerdictGo && !ov;
  assign inner = code == I_EVT_SET;
  assign evt_n = inner ? flags[0] : flags[1];
  assign evt_count = stored_i.event_count[evt_n];
  assign empty = evt_count == '0;
  // The event pin is in use by the other kind of trigger (command FIFO or event buffer).
  assign used = inner ? stored_i.fifo_events[evt_n] : flags[0] && !empty;
  assign full = inner ? evt_count == 3'd4 : stored_i.fifo_count == 4'd8;
  assign registers = act && verdict == VerdictGo && (inner ? !flags[1] : ov) && !used && !full;
  assign copy = registers;

  assign move_o = go && (info.starts || code inside {I_RAMP, I_SPEED});
  assign do_o = go && plain_q;

  assign setup_o.build = go && code == I_INIT;
  assign setup_o.open = go && code == I_FREE;
  assign setup_o.data = act && verdict == VerdictData;
  // After a failed set-up, and after anything that disturbs a transfer, there is no valid table.
  assign setup_o.fail = (setup_i.transfer && state_i.status == StatusAbn) ||
      (act && setup_i.transfer && verdict != VerdictData) ||
      (act && verdict == VerdictPar && error != '0 && code == I_FREE && block_o.source != SrcEvent) ||
      (act && verdict == VerdictPar && code == I_INIT);

  always_comb begin
    put_o.to_event = inner;
    put_o.n        = evt_n;
    put_o.put      = state_q == StCopy && fetch_done;
    put_o.code     = inner ? block_o.par[3] : code;
    put_o.trig     = flags[1:0];
    put_o.pos      = {block_o.par[3], block_o.par[4], block_o.par[5], block_o.par[6]};
  end

  always_comb begin
    remove_o            = '0;
    remove_o.take       = start && source != SrcHost;
    remove_o.from_event = source == SrcEvent;
    remove_o.n          = n;
    remove_o.all        = setup_o.fail || setup_o.build || setup_o.open || (setup_ends && setup_i.bad);
    // If an entry cannot be executed, all entries that wait in the same FIFO or buffer are removed.
    if (lost && source == SrcOverride) remove_o.fifo = 1'b1;
    if (lost && source == SrcEvent) remove_o.events[n] = 1'b1;
    if (fails && block_o.source == SrcOverride) remove_o.fifo = 1'b1;
    if (fails && block_o.source == SrcEvent) remove_o.events[n_q] = 1'b1;
    if (go && inner && flags[1] && !empty) remove_o.highest[evt_n] = 1'b1;
  end

  // ---- answer -------------------------------------------------------------------------------------

  assign move_ends = state_q == StMove && move_i.done;
  assign setup_ends = state_q == StSetup && setup_i.done;
  assign fails = !host && ((act && verdict != VerdictGo) ||
      (move_ends && (move_i.limited || move_i.refused)) || (setup_ends && setup_i.bad));

  ppmc312_response_format u_format (
      .block_i    (block_o),
      .verdict_i  (verdict),
      .error_i    (error),
      .status_i   (state_i.status),
      .at_boot_i  (state_q == StBoot),
      .at_act_i   (act),
      .at_setup_i (state_q == StSetup),
      .at_copy_i  (state_q == StCopy),
      .at_move_i  (state_q == StMove),
      .fails_i    (fails),
      .registers_i(ov),
      .used_i     (used),
      .evt_count_i(evt_count),
      .told_i,
      .setup_i,
      .move_i,
      .answer_o   (next)
  );

  always_ff @(posedge clk_i) begin
    if (!(state_q inside {StWrite, StPace})) answer_o <= next;
    // Header, length and code are stable long before their use.
    reset_q <= code == I_RESET && block_o.len == 8'd1 &&
        (!host || (block_o.size == 6'd3 && block_o.head == 8'h03));
    plain_q <= !(info.starts || code inside {I_INIT, I_FREE, I_TABLE, I_EVT_SET, I_RAMP, I_SPEED});
  end

  assign write_o = '{
          answer: write_q,
          keep: state_q inside {StAct, StWrite},
          table_open: go && code == I_TABLE,
          table_next: idle_read
      };
  assign commit_o = (state_q == StWrite && write_i.answered) || (state_q == StReadback && write_i.table_done);
  assign blk_done_o = (host_wait_q && !class2_i.waits && !write_i.table_more && state_q == StIdle) || unread;
  assign idle_read = state_q == StIdle && write_i.table_more && !class2_i.full && !class2_i.waits && !start &&
      !lost;

  // ---- states -------------------------------------------------------------------------------------

  always_comb begin
    state_d = state_q;
    unique case (state_q)
      StBoot:   state_d = boot_i ? StWrite : StIdle;
      StIdle: begin
        if (start) state_d = StFetch;
        else if (idle_read) state_d = StReadback;
      end
      StFetch:  if (fetch_done) state_d = StFirst;
      StFirst:  state_d = unread ? StIdle : StSettle;
      StSettle: if (settle_q) state_d = StAct;
      StAct: begin
        state_d = StWrite;
        if (slow) state_d = StWait;
        else if (setup_o.build || setup_o.data) state_d = StSetup;
        else if (registers) state_d = StCopy;
        else if (move_o) state_d = StMove;
      end
      StWait:   if (!slow) state_d = StAct;
      StSetup:  if (setup_ends) state_d = (build_q && !setup_i.bad && !open_i) ? StPace : StWrite;
      StPace:   if (open_i) state_d = StWrite;
      StCopy:   if (fetch_done) state_d = StWrite;
      StMove:   if (move_i.done) state_d = StWrite;
      default:  if (commit_o) state_d = StIdle;
    endcase
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      state_q     <= StBoot;
      n_q         <= 1'b0;
      write_q     <= 1'b0;
      settle_q    <= 1'b0;
      build_q     <= 1'b0;
      host_wait_q <= 1'b0;
      multi_o     <= 1'b0;
    end else begin
      state_q  <= state_d;
      multi_o  <= lost || unread;  // registered: the path to the pulses is timing-critical
      settle_q <= state_q == StSettle;
      write_q  <= state_d == StWrite && state_q != StWrite;  // strobe at the start of StWrite
      if (start) n_q <= n;
      if (setup_o.build || setup_o.data) build_q <= setup_o.build;
      if (blk_done_o) host_wait_q <= 1'b0;
      if (commit_o && host && offer_i.valid && !serial_i) host_wait_q <= 1'b1;
    end
  end

  logic unused_bits;
  assign unused_bits = &{1'b0, info, flags, state_i, stored_i};

`ifndef SYNTHESIS
  `PPMC_ASSERT(p312_rsp_20, !(start && source != SrcHost && class2_i.full))
  `PPMC_ASSERT(p312_blk_02, !(do_o && verdict != VerdictGo))
`endif

endmodule

`default_nettype wire
