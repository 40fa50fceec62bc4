// SPDX-License-Identifier: Apache-2.0
// ppmc312_setup: initial setting and free curve: from their blocks to the table in force.
// Rules:  P312-CMD-00, P312-CMD-01, P312-CMD-FC-1..10, P312-INP-31.
// Timing: build_i and data_i are followed by busy_o; what has come of it stands with done_o and after it.
`default_nettype none

module ppmc312_setup
  import ppmc312_pkg::*;
  import ppmc312_stage_pkg::*;
(
    input  wire logic                    clk_i,
    input  wire logic                    rst_ni,
    input  wire block_t                  block_i,
    input  wire logic                    build_i,      // initial setting, judged
    input  wire logic                    open_i,       // code block of a free curve, judged
    input  wire logic                    data_i,       // data block of one, judged
    input  wire logic                    fail_i,       // a set-up has failed
    output logic                         transfer_o,   // a free-curve transfer is open
    output logic                         done_o,
    output logic                         bad_o,
    output logic        [           7:0] error_o,
    output logic                         complete_o,   // the curve is
    output logic        [           1:0] list_o,       // what comes next
    output logic        [           6:0] left_o,
    output logic        [          23:0] acc_sum_o,
    output logic        [          23:0] dec_sum_o,
    output logic                         built_o,      // a new table comes into force
    // bytes of the block
    output logic        [BLOCK_BITS-1:0] addr_o,
    input  wire logic   [           7:0] byte_i,
    // table unit
    output logic                         drop_o,
    output curve_t                       curve_o,
    output logic        [           6:0] open_acc_o,
    output logic        [           6:0] open_dec_o,
    output entry_t                       entry_o,
    output logic                         close_o,
    input  wire logic                    unit_busy_i,
    input  wire logic                    thin_i
);

  typedef enum logic [1:0] {
    StIdle,
    StBuild,
    StData,
    StClose
  } state_e;

  state_e state_q;
  logic begun_q, split_q, le, free_done, free_bad, taken;
  logic [7:0] free_error;
  logic [6:0] n_acc, n_dec;
  logic unused_busy;

  assign le = block_i.par[0][4];
  assign n_acc = block_i.par[1][6:0];
  assign n_dec = le ? block_i.par[2][6:0] : n_acc;
  assign open_acc_o = 7'd127 - n_acc;
  assign open_dec_o = 7'd127 - n_dec;
  assign taken = build_i || open_i;

  assign curve_o = '{
          cosine: block_i.par[0][3],
          split: taken || state_q == StBuild ? le : split_q,
          base: block_i.par[0][2:0],
          start: {block_i.par[1], block_i.par[2]},
          stop: le ? {block_i.par[3], block_i.par[4]} : {block_i.par[1], block_i.par[2]},
          fast: {block_i.par[5], block_i.par[6]},
          acc: (state_q == StData) ? acc_sum_o : {block_i.par[7], block_i.par[8], block_i.par[9]},
          dec: (state_q == StData) ? dec_sum_o : {block_i.par[10], block_i.par[11], block_i.par[12]}
      };

  assign close_o = state_q == StData && free_done && !free_bad && complete_o;
  assign drop_o = fail_i || (state_q == StData && free_done && free_bad);
  assign done_o = (state_q inside {StBuild, StClose} && begun_q && !unit_busy_i) ||
      (state_q == StData && free_done && !close_o);
  assign bad_o = (state_q == StBuild) ? thin_i : (state_q == StData) && free_bad;
  assign error_o = (state_q == StBuild) ? E_THIN : free_error;
  assign built_o = done_o && !bad_o && state_q != StData;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      state_q <= StIdle;
      begun_q <= 1'b0;
      split_q <= 1'b0;
    end else begin
      begun_q <= state_q inside {StBuild, StClose};  // unit_busy_i stands by then
      if (taken) split_q <= le;
      unique case (state_q)
        StIdle: begin
          if (build_i) state_q <= StBuild;
          if (data_i) state_q <= StData;
        end
        StData:  if (free_done) state_q <= close_o ? StClose : StIdle;
        default: if (done_o) state_q <= StIdle;
      endcase
    end
  end

  ppmc312_free u_free (
      .clk_i,
      .rst_ni,
      .open_i,
      .split_i(le),
      .acc_i  (n_acc),
      .dec_i  (n_dec),
      .abort_i(fail_i),
      .transfer_o,
      .data_i,
      .bytes_i(block_i.len[4:0]),
      .last_i (block_i.head[0]),
      .busy_o (unused_busy),
      .done_o (free_done),
      .addr_o,
      .byte_i,
      .bad_o  (free_bad),
      .error_o(free_error),
      .complete_o,
      .list_o,
      .left_o,
      .acc_sum_o,
      .dec_sum_o,
      .entry_o
  );

  logic unused_bits;
  assign unused_bits = &{1'b0, block_i};

endmodule

`default_nettype wire
