// SPDX-License-Identifier: Apache-2.0
// ppmc312_setup: builds the active table from the block of an initial setting or the blocks of a free
//         curve.
// Rules:  P312-CMD-00, P312-CMD-01, P312-CMD-FC-1..10, P312-INP-31.
// Timing: status_o.done is high for one cycle when the action requested by cmd_i.build or cmd_i.data has
//         ended. status_o.failed, error and progress are valid in this cycle.
`default_nettype none

module ppmc312_setup
  import ppmc312_pkg::*;
  import ppmc312_link_pkg::*;
  import ppmc312_instr_pkg::*;
  import ppmc312_stage_pkg::*;
(
    input  wire logic             clk_i,            // clock
    input  wire logic             rst_ni,           // reset, asynchronous
    input  wire block_t           block_i,          // the instruction; stable until status_o.done
    input  wire setup_cmd_t       cmd_i,            // commands
    output setup_status_t         status_o,         // state and results
    output logic                  built_o,          // strobe: a new table becomes active
    input  wire logic       [7:0] byte_i,           // byte at status_o.addr, two cycles later
    // table unit
    output logic                  drop_o,           // strobe: the table becomes invalid
    output curve_t                curve_o,          // curve to be built, or parameters of a free curve
    output logic            [6:0] open_acc_o,       // free curve: first stage of the acceleration side
    output logic            [6:0] open_dec_o,       // free curve: first stage of the deceleration side
    output table_write_t          table_write_o,    // word of a free curve
    output logic                  close_o,          // strobe: the free curve is complete
    input  wire logic             unit_busy_i,      // 1: the table cannot be used yet
    input  wire logic             too_few_pulses_i  // a stage has at most 1 pulse: no table
);

  typedef enum logic [1:0] {
    StIdle,
    StBuild,
    StData,
    StClose
  } state_e;

  state_e state_q;
  logic begun_q, split_q, le, free_done, free_bad, new_curve;
  logic [7:0] free_error;
  logic [6:0] n_acc, n_dec;
  logic done, failed, unused_busy;
  curve_progress_t progress;

  assign le = block_i.par[0][4];
  assign n_acc = block_i.par[1][6:0];
  assign n_dec = le ? block_i.par[2][6:0] : n_acc;
  assign open_acc_o = ~n_acc;  // 127 - n_acc
  assign open_dec_o = ~n_dec;
  assign new_curve = cmd_i.build || cmd_i.open;

  assign curve_o = '{
          cosine: block_i.par[0][3],
          split: new_curve || state_q == StBuild ? le : split_q,
          base: block_i.par[0][2:0],
          start_rate: {block_i.par[1], block_i.par[2]},
          stop_rate: {block_i.par[3], block_i.par[4]},
          high_rate: {block_i.par[5], block_i.par[6]},
          acc: (state_q == StData) ? progress.acc_sum : {block_i.par[7], block_i.par[8], block_i.par[9]},
          dec: (state_q == StData) ? progress.dec_sum : {block_i.par[10], block_i.par[11], block_i.par[12]}
      };

  assign close_o = state_q == StData && free_done && !free_bad && progress.complete;
  assign drop_o = cmd_i.fail || (state_q == StData && free_done && free_bad);
  assign done = (state_q inside {StBuild, StClose} && begun_q && !unit_busy_i) ||
      (state_q == StData && free_done && !close_o);
  assign failed = (state_q == StBuild) ? too_few_pulses_i : (state_q == StData) && free_bad;
  assign status_o.done = done;
  assign status_o.failed = failed;
  assign status_o.error = (state_q == StBuild) ? E_TOO_FEW_PULSES : free_error;
  assign status_o.progress = progress;
  assign built_o = done && !failed && state_q != StData;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      state_q <= StIdle;
      begun_q <= 1'b0;
      split_q <= 1'b0;
    end else begin
      begun_q <= state_q inside {StBuild, StClose};  // unit_busy_i is valid while begun_q = 1
      if (new_curve) split_q <= le;
      unique case (state_q)
        StIdle: begin
          if (cmd_i.build) state_q <= StBuild;
          if (cmd_i.data) state_q <= StData;
        end
        StData:  if (free_done) state_q <= close_o ? StClose : StIdle;
        default: if (done) state_q <= StIdle;
      endcase
    end
  end

  ppmc312_free_curve u_free_curve (
      .clk_i,
      .rst_ni,
      .open_i     (cmd_i.open),
      .split_i    (le),
      .acc_i      (n_acc),
      .dec_i      (n_dec),
      .abort_i    (cmd_i.fail),
      .transfer_o (status_o.transfer),
      .data_i     (cmd_i.data),
      .bytes_i    (block_i.len[4:0]),
      .last_i     (block_i.head[0]),
      .busy_o     (unused_busy),
      .done_o     (free_done),
      .addr_o     (status_o.addr),
      .byte_i,
      .bad_o      (free_bad),
      .error_o    (free_error),
      .complete_o (progress.complete),
      .next_list_o(progress.next_list),
      .left_o     (progress.stages_left),
      .acc_sum_o  (progress.acc_sum),
      .dec_sum_o  (progress.dec_sum),
      .table_write_o
  );

  logic unused_bits;
  assign unused_bits = &{1'b0, block_i};

endmodule

`default_nettype wire
