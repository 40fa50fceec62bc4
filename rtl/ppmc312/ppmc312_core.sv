// SPDX-License-Identifier: Apache-2.0
// ppmc312_core: PPMC-312 without host front ends and pin synchronisers: instructions, motor side, monitor of
//         the generalized input, reports.
// Rules:  see its blocks. Timing: outputs are registered.
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
    input  wire logic                     clk_i,       // clock
    input  wire logic                     rst_ni,      // reset, asynchronous
    input  wire logic                     serial_i,    // 1: the front end is the serial station
    input  wire logic                     boot_i,      // leaving a reset by an instruction: report it
    output logic                          reset_o,     // strobe: an instruction requests a reset
    // front end: blocks of the host, reports to it, in logical order
    input  wire offer_t                   offer_i,     // block from the host
    output logic         [BLOCK_BITS-1:0] blk_addr_o,  // byte of the block, 0 = header
    input  wire logic    [           7:0] blk_data_i,  // byte at blk_addr_o, two cycles later
    output logic                          blk_done_o,  // strobe: the block is processed and answered
    output logic                          rd_any_o,    // a report is pending
    input  wire logic                     rd_load_i,   // strobe: load the next report
    output logic         [  BLOCK_BITS:0] rd_size_o,   // bytes, 3 .. 32; valid 2 cycles after rd_load_i
    input  wire logic    [BLOCK_BITS-1:0] rd_addr_i,   // byte of the report, 0 = header
    output logic         [           7:0] rd_data_o,   // byte at rd_addr_i, two cycles later
    input  wire logic                     rd_done_i,   // strobe: the report has been read
    // for the serial station only
    output answered_t                     answered_o,  // result of the block from the host
    output status_e                       status_o,    // status of the device
    output poll_t                         poll_o,      // result of a poll; rd_load_i consumes it
    // pins
    input  wire inputs_t                  inputs_i,    // input pins, synchronised
    input  wire logic                     extck_i,     // external clock, asynchronous
    output outputs_t                      outputs_o    // output pins, registered
);

  block_t block;
  motion_order_t order;
  axis_state_t state;
  notice_t notice;
  alarm_t multi, over, late_q;
  table_t curve;
  target_t home;
  look_t look;
  stage_t stage;
  windows_t windows;
  window_take_t take;
  answer_byte_t answer_byte;
  commit_t commit;
  class2_t class2;
  logic act, exec_multi, built, hold, mask, aux_report;
  logic [7:0] aux_data;

  assign status_o = state.status;
  assign mask = act && block.code == I_MASK;
  // The multiple-occurrence alarm of a discarded report follows one cycle later.
  assign multi = '{valid: exec_multi || late_q.valid, code: exec_multi ? 2'd1 : late_q.code};

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) late_q <= '0;
    else late_q <= over;
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
      .offer_i,
      .blk_addr_o,
      .blk_data_i,
      .blk_done_o,
      .inputs_i,
      .state_i (state),
      .block_o (block),
      .do_o    (act),
      .multi_o (exec_multi),
      .order_o (order),
      .built_o (built),
      .table_o (curve),
      .home_o  (home),
      .look_i  (look),
      .stage_o (stage),
      .byte_o  (answer_byte),
      .hold_o  (hold),
      .commit_o(commit),
      .answered_o,
      .class2_i(class2)
  );

  ppmc312_axis #(
      .ClkHz (ClkHz),
      .XtalHz(XtalHz)
  ) u_axis (
      .clk_i,
      .rst_ni,
      .act_i    (act),
      .block_i  (block),
      .order_i  (order),
      .multi_i  (multi),
      .built_i  (built),
      .table_i  (curve),
      .home_i   (home),
      .look_o   (look),
      .stage_i  (stage),
      .inputs_i,
      .extck_i,
      .outputs_o,
      .state_o  (state),
      .notice_o (notice),
      .windows_o(windows),
      .take_i   (take)
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
      .notice_i   (notice),
      .pos_i      (state.pos),
      .over_o     (over),
      .byte_i     (answer_byte),
      .commit_i   (commit),
      .class2_o   (class2),
      .aux_clear_i(mask),
      .aux_i      (aux_report),
      .aux_data_i (aux_data),
      .windows_i  (windows),
      .take_o     (take),
      .hold_i     (hold),
      .rd_any_o,
      .rd_load_i,
      .poll_o,
      .rd_size_o,
      .rd_addr_i,
      .rd_data_o,
      .rd_done_i
  );

endmodule

`default_nettype wire
