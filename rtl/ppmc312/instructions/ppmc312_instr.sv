// SPDX-License-Identifier: Apache-2.0
// ppmc312_instr: everything that has to do with instructions: those of the host, those that wait for a trigger,
// what they set going, and their answers.
// Rules:  through its blocks. Timing: see ppmc312_exec.
`default_nettype none

module ppmc312_instr
  import ppmc312_pkg::*;
  import ppmc312_stage_pkg::*;
#(
    parameter int unsigned ClkHz     = 16_000_000,
    parameter int unsigned XtalHz    = 16_000_000,
    parameter bit          Datasheet = 1'b0
) (
    input  wire logic                          clk_i,
    input  wire logic                          rst_ni,
    input  wire logic                          serial_i,
    input  wire logic                          boot_i,
    output logic                               reset_o,
    // front end
    input  wire logic                          blk_valid_i,
    input  wire logic    [  BLOCK_BITS:0]      blk_size_i,
    output logic         [BLOCK_BITS-1:0]      blk_addr_o,
    input  wire logic    [           7:0]      blk_data_i,
    output logic                               blk_done_o,
    // triggers
    input  wire logic    [           1:0]      edge_i,
    input  wire logic                          counted_i,
    input  wire logic    [          31:0]      pos_i,
    output logic                               pos_halt_o,
    output logic                               settled_o,
    // state of the part
    input  wire status_e                       status_i,
    input  wire logic                          end_wait_i,
    input  wire levels_t                       levels_i,
    input  wire logic    [          15:0]      limit_rate_i,
    input  wire logic                          gate_i,
    output stored_t                            stored_o,
    input  wire logic    [           3:0]      reply_extra_i,
    input  wire logic    [           8:0][7:0] reply_data_i,
    // to be carried out
    output block_t                             block_o,
    output logic                               do_o,
    output logic                               multi_o,
    output logic                               start_o,
    output logic                               change_o,
    output op_t                                op_o,
    output plan_t                              plan_o,
    output logic                               built_o,
    // the motion's port into the table
    output table_t                             table_o,
    output target_t                            home_o,
    input  wire logic                          side_i,
    input  wire logic    [           6:0]      addr_i,
    output logic         [          15:0]      rate_o,
    output logic         [          23:0]      pulses_o,
    // store of class 2
    output logic                               answer_we_o,
    output logic         [BLOCK_BITS-1:0]      answer_addr_o,
    output logic         [           7:0]      answer_data_o,
    output logic                               hold_o,
    output logic                               commit_o,
    output logic         [  BLOCK_BITS:0]      commit_size_o,
    output logic                               commit_host_o,
    output answer_t                            answer_o,       // holds until blk_done_o
    input  wire logic                          full_i,
    input  wire logic                          full_host_i,
    input  wire logic                          waits_i
);

  put_t put;
  remove_t remove;
  curve_t curve;
  entry_t entry;
  plan_t plan;
  logic fetch_event, build, open, data, fail, transfer, setup_done, setup_bad, complete, drop, close;
  logic unit_busy, thin;
  logic move, move_done, limited, refused, write, written, read_open, read_block, read_more, read_done;
  logic unused_busy;
  logic read_busy, write_we, read_we, plan_start, plan_ramp, plan_endless, plan_busy;
  logic paced, idle, read_side;
  logic [7:0] entry_data, setup_error, kind, plan_kind, write_data, read_data;
  logic [1:0] list;
  logic [6:0] left, open_acc, open_dec, read_addr;
  logic [23:0] acc_sum, dec_sum, read_pulses;
  logic [15:0] read_rate, plan_rate;
  logic [31:0] plan_count;
  logic [ 4:0] echo_bytes;
  logic [BLOCK_BITS-1:0] setup_addr, echo_addr, write_addr, read_at;
  logic [BLOCK_BITS:0] write_size, read_size;

  ppmc312_exec u_exec (
      .clk_i,
      .rst_ni,
      .serial_i,
      .boot_i,
      .reset_o,
      .blk_valid_i,
      .blk_size_i,
      .fetch_addr_o (blk_addr_o),
      .blk_data_i,
      .blk_done_o,
      .stored_i     (stored_o),
      .remove_o     (remove),
      .put_o        (put),
      .fetch_event_o(fetch_event),
      .entry_data_i (entry_data),
      .settled_o,
      .status_i,
      .end_wait_i,
      .table_i      (table_o),
      .reply_extra_i,
      .reply_data_i,
      .open_i       (paced),
      .idle_o       (idle),
      .hold_o,
      .block_o,
      .do_o,
      .multi_o,
      .build_o      (build),
      .open_o       (open),
      .data_o       (data),
      .fail_o       (fail),
      .transfer_i   (transfer),
      .setup_done_i (setup_done),
      .setup_bad_i  (setup_bad),
      .setup_error_i(setup_error),
      .complete_i   (complete),
      .list_i       (list),
      .left_i       (left),
      .acc_sum_i    (acc_sum),
      .dec_sum_i    (dec_sum),
      .setup_addr_i (setup_addr),
      .move_o       (move),
      .move_done_i  (move_done),
      .limited_i    (limited),
      .refused_i    (refused),
      .kind_i       (kind),
      .answer_o,
      .write_o      (write),
      .echo_bytes_o (echo_bytes),
      .written_i    (written),
      .echo_addr_i  (echo_addr),
      .read_open_o  (read_open),
      .read_block_o (read_block),
      .read_more_i  (read_more),
      .read_done_i  (read_done),
      .commit_o,
      .commit_host_o,
      .full_i,
      .full_host_i,
      .waits_i
  );

  ppmc312_pace #(
      .ClkHz    (ClkHz),
      .XtalHz   (XtalHz),
      .Datasheet(Datasheet)
  ) u_pace (
      .clk_i,
      .rst_ni,
      .idle_i (idle),
      .block_i(block_o),
      .kind_i (plan_kind),
      .open_o (paced)
  );

  ppmc312_store u_store (
      .clk_i,
      .rst_ni,
      .edge_i,
      .counted_i,
      .pos_i,
      .halt_o       (pos_halt_o),
      .stored_o,
      .put_i        (put),
      .remove_i     (remove),
      .fetch_event_i(fetch_event),
      .fetch_addr_i (blk_addr_o[3:0]),
      .fetch_data_o (entry_data)
  );

  ppmc312_setup u_setup (
      .clk_i,
      .rst_ni,
      .block_i    (block_o),
      .build_i    (build),
      .open_i     (open),
      .data_i     (data),
      .fail_i     (fail),
      .transfer_o (transfer),
      .done_o     (setup_done),
      .bad_o      (setup_bad),
      .error_o    (setup_error),
      .complete_o (complete),
      .list_o     (list),
      .left_o     (left),
      .acc_sum_o  (acc_sum),
      .dec_sum_o  (dec_sum),
      .built_o,
      .addr_o     (setup_addr),
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
      .begin_i       (move),
      .block_i       (block_o),
      .status_i,
      .table_i       (table_o),
      .home_i        (home_o),
      .levels_i,
      .limit_rate_i,
      .gate_i,
      .open_i        (paced),
      .done_o        (move_done),
      .limited_o     (limited),
      .refused_o     (refused),
      .kind_o        (kind),
      .start_o,
      .change_o,
      .op_o,
      .plan_o,
      .plan_start_o  (plan_start),
      .plan_ramp_o   (plan_ramp),
      .plan_endless_o(plan_endless),
      .plan_rate_o   (plan_rate),
      .plan_count_o  (plan_count),
      .plan_busy_i   (plan_busy),
      .plan_kind_i   (plan_kind),
      .plan_i        (plan)
  );

  ppmc312_stage_unit u_stages (
      .clk_i,
      .rst_ni,
      .drop_i        (drop),
      .build_i       (build),
      .curve_i       (curve),
      .busy_o        (unit_busy),
      .thin_o        (thin),
      .open_i        (open),
      .open_acc_i    (open_acc),
      .open_dec_i    (open_dec),
      .entry_i       (entry),
      .close_i       (close),
      .table_o,
      .home_o,
      .read_side_i   (read_side),
      .read_addr_i   (read_addr),
      .read_rate_o   (read_rate),
      .read_pulses_o (read_pulses),
      .plan_start_i  (plan_start),
      .plan_ramp_i   (plan_ramp),
      .plan_endless_i(plan_endless),
      .plan_rate_i   (plan_rate),
      .plan_count_i  (plan_count),
      .plan_busy_o   (plan_busy),
      .plan_kind_o   (plan_kind),
      .plan_o        (plan),
      .side_i,
      .addr_i,
      .rate_o,
      .pulses_o
  );

  // ---- answers ---------------------------------------------------------------------------------------------------

  ppmc312_answer u_answer (
      .clk_i,
      .rst_ni,
      .start_i     (write),
      .answer_i    (answer_o),
      .echo_bytes_i(echo_bytes),
      .busy_o      (unused_busy),
      .done_o      (written),
      .echo_addr_o (echo_addr),
      .echo_data_i (blk_data_i),
      .we_o        (write_we),
      .addr_o      (write_addr),
      .data_o      (write_data),
      .size_o      (write_size)
  );

  ppmc312_readback u_readback (
      .clk_i,
      .rst_ni,
      .open_i (read_open),
      .more_o (read_more),
      .block_i(read_block),
      .busy_o (read_busy),
      .done_o (read_done),
      .table_i(table_o),
      .side_o (read_side),
      .addr_o (read_addr),
      .rate_i (read_rate),
      .pulses_i(read_pulses),
      .we_o   (read_we),
      .at_o   (read_at),
      .data_o (read_data),
      .size_o (read_size)
  );

  assign answer_we_o   = write_we || read_we;
  assign answer_addr_o = read_busy ? read_at : write_addr;
  assign answer_data_o = read_busy ? read_data : write_data;
  assign commit_size_o = read_busy ? read_size : write_size;

endmodule

`default_nettype wire
