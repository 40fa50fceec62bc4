// SPDX-License-Identifier: Apache-2.0
// ppmc312_core: PPMC-312 without host front ends and pin synchronisers. Contains the instruction unit, the
//         motor side, the monitor of the generalized input, and the reports.
// Rules:  see the instantiated blocks.
// Timing: outputs are registered.
`default_nettype none

module ppmc312_core
  import ppmc312_pkg::*;
  import ppmc312_link_pkg::*;
  import ppmc312_serial_pkg::*;
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
    // front end: blocks from the host and reports to the host, in logical order
    input wire host_block_t host_block_i,  // block from the host
    output logic [BLOCK_BITS-1:0] blk_addr_o,  // byte of the block, 0 = header
    input wire logic [7:0] blk_data_i,  // byte at blk_addr_o, two cycles later
    output logic blk_done_o,  // strobe: the block is processed and its response is stored
    output logic rd_any_o,  // a report is pending
    input wire logic rd_load_i,  // strobe: load the next report
    output logic [BLOCK_BITS:0] rd_size_o,  // bytes, 3 .. 32; valid 2 cycles after rd_load_i
    input wire logic [BLOCK_BITS-1:0] rd_addr_i,  // byte of the report, 0 = header
    output logic [7:0] rd_data_o,  // byte at rd_addr_i, two cycles later
    input wire logic rd_done_i,  // strobe: the report has been read
    // for the serial station only
    output host_result_t host_result_o,  // result of the block from the host
    output status_e status_o,  // status of the device
    output poll_result_t poll_result_o,  // report for the next poll; rd_load_i consumes it
    // pins
    input wire inputs_t inputs_i,  // input pins, synchronised
    input wire logic extck_i,  // external clock, asynchronous
    output outputs_t outputs_o  // output pins, registered
);

  block_t block;
  motion_req_t motion_req;
  axis_state_t state;
  axis_event_t axis_event;
  alarm_event_t multi, discarded, discarded_q;
  table_t curve;
  target_t start_target;
  table_addr_t table_addr;
  stage_t stage;
  monitor_req_t monitor_req;
  monitor_ack_t monitor_ack;
  response_write_t response_write;
  response_done_t response_done;
  response_queue_t response_queue;
  logic execute, exec_multi, built, hold, mask, aux_report;
  logic [7:0] aux_data;

  assign status_o = state.status;
  assign mask = execute && block.code == I_MASK;
  // The multiple-occurrence alarm of a discarded report is delayed by one cycle.
  assign multi = '{valid: exec_multi || discarded_q.valid, code: exec_multi ? 2'd1 : discarded_q.code};

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) discarded_q <= '0;
    else discarded_q <= discarded;
  end

  ppmc312_instr_unit #(
      .ClkHz    (ClkHz),
      .XtalHz   (XtalHz),
      .Datasheet(Datasheet),
      .Version  (Version)
  ) u_instr (
      .clk_i,
      .rst_ni,
      .serial_i,
      .boot_i,
      .reset_o,
      .host_block_i,
      .blk_addr_o,
      .blk_data_i,
      .blk_done_o,
      .inputs_i,
      .state_i         (state),
      .block_o         (block),
      .execute_o       (execute),
      .multi_o         (exec_multi),
      .motion_req_o    (motion_req),
      .built_o         (built),
      .table_o         (curve),
      .start_target_o  (start_target),
      .table_addr_i    (table_addr),
      .stage_o         (stage),
      .response_write_o(response_write),
      .hold_o          (hold),
      .response_done_o (response_done),
      .host_result_o,
      .response_queue_i(response_queue)
  );

  ppmc312_axis #(
      .ClkHz (ClkHz),
      .XtalHz(XtalHz)
  ) u_axis (
      .clk_i,
      .rst_ni,
      .execute_i     (execute),
      .block_i       (block),
      .motion_req_i  (motion_req),
      .multi_i       (multi),
      .built_i       (built),
      .table_i       (curve),
      .start_target_i(start_target),
      .table_addr_o  (table_addr),
      .stage_i       (stage),
      .inputs_i,
      .extck_i,
      .outputs_o,
      .state_o       (state),
      .axis_event_o  (axis_event),
      .monitor_req_o (monitor_req),
      .monitor_ack_i (monitor_ack)
  );

  ppmc312_aux_monitor #(
      .ClkHz (ClkHz),
      .XtalHz(XtalHz)
  ) u_aux_monitor (
      .clk_i,
      .rst_ni,
      .set_i   (mask),
      .repeat_i(block.par[0][0]),
      .mask_i  (block.par[1]),
      .auxi_i  (inputs_i.auxi),
      .report_o(aux_report),
      .data_o  (aux_data)
  );

  ppmc312_report_queue u_reports (
      .clk_i,
      .rst_ni,
      .serial_i,
      .axis_event_i    (axis_event),
      .pos_i           (state.pos),
      .discarded_o     (discarded),
      .response_write_i(response_write),
      .response_done_i (response_done),
      .response_queue_o(response_queue),
      .aux_clear_i     (mask),
      .aux_i           (aux_report),
      .aux_data_i      (aux_data),
      .monitor_req_i   (monitor_req),
      .monitor_ack_o   (monitor_ack),
      .hold_i          (hold),
      .rd_any_o,
      .rd_load_i,
      .poll_result_o,
      .rd_size_o,
      .rd_addr_i,
      .rd_data_o,
      .rd_done_i
  );

endmodule

`default_nettype wire
