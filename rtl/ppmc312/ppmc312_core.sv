// SPDX-License-Identifier: Apache-2.0
// ppmc312_core: the part without its host port and its pin synchronisers: instructions, motion, positions,
// outputs, reports.
// Rules:  through its blocks. Timing: outputs are flip-flops.
`default_nettype none

module ppmc312_core
  import ppmc312_pkg::*;
  import ppmc312_serial_pkg::*;
  import ppmc312_stage_pkg::*;
#(
    parameter int unsigned       ClkHz     = 16_000_000,
    parameter int unsigned       XtalHz    = 16_000_000,
    parameter bit                Datasheet = 1'b0,
    parameter logic        [7:0] Version   = 8'h12
) (
    input  wire logic                     clk_i,
    input  wire logic                     rst_ni,
    input  wire logic                     serial_i,        // the front end is the serial station
    input  wire logic                     boot_i,          // the reset came from an instruction: tell so
    output logic                          reset_o,
    // front end: blocks of the host, reports to it, in logical order
    input  wire logic                     blk_valid_i,
    input  wire logic    [  BLOCK_BITS:0] blk_size_i,
    output logic         [BLOCK_BITS-1:0] blk_addr_o,
    input  wire logic    [           7:0] blk_data_i,
    output logic                          blk_done_o,
    output logic                          rd_any_o,
    input  wire logic                     rd_load_i,
    output logic         [  BLOCK_BITS:0] rd_size_o,
    input  wire logic    [BLOCK_BITS-1:0] rd_addr_i,
    output logic         [           7:0] rd_data_o,
    input  wire logic                     rd_done_i,
    // what only the serial station looks at
    output logic                          answered_o,      // the host's block
    output logic         [           7:0] answer_code_o,   // one clk later
    output logic         [           2:0] answer_first_o,
    output status_e                       status_o,
    output poll_t                         poll_o,          // rd_load_i takes it
    // pins, synchronous; extck is not
    input  wire levels_t                  plain_i,
    input  wire levels_t                  levels_i,
    input  wire logic    [           1:0] evt_ni,
    input  wire logic    [           1:0] edge_i,
    input  wire logic                     run_i,
    input  wire logic                     epin_i,
    input  wire logic                     epdir_i,
    input  wire logic    [           7:0] auxi_i,
    input  wire logic                     extck_i,
    output logic                          pout_o,
    output logic                          dir_o,
    output logic                          intlk_no,
    output logic                          exon_no,
    output logic                          cclr_no,
    output logic                          aclr_no,
    output logic                          zclmp_no,
    output logic                          cd_no,
    output logic         [           5:0] auxo_no
);

  block_t block;
  stored_t stored;
  status_e status;
  table_t curve;
  target_t home;
  op_t op;
  plan_t plan;
  cause_t cause;
  answer_t answer;
  triggered_e what;
  logic act, exec_multi, multi, over, over_q, start, change, built, pos_halt, settled, counted, end_wait;
  logic held, stop, alarm, lock, unlock, end_watch, ungated, aux_report;
  logic commit, commit_host, hold, full, full_host, waits, answer_we;
  logic [1:0] alarm_code, over_code, over_code_q, window_on, outside, window_wait, window_value;
  logic [1:0] window_load, window_read;
  logic [3:0] reply_extra;
  logic [8:0][7:0] reply_data;
  logic [7:0] code, answer_data, aux_data;
  logic [31:0] pos, enc;
  logic [15:0] limit_rate, stage_rate;
  logic [23:0] stage_pulses;
  logic stage_side;
  logic [6:0] stage;
  logic [BLOCK_BITS-1:0] answer_addr;
  logic [BLOCK_BITS:0] commit_size;

  assign code = block.code;
  assign multi = exec_multi || over_q;
  assign status_o = status;
  assign answered_o = commit && commit_host;
  assign answer_code_o = answer.code;
  assign answer_first_o = answer.data[0][2:0];

  always_comb begin
    unique case (answer.code)
      A_EVENT:    what = FailEvent;
      A_OVERRIDE: what = FailOverride;
      default:    what = (block.source == SrcEvent) ? DoneEvent : DoneOverride;
    endcase
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      over_q      <= 1'b0;
      over_code_q <= '0;
      intlk_no    <= 1'b1;
    end else begin
      over_q      <= over;
      over_code_q <= over_code;
      intlk_no    <= !lock;
    end
  end

  ppmc312_instr #(
      .ClkHz    (ClkHz),
      .XtalHz   (XtalHz),
      .Datasheet(Datasheet)
  ) u_instr (
      .clk_i,
      .rst_ni,
      .serial_i,
      .boot_i,
      .reset_o,
      .blk_valid_i,
      .blk_size_i,
      .blk_addr_o,
      .blk_data_i,
      .blk_done_o,
      .edge_i,
      .counted_i    (counted),
      .pos_i        (pos),
      .pos_halt_o   (pos_halt),
      .settled_o    (settled),
      .status_i     (status),
      .end_wait_i   (end_wait),
      .levels_i,
      .limit_rate_i (limit_rate),
      .gate_i       (run_i || ungated),
      .stored_o     (stored),
      .reply_extra_i(reply_extra),
      .reply_data_i (reply_data),
      .block_o      (block),
      .do_o         (act),
      .multi_o      (exec_multi),
      .start_o      (start),
      .change_o     (change),
      .op_o         (op),
      .plan_o       (plan),
      .built_o      (built),
      .table_o      (curve),
      .home_o       (home),
      .side_i       (stage_side),
      .addr_i       (stage),
      .rate_o       (stage_rate),
      .pulses_o     (stage_pulses),
      .answer_we_o  (answer_we),
      .answer_addr_o(answer_addr),
      .answer_data_o(answer_data),
      .hold_o       (hold),
      .commit_o     (commit),
      .commit_size_o(commit_size),
      .commit_host_o(commit_host),
      .answer_o     (answer),
      .full_i       (full),
      .full_host_i  (full_host),
      .waits_i      (waits)
  );

  ppmc312_reply #(
      .Version(Version)
  ) u_reply (
      .clk_i,
      .block_i    (block),
      .status_i   (status),
      .table_i    (curve),
      .plain_i,
      .evt_ni,
      .run_i,
      .auxi_i,
      .pos_i      (pos),
      .enc_i      (enc),
      .lock_i     (lock),
      .ungated_i  (ungated),
      .end_watch_i(end_watch),
      .window_on_i(window_on),
      .outside_i  (outside),
      .stored_i   (stored),
      .extra_o    (reply_extra),
      .data_o     (reply_data)
  );

  ppmc312_axis #(
      .ClkHz (ClkHz),
      .XtalHz(XtalHz)
  ) u_axis (
      .clk_i,
      .rst_ni,
      .act_i         (act),
      .block_i       (block),
      .built_i       (built),
      .table_i       (curve),
      .home_i        (home),
      .side_o        (stage_side),
      .addr_o        (stage),
      .table_rate_i  (stage_rate),
      .table_pulses_i(stage_pulses),
      .start_i       (start),
      .change_i      (change),
      .op_i          (op),
      .plan_i        (plan),
      .pos_halt_i    (pos_halt),
      .settled_i     (settled),
      .multi_i       (multi),
      .multi_code_i  (exec_multi ? 2'd1 : over_code_q),
      .levels_i,
      .run_i,
      .epin_i,
      .epdir_i,
      .extck_i,
      .pout_o,
      .dir_o,
      .exon_no,
      .cclr_no,
      .aclr_no,
      .zclmp_no,
      .cd_no,
      .auxo_no,
      .status_o      (status),
      .end_wait_o    (end_wait),
      .limit_rate_o  (limit_rate),
      .end_watch_o   (end_watch),
      .ungated_o     (ungated),
      .pos_o         (pos),
      .enc_o         (enc),
      .counted_o     (counted),
      .lock_o        (lock),
      .window_on_o   (window_on),
      .outside_o     (outside),
      .alarm_o       (alarm),
      .alarm_code_o  (alarm_code),
      .held_o        (held),
      .stop_o        (stop),
      .cause_o       (cause),
      .unlock_o      (unlock),
      .wait_o        (window_wait),
      .value_o       (window_value),
      .load_i        (window_load),
      .read_i        (window_read)
  );

  ppmc312_auxin #(
      .ClkHz (ClkHz),
      .XtalHz(XtalHz)
  ) u_auxin (
      .clk_i,
      .rst_ni,
      .set_i   (act && code == I_MASK),
      .repeat_i(block.par[0][0]),
      .mask_i  (block.par[1]),
      .auxi_i,
      .report_o(aux_report),
      .data_o  (aux_data)
  );

  // ---- reports ---------------------------------------------------------------------------------------------------

  ppmc312_reports u_reports (
      .clk_i,
      .rst_ni,
      .serial_i,
      .alarm_i       (alarm),
      .alarm_code_i  (alarm_code),
      .answer_we_i   (answer_we),
      .answer_addr_i (answer_addr),
      .answer_data_i (answer_data),
      .commit_i      (commit),
      .commit_size_i (commit_size),
      .commit_host_i (commit_host),
      .commit_what_i (what),
      .full_o        (full),
      .full_host_o   (full_host),
      .waits_o       (waits),
      .unlock_i      (unlock),
      .held_i        (held),
      .stop_i        (stop),
      .stop_cause_i  (cause),
      .stop_pos_i    (pos),
      .over_o        (over),
      .over_code_o   (over_code),
      .aux_clear_i   (act && code == I_MASK),
      .aux_i         (aux_report),
      .aux_data_i    (aux_data),
      .window_i      (window_wait),
      .window_value_i(window_value),
      .window_load_o (window_load),
      .window_read_o (window_read),
      .hold_i        (hold),
      .rd_any_o,
      .rd_load_i,
      .poll_o,
      .rd_size_o,
      .rd_addr_i,
      .rd_data_o,
      .rd_done_i
  );

  logic unused_bits;
  assign unused_bits = &{1'b0, block, curve, answer};

endmodule

`default_nettype wire
