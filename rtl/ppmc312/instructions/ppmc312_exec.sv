// SPDX-License-Identifier: Apache-2.0
// ppmc312_exec: one instruction at a time, from the host or triggered: taken, judged, done, answered.
// Rules:  P312-BLK-01/02, P312-OVR-01/03/04, P312-EVT-02/03, P312-RSP-20, P312-PAR-06, sections 3.1..3.5, 10.1.
// Timing: 24 clk from blk_valid_i to do_o, the answer 5 + bytes clk later; set-ups, starts and changes wait in
//         between. blk_done_o comes when the answer stands in its store.
// Note:   do_o tells the rest of the part to carry out block_o.
`include "ppmc_assert.svh"
`default_nettype none

module ppmc312_exec
  import ppmc312_pkg::*;
  import ppmc312_stage_pkg::*;
(
    input  wire logic                          clk_i,
    input  wire logic                          rst_ni,
    input  wire logic                          serial_i,       // answers never wait to be read
    input  wire logic                          boot_i,         // after a reset by instruction: tell so
    output logic                               reset_o,        // reset everything
    // blocks of the host
    input  wire logic                          blk_valid_i,
    input  wire logic    [  BLOCK_BITS:0]      blk_size_i,
    output logic         [BLOCK_BITS-1:0]      fetch_addr_o,   // also for the entries that wait
    input  wire logic    [           7:0]      blk_data_i,
    output logic                               blk_done_o,
    // instructions that wait
    input  wire stored_t                       stored_i,
    output remove_t                            remove_o,
    output put_t                               put_o,
    output logic                               fetch_event_o,
    input  wire logic    [           7:0]      entry_data_i,
    output logic                               settled_o,      // all that the FIFO has triggered is processed
    // state of the part
    input  wire status_e                       status_i,
    input  wire logic                          end_wait_i,
    input  wire table_t                        table_i,
    input  wire logic    [           3:0]      reply_extra_i,
    input  wire logic    [           8:0][7:0] reply_data_i,
    input  wire logic                          open_i,         // the time for it has come
    output logic                               idle_o,
    output logic                               hold_o,         // an answer is about to come
    // to be carried out
    output block_t                             block_o,
    output logic                               do_o,
    output logic                               multi_o,        // multiple occurrence, cause 1
    // set-up
    output logic                               build_o,
    output logic                               open_o,
    output logic                               data_o,
    output logic                               fail_o,
    input  wire logic                          transfer_i,
    input  wire logic                          setup_done_i,
    input  wire logic                          setup_bad_i,
    input  wire logic    [           7:0]      setup_error_i,
    input  wire logic                          complete_i,
    input  wire logic    [           1:0]      list_i,
    input  wire logic    [           6:0]      left_i,
    input  wire logic    [          23:0]      acc_sum_i,
    input  wire logic    [          23:0]      dec_sum_i,
    input  wire logic    [BLOCK_BITS-1:0]      setup_addr_i,
    // motion
    output logic                               move_o,
    input  wire logic                          move_done_i,
    input  wire logic                          limited_i,
    input  wire logic                          refused_i,
    input  wire logic    [           7:0]      kind_i,
    // answers
    output answer_t                            answer_o,
    output logic                               write_o,
    output logic         [           4:0]      echo_bytes_o,
    input  wire logic                          written_i,
    input  wire logic    [BLOCK_BITS-1:0]      echo_addr_i,
    output logic                               read_open_o,    // table read: data blocks are to follow
    output logic                               read_block_o,   // the next one
    input  wire logic                          read_more_i,
    input  wire logic                          read_done_i,
    output logic                               commit_o,
    output logic                               commit_host_o,
    input  wire logic                          full_i,
    input  wire logic                          full_host_i,
    input  wire logic                          waits_i
);

  typedef enum logic [3:0] {
    StBoot,
    StIdle,
    StFetch,
    StFirst,    // reset, unread answers; the comparisons settle
    StSettle,
    StAct,
    StWait,     // as the old chip does before 26 and 80; the verdict stands
    StSetup,
    StPace,     // the old chip is still at it
    StCopy,
    StMove,
    StWrite,
    StReadback
  } state_e;

  state_e state_q;
  info_t info;
  verdict_e verdict;
  source_e source;
  answer_t next;
  logic move_ends, setup_ends, copy_ends;
  logic [BLOCK_BITS:0] bytes;
  logic [7:0] error, code, flags;
  logic ov, host, start, fetch_done, n, n_q, lost, copy, act, go, registers, unread, idle_read;
  logic host_wait_q, fails, slow;
  logic settle_q, reset_q, plain_q, build_q, used, full, inner, empty, evt_n, unused_busy, write_q, ready;
  logic [2:0] evt_count;
  logic [BLOCK_BITS-1:0] step_addr;

  assign code  = block_o.code;
  assign flags = block_o.par[0];
  assign info  = info_of(code);
  assign host  = block_o.source == SrcHost;

  // ---- which one -------------------------------------------------------------------------------------------------

  assign ready = blk_valid_i && !host_wait_q;

  ppmc312_arbiter u_arbiter (
      .clk_i,
      .rst_ni,
      .idle_i    (state_q == StIdle),
      .occupied_i(full_i || waits_i || host_wait_q),
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
      .size_i    (blk_size_i),
      .copy_i    (copy),
      .inner_i   (inner),
      .busy_o    (unused_busy),
      .done_o    (fetch_done),
      .block_o,
      .addr_o    (step_addr),
      .data_i    (host ? blk_data_i : entry_data_i),
      .put_we_o  (put_o.we),
      .put_addr_o(put_o.addr),
      .put_data_o(put_o.data)
  );

  ppmc312_judge u_judge (
      .clk_i,
      .rst_ni,
      .block_i  (block_o),
      .keep_i   (state_q inside {StAct, StWait}),
      .status_i,
      .end_wait_i,
      .transfer_i,
      .table_i,
      .verdict_o(verdict),
      .error_o  (error),
      .ov_o     (ov)
  );

  always_comb begin
    unique case (state_q)
      StSetup: fetch_addr_o = setup_addr_i;
      StWrite: fetch_addr_o = echo_addr_i;
      default: fetch_addr_o = step_addr;
    endcase
  end

  assign fetch_event_o = block_o.source == SrcEvent;
  assign hold_o = act || state_q inside {StWrite, StReadback} || read_more_i;
  assign idle_o = state_q == StIdle;
  assign settled_o = !stored_i.due && !(state_q != StIdle && block_o.source == SrcOverride);

  // A reset always executes. An instruction on top of an unread answer never does.
  assign reset_o = state_q == StFirst && reset_q;
  assign unread = state_q == StFirst && host && full_host_i && !reset_o;
  assign multi_o = lost || unread;

  // ---- what it asks for ------------------------------------------------------------------------------------------

  assign act = state_q == StAct && !slow;
  assign slow = !open_i && verdict == VerdictGo && !ov && code inside {I_AUX_OUT, I_HALT};
  assign go = act && verdict == VerdictGo && !ov;
  assign inner = code == I_EVT_SET;
  assign evt_n = inner ? flags[0] : flags[1];
  assign evt_count = stored_i.event_count[evt_n];
  assign empty = evt_count == '0;
  assign used = inner ? stored_i.fifo_events[evt_n] : flags[0] && !empty;  // by the other kind of trigger
  assign full = inner ? evt_count == 3'd4 : stored_i.fifo_count == 4'd8;
  assign registers = act && verdict == VerdictGo && (inner ? !flags[1] : ov) && !used && !full;
  assign copy = registers;

  assign build_o = go && code == I_INIT;
  assign open_o = go && code == I_FREE;
  assign data_o = act && verdict == VerdictData;
  assign move_o = go && (info.starts || code inside {I_RAMP, I_SPEED});
  assign read_open_o = go && code == I_TABLE;
  assign do_o = go && plain_q;
  // A set-up that fails leaves no table; so does anything that disturbs a transfer.
  assign fail_o = (transfer_i && status_i == StatusAbn) || (act && transfer_i && verdict != VerdictData) ||
      (act && verdict == VerdictPar && error != '0 && code == I_FREE && block_o.source != SrcEvent) ||
      (act && verdict == VerdictPar && code == I_INIT);

  always_comb begin
    put_o.to_event = inner;
    put_o.n        = evt_n;
    put_o.put      = state_q == StCopy && fetch_done;
    put_o.code     = inner ? block_o.par[3] : code;
    put_o.trig     = flags[1:0];
    put_o.pos      = {block_o.par[3], block_o.par[4], block_o.par[5], block_o.par[6]};
    if (code inside {I_HALT, I_DECEL})
      put_o.pos = {block_o.par[1], block_o.par[2], block_o.par[3], block_o.par[4]};
  end

  always_comb begin
    remove_o            = '0;
    remove_o.take       = start && source != SrcHost;
    remove_o.from_event = source == SrcEvent;
    remove_o.n          = n;
    remove_o.all        = fail_o || build_o || open_o || (state_q == StSetup && setup_done_i && setup_bad_i);
    // What cannot be executed takes all that wait with it.
    if (lost && source == SrcOverride) remove_o.fifo = 1'b1;
    if (lost && source == SrcEvent) remove_o.events[n] = 1'b1;
    if (fails && block_o.source == SrcOverride) remove_o.fifo = 1'b1;
    if (fails && block_o.source == SrcEvent) remove_o.events[n_q] = 1'b1;
    if (go && inner && flags[1] && !empty) remove_o.highest[evt_n] = 1'b1;
  end

  // ---- the answer ------------------------------------------------------------------------------------------------

  assign move_ends = state_q == StMove && move_done_i;
  assign setup_ends = state_q == StSetup && setup_done_i;
  assign copy_ends = state_q == StCopy && fetch_done;
  assign fails = !host && ((act && verdict != VerdictGo) || (move_ends && (limited_i || refused_i)) ||
      (setup_ends && setup_bad_i));

  ppmc312_compose u_compose (
      .block_i    (block_o),
      .verdict_i  (verdict),
      .error_i    (error),
      .status_i,
      .at_boot_i  (state_q == StBoot),
      .at_act_i   (act),
      .at_setup_i (state_q == StSetup),
      .at_copy_i  (state_q == StCopy),
      .at_move_i  (state_q == StMove),
      .fails_i    (fails),
      .registers_i(ov),
      .used_i     (used),
      .evt_count_i(evt_count),
      .reply_extra_i,
      .reply_data_i,
      .setup_bad_i,
      .setup_error_i,
      .complete_i,
      .list_i,
      .left_i,
      .acc_sum_i,
      .dec_sum_i,
      .limited_i,
      .refused_i,
      .kind_i,
      .answer_o   (next)
  );

  always_ff @(posedge clk_i) begin
    if (!(state_q inside {StWrite, StPace})) answer_o <= next;
    // Header, length and code stand long before.
    reset_q <= code == I_RESET && block_o.len == 8'd1 &&
        (!host || (block_o.size == 6'd3 && block_o.head == 8'h03));
    plain_q <= !(info.starts || code inside {I_INIT, I_FREE, I_TABLE, I_EVT_SET, I_RAMP, I_SPEED});
  end

  assign write_o = write_q;
  assign bytes = (block_o.size < 6'd3) ? 6'd0 : block_o.size - 6'd2;
  assign echo_bytes_o = (bytes > 6'd28) ? 5'd28 : bytes[4:0];
  assign commit_o = (state_q == StWrite && written_i) || (state_q == StReadback && read_done_i);
  assign commit_host_o = host;
  assign blk_done_o = (host_wait_q && !waits_i && !read_more_i && state_q == StIdle) || unread;

  assign read_block_o = idle_read;
  assign idle_read = state_q == StIdle && read_more_i && !full_i && !waits_i && !start && !lost;

  // ---- states ----------------------------------------------------------------------------------------------------

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      state_q     <= StBoot;
      n_q         <= 1'b0;
      write_q     <= 1'b0;
      settle_q    <= 1'b0;
      build_q     <= 1'b0;
      host_wait_q <= 1'b0;
    end else begin
      write_q <= 1'b0;
      if (blk_done_o) host_wait_q <= 1'b0;
      if (start) n_q <= n;
      unique case (state_q)
        StBoot:   state_q <= boot_i ? StWrite : StIdle;
        StIdle: begin
          if (start) state_q <= StFetch;
          else if (idle_read) state_q <= StReadback;
        end
        StFetch:  if (fetch_done) state_q <= StFirst;
        StFirst:  state_q <= unread ? StIdle : StSettle;
        StSettle: if (settle_q) state_q <= StAct;
        StAct: begin
          state_q <= StWrite;
          if (slow) state_q <= StWait;
          else if (build_o || data_o) state_q <= StSetup;
          else if (registers) state_q <= StCopy;
          else if (move_o) state_q <= StMove;
        end
        StWait:   if (!slow) state_q <= StAct;
        StSetup:  if (setup_ends) state_q <= (build_q && !setup_bad_i && !open_i) ? StPace : StWrite;
        StPace:   if (open_i) state_q <= StWrite;
        StCopy:   if (fetch_done) state_q <= StWrite;
        StMove:   if (move_done_i) state_q <= StWrite;
        default:  if (commit_o) state_q <= StIdle;
      endcase
      settle_q <= state_q == StSettle;
      if (build_o || data_o) build_q <= build_o;
      if ((state_q == StPace && open_i) ||
          (state_q == StBoot && boot_i) || (act && !(build_o || data_o || registers || move_o)) ||
          (setup_ends && !(build_q && !setup_bad_i && !open_i)) || copy_ends || move_ends) begin
        write_q <= 1'b1;
      end
      if (commit_o && host && blk_valid_i && !serial_i) host_wait_q <= 1'b1;
    end
  end

  logic unused_bits;
  assign unused_bits = &{1'b0, info, flags};

`ifndef SYNTHESIS
  `PPMC_ASSERT(p312_rsp_20, !(start && source != SrcHost && full_i))
  `PPMC_ASSERT(p312_blk_02, !(do_o && verdict != VerdictGo))
`endif

endmodule

`default_nettype wire
