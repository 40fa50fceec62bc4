// SPDX-License-Identifier: Apache-2.0
// ppmc312_instr_unit: processing of instructions: those of the host, stored ones that wait for a trigger, their
//         effects and their answers.
// Rules:  see its blocks. Timing: see ppmc312_exec.
`default_nettype none

module ppmc312_instr_unit
  import ppmc312_pkg::*;
  import ppmc312_link_pkg::*;
  import ppmc312_instr_pkg::*;
  import ppmc312_stage_pkg::*;
#(
    parameter int unsigned       ClkHz     = 16_000_000,
    parameter int unsigned       XtalHz    = 16_000_000,
    parameter bit                Datasheet = 1'b0,
    parameter logic        [7:0] Version   = 8'h12        // value that the version instruction returns
) (
    input  wire logic                         clk_i,       // clock
    input  wire logic                         rst_ni,      // reset, asynchronous
    input  wire logic                         serial_i,    // 1: the front end is the serial station
    input  wire logic                         boot_i,      // leaving a reset by an instruction: report it
    output logic                              reset_o,     // strobe: an instruction requests a reset
    // blocks from the host
    input  wire offer_t                       offer_i,     // block from the host
    output logic             [BLOCK_BITS-1:0] blk_addr_o,  // byte of the block, 0 = header
    input  wire logic        [           7:0] blk_data_i,  // byte at blk_addr_o, two cycles later
    output logic                              blk_done_o,  // strobe: the block is processed and answered
    // state of the device
    input  wire inputs_t                      inputs_i,    // input pins, synchronised
    input  wire axis_state_t                  state_i,     // state of the motor side
    // execution
    output block_t                            block_o,     // instruction in progress
    output logic                              do_o,        // strobe: execute block_o
    output logic                              multi_o,     // strobe: multiple occurrence, cause 1
    output motion_order_t                     order_o,     // starts and rate changes
    // table
    output logic                              built_o,     // strobe: a new table becomes active
    output table_t                            table_o,     // active table
    output target_t                           home_o,      // look-up result of table_o.rate_acc
    input  wire look_t                        look_i,      // read port of the motion
    output stage_t                            stage_o,     // stage at look_i, two cycles later
    // answers, class 2
    output answer_byte_t                      byte_o,      // byte for the store of class 2
    output logic                              hold_o,      // 1: an answer follows soon
    output commit_t                           commit_o,    // the answer in the store is complete
    output answered_t                         answered_o,  // result for the serial station
    input  wire class2_t                      class2_i     // answers that wait to be read
);

  stored_t stored;
  put_t put;
  remove_t remove;
  told_t told;
  answer_t answer;
  write_order_t write;
  write_state_t write_state;
  setup_order_t setup;
  setup_state_t setup_state;
  curve_t curve;
  entry_t entry;
  plan_t plan;
  plan_order_t plan_order;
  move_state_t move_state;
  look_t read;
  stage_t read_stage;
  logic drop, close, unit_busy, thin, move, plan_busy, paced, idle, commit, read_busy, unused_busy;
  logic [6:0] open_acc, open_dec, first;
  logic [7:0] entry_data, plan_kind;
  logic peek;
  logic [1:0] peek_at;
  logic [31:0] value;
  answer_byte_t answer_byte, read_byte;
  logic [BLOCK_BITS:0] answer_size, read_size;

  // ---- execution of one instruction at a time -----------------------------------------------------

  ppmc312_exec u_exec (
      .clk_i,
      .rst_ni,
      .serial_i,
      .boot_i,
      .reset_o,
      .offer_i,
      .blk_done_o,
      .byte_addr_o(blk_addr_o),
      .byte_i     ((block_o.source == SrcHost) ? blk_data_i : entry_data),
      .stored_i   (stored),
      .remove_o   (remove),
      .put_o      (put),
      .state_i,
      .table_i    (table_o),
      .told_i     (told),
      .open_i     (paced),
      .idle_o     (idle),
      .block_o,
      .do_o,
      .multi_o,
      .setup_o    (setup),
      .setup_i    (setup_state),
      .move_o     (move),
      .move_i     (move_state),
      .answer_o   (answer),
      .write_o    (write),
      .write_i    (write_state),
      .hold_o,
      .commit_o   (commit),
      .class2_i
  );

  ppmc312_proc_time #(
      .ClkHz    (ClkHz),
      .XtalHz   (XtalHz),
      .Datasheet(Datasheet)
  ) u_proc_time (
      .clk_i,
      .rst_ni,
      .idle_i (idle),
      .block_i(block_o),
      .kind_i (plan_kind),
      .open_o (paced)
  );

  // ---- stored instructions ------------------------------------------------------------------------

  ppmc312_instr_queue u_queue (
      .clk_i,
      .rst_ni,
      .edge_i       (inputs_i.fell),
      .counted_i    (state_i.counted),
      .pos_i        (state_i.pos),
      .halt_o       (order_o.pos_halt),
      .stored_o     (stored),
      .put_i        (put),
      .remove_i     (remove),
      .fetch_event_i(block_o.source == SrcEvent),
      .fetch_addr_i (blk_addr_o[3:0]),
      .peek_i       (peek),
      .peek_n_i     (block_o.par[0][0]),
      .peek_at_i    (peek_at),
      .fetch_data_o (entry_data)
  );

  // A pending alarm is reported before the end of a motion that a position has stopped.
  assign order_o.settled = !stored.due && !multi_o && (idle || block_o.source != SrcOverride);

  // ---- effects of instructions --------------------------------------------------------------------

  ppmc312_setup u_setup (
      .clk_i,
      .rst_ni,
      .block_i    (block_o),
      .order_i    (setup),
      .state_o    (setup_state),
      .built_o,
      .byte_i     (blk_data_i),
      .drop_o     (drop),
      .curve_o    (curve),
      .open_acc_o (open_acc),
      .open_dec_o (open_dec),
      .entry_o    (entry),
      .close_o    (close),
      .unit_busy_i(unit_busy),
      .thin_i     (thin)
  );

  ppmc312_move u_move (
      .clk_i,
      .rst_ni,
      .begin_i     (move),
      .block_i     (block_o),
      .status_i    (state_i.status),
      .table_i     (table_o),
      .levels_i    (inputs_i.levels),
      .limit_rate_i(state_i.settings.limit_rate),
      .gate_i      (inputs_i.run || state_i.settings.ungated),
      .open_i      (paced),
      .state_o     (move_state),
      .start_o     (order_o.start),
      .change_o    (order_o.change),
      .op_o        (order_o.op),
      .plan_o      (order_o.plan),
      .home_o      (order_o.home),
      .planner_o   (plan_order),
      .plan_busy_i (plan_busy),
      .plan_kind_i (plan_kind),
      .plan_i      (plan)
  );

  ppmc312_stage_unit u_stages (
      .clk_i,
      .rst_ni,
      .drop_i     (drop),
      .build_i    (setup.build),
      .curve_i    (curve),
      .busy_o     (unit_busy),
      .thin_o     (thin),
      .open_i     (setup.open),
      .open_acc_i (open_acc),
      .open_dec_i (open_dec),
      .entry_i    (entry),
      .close_i    (close),
      .table_o,
      .home_o,
      .read_i     (read),
      .read_o     (read_stage),
      .plan_i     (plan_order),
      .plan_busy_o(plan_busy),
      .plan_kind_o(plan_kind),
      .plan_o     (plan),
      .look_i,
      .stage_o
  );

  assign first = ppmc_pkg::less(
      32'(table_o.first_acc), 32'(table_o.first_dec)
  ) ? table_o.first_acc : table_o.first_dec;

  // ---- answers ------------------------------------------------------------------------------------

  ppmc312_result_data #(
      .Version(Version)
  ) u_result (
      .clk_i,
      .block_i (block_o),
      .inputs_i,
      .state_i,
      .table_i (table_o),
      .first_i (first),
      .stored_i(stored),
      .keep_i  (write.keep),
      .told_o  (told),
      .value_o (value)
  );

  ppmc312_response_writer u_writer (
      .clk_i,
      .rst_ni,
      .start_i    (write.answer),
      .answer_i   (answer),
      .blk_size_i (block_o.size),
      .value_i    (value),
      .sums_i     ({table_o.acc, table_o.dec}),
      .codes_i    (stored.event_count[block_o.par[0][0]]),
      .peek_o     (peek),
      .peek_at_o  (peek_at),
      .code_i     (entry_data),
      .busy_o     (unused_busy),
      .done_o     (write_state.answered),
      .echo_addr_o(write_state.echo_addr),
      .echo_data_i(blk_data_i),
      .byte_o     (answer_byte),
      .size_o     (answer_size)
  );

  ppmc312_table_read u_table_read (
      .clk_i,
      .rst_ni,
      .open_i (write.table_open),
      .more_o (write_state.table_more),
      .next_i (write.table_next),
      .busy_o (read_busy),
      .done_o (write_state.table_done),
      .table_i(table_o),
      .first_i(first),
      .look_o (read),
      .stage_i(read_stage),
      .byte_o (read_byte),
      .size_o (read_size)
  );

  // The last byte is written in the cycle of the commit.
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) byte_o <= '0;
    else begin
      byte_o    <= read_busy ? read_byte : answer_byte;
      byte_o.we <= answer_byte.we || read_byte.we;
    end
  end

  always_comb begin
    commit_o = '{
        valid: commit,
        host: block_o.source == SrcHost,
        what: (block_o.source == SrcEvent) ? DoneEvent : DoneOverride,
        size: read_busy ? read_size : answer_size
    };
    if (answer.code == A_EVENT) commit_o.what = FailEvent;
    if (answer.code == A_OVERRIDE) commit_o.what = FailOverride;
  end

  assign answered_o = '{valid: commit && commit_o.host, code: answer.code, first: answer.data[0][2:0]};

endmodule

`default_nettype wire
