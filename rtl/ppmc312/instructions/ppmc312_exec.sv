// SPDX-License-Identifier: Apache-2.0
// ppmc312_exec: processes one instruction at a time, from the host or triggered, in four steps: fetch,
//         check, execution, response.
// Rules:  P312-BLK-01/02, P312-OVR-01/03/04, P312-EVT-02/03, P312-RSP-20, P312-PAR-06;
//         docs/ppmc312/README.md, Instruction blocks.
// Timing: execute_o follows host_block_i.valid by 24 cycles. The response is complete 5 cycles plus
//         one cycle per byte after execute_o. Set-ups, starts and rate changes extend this time. blk_done_o
//         is asserted when the response is stored.
// Note:   execute_o commands the other blocks to execute block_o.
`include "ppmc_assert.svh"
`default_nettype none

module ppmc312_exec
  import ppmc312_pkg::*;
  import ppmc312_link_pkg::*;
  import ppmc312_instr_pkg::*;
  import ppmc312_stage_pkg::*;
(
    input wire logic clk_i,  // clock
    input wire logic rst_ni,  // reset, asynchronous
    input wire logic serial_i,  // 1: serial mode, in which no response waits to be read
    input wire logic boot_i,  // 1: a reset instruction caused the last reset; report this
    output logic reset_o,  // strobe: reset the device
    // sources of instructions
    input wire host_block_t host_block_i,  // block from the host
    output logic blk_done_o,  // strobe: the block is processed and its response is stored
    output logic [BLOCK_BITS-1:0] byte_addr_o,  // byte of the block or entry, 0 = header
    input wire logic [7:0] byte_i,  // byte at byte_addr_o, two cycles later
    input wire queue_status_t queue_status_i,  // contents of the instruction queue
    output dequeue_t dequeue_o,  // removal of entries from the queue
    output enqueue_t enqueue_o,  // write port of the queue
    // state of the device
    input wire axis_state_t state_i,  // state of the motor side
    input wire table_t table_i,  // active table
    input wire logic elapsed_i,  // the processing time of block_o has passed
    output logic idle_o,  // 1: no instruction is being processed
    // execution
    output block_t block_o,  // current instruction
    output logic execute_o,  // strobe: execute block_o
    output logic multi_o,  // strobe, registered: multiple-occurrence alarm
    output setup_cmd_t setup_cmd_o,  // commands to the set-up: initial setting, free curve
    input wire setup_status_t setup_status_i,  // status of the set-up
    output logic move_o,  // strobe: begin a start or a rate change
    input wire move_status_t move_status_i,  // result of move_o
    // responses
    output response_t response_o,  // response; stable until response_done_o
    output response_cmd_t response_cmd_o,  // commands to the response writers
    input wire response_status_t response_status_i,  // status of the response writer
    output logic hold_o,  // 1: a response follows soon
    output logic response_done_o,  // strobe: the response is complete
    input wire response_queue_t response_queue_i  // responses that the host has not read
);

  typedef enum logic [3:0] {
    StBoot,
    StIdle,
    StFetch,
    StFirst,    // checks for a reset and for unread responses
    StSettle,
    StAct,
    StWait,     // waits for the processing time of instructions 26 and 80; keeps the result of the check
    StSetup,
    StProcTime,     // waits for the remaining processing time
    StCopy,
    StMove,
    StWrite,
    StReadback
  } state_e;

  state_e state_q, state_d;
  instr_info_t info;
  check_e check;
  response_kind_e executed_kind;
  source_e source;
  response_t next;
  logic move_ends, setup_ends;
  logic [7:0] error, code, flags;
  logic ov, host, start, fetch_done, n, n_q, missed, copy, act, go, registers, unread, idle_read;
  logic host_wait_q, fails, slow;
  logic settle_q, reset_q, plain_q, build_q, used, full, inner, empty, evt_n, unused_busy, write_q, ready;
  logic [2:0] evt_count;
  logic [BLOCK_BITS-1:0] step_addr;

  assign code  = block_o.code;
  assign flags = block_o.par[0];
  assign host  = block_o.source == SrcHost;

  // ---- selection ----------------------------------------------------------------------------------

  assign ready = host_block_i.valid && !host_wait_q;

  ppmc312_arbiter u_arbiter (
      .clk_i,
      .rst_ni,
      .idle_i    (state_q == StIdle),
      .occupied_i(response_queue_i.full || response_queue_i.pending || host_wait_q),
      .host_i    (ready),
      .queue_status_i,
      .start_o   (start),
      .source_o  (source),
      .n_o       (n),
      .missed_o  (missed)
  );

  ppmc312_fetch u_fetch (
      .clk_i,
      .rst_ni,
      .start_i    (start),
      .source_i   (source),
      .size_i     (host_block_i.size),
      .copy_i     (copy),
      .inner_i    (inner),
      .busy_o     (unused_busy),
      .done_o     (fetch_done),
      .block_o,
      .addr_o     (step_addr),
      .data_i     (byte_i),
      .copy_we_o  (enqueue_o.we),
      .copy_addr_o(enqueue_o.addr),
      .copy_data_o(enqueue_o.data)
  );

  ppmc312_instr_rom u_instr_rom (
      .clk_i,
      .code_i(code),
      .info_o(info),
      .kind_o(executed_kind)
  );

  ppmc312_instr_check u_check (
      .clk_i,
      .rst_ni,
      .block_i   (block_o),
      .info_i    (info),
      .hold_i    (state_q inside {StAct, StWait}),
      .status_i  (state_i.status),
      .end_wait_i(state_i.end_wait),
      .transfer_i(setup_status_i.transfer),
      .table_i,
      .check_o   (check),
      .error_o   (error),
      .ov_o      (ov)
  );

  always_comb begin
    unique case (state_q)
      StSetup: byte_addr_o = setup_status_i.addr;
      StWrite: byte_addr_o = response_status_i.echo_addr;
      default: byte_addr_o = step_addr;
    endcase
  end

  assign hold_o = act || state_q inside {StWrite, StReadback} || response_status_i.table_more;
  assign idle_o = state_q == StIdle;

  // A reset is always executed. Any other instruction of the host is rejected while the last response is
  // unread.
  assign reset_o = state_q == StFirst && reset_q;
  assign unread = state_q == StFirst && host && response_queue_i.full_host && !reset_o;

  // ---- requested actions --------------------------------------------------------------------------

  assign act = state_q == StAct && !slow;
  assign slow = !elapsed_i && check == CheckOk && !ov && code inside {I_AUX_OUT, I_HALT};
  assign go = act && check == CheckOk && !ov;
  assign inner = code == I_EVT_SET;
  assign evt_n = inner ? flags[0] : flags[1];
  assign evt_count = queue_status_i.event_count[evt_n];
  assign empty = evt_count == '0;
  // used = 1: the other kind of trigger (command FIFO or event buffer) already uses the event pin.
  assign used = inner ? queue_status_i.fifo_uses_event[evt_n] : flags[0] && !empty;
  assign full = inner ? evt_count == 3'd4 : queue_status_i.fifo_count == 4'd8;
  assign registers = act && check == CheckOk && (inner ? !flags[1] : ov) && !used && !full;
  assign copy = registers;

  assign move_o = go && (info.starts_motion || code inside {I_RAMP, I_SPEED});
  assign execute_o = go && plain_q;

  assign setup_cmd_o.build = go && code == I_INIT;
  assign setup_cmd_o.open = go && code == I_FREE;
  assign setup_cmd_o.data = act && check == CheckData;
  // A failed set-up, and any event that disturbs a transfer, invalidate the table.
  assign setup_cmd_o.fail = (setup_status_i.transfer && state_i.status == StatusAbn) ||
      (act && setup_status_i.transfer && check != CheckData) ||
      (act && check == CheckParam && error != '0 && code == I_FREE && block_o.source != SrcEvent) ||
      (act && check == CheckParam && code == I_INIT);

  always_comb begin
    enqueue_o.to_event   = inner;
    enqueue_o.n          = evt_n;
    enqueue_o.entry_done = state_q == StCopy && fetch_done;
    enqueue_o.code       = inner ? block_o.par[3] : code;
    enqueue_o.trig       = flags[1:0];
    enqueue_o.pos        = {block_o.par[3], block_o.par[4], block_o.par[5], block_o.par[6]};
  end

  always_comb begin
    dequeue_o = '0;
    dequeue_o.take = start && source != SrcHost;
    dequeue_o.from_event = source == SrcEvent;
    dequeue_o.n = n;
    dequeue_o.all        = setup_cmd_o.fail || setup_cmd_o.build || setup_cmd_o.open ||
                           (setup_ends && setup_status_i.failed);
    // When an entry cannot be executed, all waiting entries of the same FIFO or buffer are removed.
    if (missed && source == SrcOverride) dequeue_o.fifo = 1'b1;
    if (missed && source == SrcEvent) dequeue_o.events[n] = 1'b1;
    if (fails && block_o.source == SrcOverride) dequeue_o.fifo = 1'b1;
    if (fails && block_o.source == SrcEvent) dequeue_o.events[n_q] = 1'b1;
    if (go && inner && flags[1] && !empty) dequeue_o.highest[evt_n] = 1'b1;
  end

  // ---- response -------------------------------------------------------------------------------------

  assign move_ends = state_q == StMove && move_status_i.done;
  assign setup_ends = state_q == StSetup && setup_status_i.done;
  assign fails = !host && ((act && check != CheckOk) ||
      (move_ends && (move_status_i.at_limit || move_status_i.rejected)) ||
      (setup_ends && setup_status_i.failed));

  ppmc312_response_format u_format (
      .block_i      (block_o),
      .check_i      (check),
      .error_i      (error),
      .status_i     (state_i.status),
      .at_boot_i    (state_q == StBoot),
      .at_act_i     (act),
      .at_setup_i   (state_q == StSetup),
      .at_copy_i    (state_q == StCopy),
      .at_move_i    (state_q == StMove),
      .fails_i      (fails),
      .registers_i  (ov),
      .used_i       (used),
      .evt_count_i  (evt_count),
      .result_kind_i(executed_kind),
      .setup_status_i,
      .move_status_i,
      .response_o   (next)
  );

  always_ff @(posedge clk_i) begin
    if (!(state_q inside {StWrite, StProcTime})) response_o <= next;
    // reset_q and plain_q are registered: header, length and code are stable long before these registers
    // are used.
    reset_q <= code == I_RESET && block_o.len == 8'd1 &&
        (!host || (block_o.size == 6'd3 && block_o.head == 8'h03));
    plain_q <= !(info.starts_motion || code inside {I_INIT, I_FREE, I_TABLE, I_EVT_SET, I_RAMP, I_SPEED});
  end

  assign response_cmd_o = '{
          write: write_q,
          hold_data: state_q inside {StAct, StWrite},
          table_open: go && code == I_TABLE,
          table_next: idle_read
      };
  assign response_done_o = (state_q == StWrite && response_status_i.written) ||
      (state_q == StReadback && response_status_i.table_done);
  assign blk_done_o = (host_wait_q && !response_queue_i.pending && !response_status_i.table_more &&
                       state_q == StIdle) || unread;
  assign idle_read = state_q == StIdle && response_status_i.table_more &&
      !response_queue_i.full && !response_queue_i.pending && !start && !missed;

  // ---- states -------------------------------------------------------------------------------------

  always_comb begin
    state_d = state_q;
    unique case (state_q)
      StBoot: state_d = boot_i ? StWrite : StIdle;
      StIdle: begin
        if (start) state_d = StFetch;
        else if (idle_read) state_d = StReadback;
      end
      StFetch: if (fetch_done) state_d = StFirst;
      StFirst: state_d = unread ? StIdle : StSettle;
      StSettle: if (settle_q) state_d = StAct;
      StAct: begin
        state_d = StWrite;
        if (slow) state_d = StWait;
        else if (setup_cmd_o.build || setup_cmd_o.data) state_d = StSetup;
        else if (registers) state_d = StCopy;
        else if (move_o) state_d = StMove;
      end
      StWait: if (!slow) state_d = StAct;
      StSetup:
      if (setup_ends) state_d = (build_q && !setup_status_i.failed && !elapsed_i) ? StProcTime : StWrite;
      StProcTime: if (elapsed_i) state_d = StWrite;
      StCopy: if (fetch_done) state_d = StWrite;
      StMove: if (move_status_i.done) state_d = StWrite;
      default: if (response_done_o) state_d = StIdle;
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
      multi_o  <= missed || unread;  // registered: the path to the pulses is timing-critical
      settle_q <= state_q == StSettle;
      write_q  <= state_d == StWrite && state_q != StWrite;  // strobe: first cycle of StWrite
      if (start) n_q <= n;
      if (setup_cmd_o.build || setup_cmd_o.data) build_q <= setup_cmd_o.build;
      if (blk_done_o) host_wait_q <= 1'b0;
      if (response_done_o && host && host_block_i.valid && !serial_i) host_wait_q <= 1'b1;
    end
  end

  logic unused_bits;
  assign unused_bits = &{1'b0, info, flags, state_i, queue_status_i};

`ifndef SYNTHESIS
  `PPMC_ASSERT(p312_rsp_20, !(start && source != SrcHost && response_queue_i.full))
  `PPMC_ASSERT(p312_blk_02, !(execute_o && check != CheckOk))
  `PPMC_ASSERT(p312_rsp_10_held, !execute_o || hold_o)  // reports that execute_o causes wait for its response
  `PPMC_ASSERT(p312_par_06_done, !blk_done_o || host_block_i.valid)
  `PPMC_ASSERT(p312_ser_19_done, !(response_done_o && host && serial_i) || host_block_i.valid)
`endif

endmodule

`default_nettype wire
