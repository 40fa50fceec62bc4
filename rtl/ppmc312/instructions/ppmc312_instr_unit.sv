// SPDX-License-Identifier: Apache-2.0
// ppmc312_instr_unit: processes instructions of the host, and stored instructions when they are triggered.
//         Checks them, executes them and sends the responses.
// Rules:  see the instantiated blocks.
// Timing: see ppmc312_exec.
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
    input wire logic clk_i,  // clock
    input wire logic rst_ni,  // reset, asynchronous
    input wire logic serial_i,  // 1: the front end is the serial station
    input wire logic boot_i,  // 1: a reset instruction caused the last reset; report this
    output logic reset_o,  // strobe: an instruction requests a reset
    // blocks from the host
    input wire host_block_t host_block_i,  // block from the host
    output logic [BLOCK_BITS-1:0] blk_addr_o,  // byte of the block, 0 = header
    input wire logic [7:0] blk_data_i,  // byte at blk_addr_o, two cycles later
    output logic blk_done_o,  // strobe: the block is processed and its response is stored
    // state of the device
    input wire inputs_t inputs_i,  // input pins, synchronised
    input wire axis_state_t state_i,  // state of the motor side
    // execution
    output block_t block_o,  // current instruction
    output logic execute_o,  // strobe: execute block_o
    output logic multi_o,  // strobe: multiple-occurrence alarm with code 1
    output motion_req_t motion_req_o,  // starts and rate changes
    // table
    output logic built_o,  // strobe: a new table becomes active
    output table_t table_o,  // active table
    output target_t start_target_o,  // look-up result for table_o.rate_acc
    input wire table_addr_t table_addr_i,  // read port of the motion
    output stage_t stage_o,  // stage at table_addr_i, two cycles later
    // responses, class 2
    output response_write_t response_write_o,  // byte for the queue of class 2
    output logic hold_o,  // 1: a response follows soon
    output response_done_t response_done_o,  // strobe: the response in the queue is complete
    output host_result_t host_result_o,  // result for the serial station
    input wire response_queue_t response_queue_i  // responses that the host has not read
);

  queue_status_t queue_status;
  enqueue_t enqueue;
  dequeue_t dequeue;
  response_t response;
  response_cmd_t response_cmd;
  response_status_t response_status;
  setup_cmd_t setup_cmd;
  setup_status_t setup_status;
  curve_t curve;
  table_write_t table_write;
  profile_t profile;
  profile_req_t profile_req;
  move_status_t move_status;
  table_addr_t read_addr;
  stage_t read_stage;
  logic drop, close, unit_busy, too_few_pulses, move, plan_busy, elapsed, idle, commit, read_busy;
  logic [6:0] open_acc, open_dec, first;
  logic [7:0] entry_data, plan_kind;
  logic peek;
  logic [1:0] peek_at;
  logic [7:0] response_code;
  logic [2:0] response_first;
  response_write_t writer_byte, table_byte;
  logic [BLOCK_BITS:0] writer_size, table_size;

  // ---- execution of one instruction at a time -----------------------------------------------------

  ppmc312_exec u_exec (
      .clk_i,
      .rst_ni,
      .serial_i,
      .boot_i,
      .reset_o,
      .host_block_i,
      .blk_done_o,
      .byte_addr_o      (blk_addr_o),
      .byte_i           ((block_o.source == SrcHost) ? blk_data_i : entry_data),
      .queue_status_i   (queue_status),
      .dequeue_o        (dequeue),
      .enqueue_o        (enqueue),
      .state_i,
      .table_i          (table_o),
      .elapsed_i        (elapsed),
      .idle_o           (idle),
      .block_o,
      .execute_o,
      .multi_o,
      .setup_cmd_o      (setup_cmd),
      .setup_status_i   (setup_status),
      .move_o           (move),
      .move_status_i    (move_status),
      .response_o       (response),
      .response_cmd_o   (response_cmd),
      .response_status_i(response_status),
      .hold_o,
      .response_done_o  (commit),
      .response_queue_i
  );

  ppmc312_proc_time #(
      .ClkHz    (ClkHz),
      .XtalHz   (XtalHz),
      .Datasheet(Datasheet)
  ) u_proc_time (
      .clk_i,
      .rst_ni,
      .idle_i(idle),
      .block_i(block_o),
      .kind_i(plan_kind),
      .elapsed_o(elapsed)
  );

  // ---- instruction queue --------------------------------------------------------------------------

  ppmc312_instr_queue u_queue (
      .clk_i,
      .rst_ni,
      .edge_i        (inputs_i.evt_fall),
      .counted_i     (state_i.counted),
      .pos_i         (state_i.pos),
      .halt_o        (motion_req_o.pos_halt),
      .queue_status_o(queue_status),
      .enqueue_i     (enqueue),
      .dequeue_i     (dequeue),
      .fetch_event_i (block_o.source == SrcEvent),
      .fetch_addr_i  (blk_addr_o[3:0]),
      .peek_i        (peek),
      .peek_n_i      (block_o.par[0][0]),
      .peek_at_i     (peek_at),
      .fetch_data_o  (entry_data)
  );

  // A pending alarm must be reported before the end of a motion that was stopped at a position.
  assign motion_req_o.triggers_done = !queue_status.fifo_triggered && !multi_o &&
      (idle || block_o.source != SrcOverride);

  // ---- effects of instructions --------------------------------------------------------------------

  ppmc312_setup u_setup (
      .clk_i,
      .rst_ni,
      .block_i         (block_o),
      .cmd_i           (setup_cmd),
      .status_o        (setup_status),
      .built_o,
      .byte_i          (blk_data_i),
      .drop_o          (drop),
      .curve_o         (curve),
      .open_acc_o      (open_acc),
      .open_dec_o      (open_dec),
      .table_write_o   (table_write),
      .close_o         (close),
      .unit_busy_i     (unit_busy),
      .too_few_pulses_i(too_few_pulses)
  );

  ppmc312_move u_move (
      .clk_i,
      .rst_ni,
      .begin_i       (move),
      .block_i       (block_o),
      .status_i      (state_i.status),
      .table_i       (table_o),
      .levels_i      (inputs_i.filtered),
      .limit_rate_i  (state_i.settings.limit_rate),
      .gate_i        (inputs_i.run || state_i.settings.run_ignored),
      .elapsed_i     (elapsed),
      .result_o      (move_status),
      .start_o       (motion_req_o.start),
      .change_o      (motion_req_o.change),
      .op_o          (motion_req_o.op),
      .profile_o     (motion_req_o.profile),
      .single_pulse_o(motion_req_o.single_pulse),
      .profile_req_o (profile_req),
      .plan_busy_i   (plan_busy),
      .plan_kind_i   (plan_kind),
      .profile_i     (profile)
  );

  ppmc312_stage_unit u_stages (
      .clk_i,
      .rst_ni,
      .drop_i          (drop),
      .build_i         (setup_cmd.build),
      .curve_i         (curve),
      .busy_o          (unit_busy),
      .too_few_pulses_o(too_few_pulses),
      .open_i          (setup_cmd.open),
      .open_acc_i      (open_acc),
      .open_dec_i      (open_dec),
      .table_write_i   (table_write),
      .close_i         (close),
      .table_o,
      .start_target_o,
      .read_addr_i     (read_addr),
      .read_stage_o    (read_stage),
      .profile_req_i   (profile_req),
      .plan_busy_o     (plan_busy),
      .plan_kind_o     (plan_kind),
      .profile_o       (profile),
      .table_addr_i,
      .stage_o
  );

  assign first = ppmc_pkg::less(
      32'(table_o.first_acc), 32'(table_o.first_dec)
  ) ? table_o.first_acc : table_o.first_dec;

  // ---- responses ----------------------------------------------------------------------------------

  ppmc312_response_writer #(
      .Version(Version)
  ) u_writer (
      .clk_i,
      .rst_ni,
      .start_i         (response_cmd.write),
      .response_i      (response),
      .done_o          (response_status.written),
      .hold_i          (response_cmd.hold_data),
      .block_i         (block_o),
      .inputs_i,
      .state_i,
      .table_i         (table_o),
      .first_i         (first),
      .left_i          (setup_status.progress.stages_left),
      .queue_status_i  (queue_status),
      .echo_addr_o     (response_status.echo_addr),
      .echo_i          (blk_data_i),
      .peek_o          (peek),
      .peek_at_o       (peek_at),
      .entry_i         (entry_data),
      .response_write_o(writer_byte),
      .size_o          (writer_size),
      .code_o          (response_code),
      .first_o         (response_first)
  );

  ppmc312_table_read u_table_read (
      .clk_i,
      .rst_ni,
      .open_i(response_cmd.table_open),
      .more_o(response_status.table_more),
      .next_i(response_cmd.table_next),
      .busy_o(read_busy),
      .done_o(response_status.table_done),
      .table_i(table_o),
      .first_i(first),
      .table_addr_o(read_addr),
      .stage_i(read_stage),
      .response_write_o(table_byte),
      .size_o(table_size)
  );

  // The register delays the bytes by one cycle, so the last byte is written in the cycle of
  // response_done_o.valid.
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) response_write_o <= '0;
    else begin
      response_write_o    <= read_busy ? table_byte : writer_byte;
      response_write_o.we <= writer_byte.we || table_byte.we;
    end
  end

  always_comb begin
    response_done_o = '{
        valid: commit,
        host: block_o.source == SrcHost,
        trigger_result: (block_o.source == SrcEvent) ? DoneEvent : DoneOverride,
        size: read_busy ? table_size : writer_size
    };
    if (response.kind == KindFailEvent) response_done_o.trigger_result = FailEvent;
    if (response.kind == KindFailOverride) response_done_o.trigger_result = FailOverride;
  end

  assign host_result_o = '{
          valid: commit && response_done_o.host,
          code: response_code,
          first: response_first
      };

endmodule

`default_nettype wire
