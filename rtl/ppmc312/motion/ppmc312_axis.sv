// SPDX-License-Identifier: Apache-2.0
// ppmc312_axis: the motor side: settings, motion, positions, outputs.
// Rules:  through its blocks. Timing: act_i is carried out at the edge that ends its cycle.
`default_nettype none

module ppmc312_axis
  import ppmc312_pkg::*;
  import ppmc312_stage_pkg::*;
#(
    parameter int unsigned ClkHz  = 16_000_000,
    parameter int unsigned XtalHz = 16_000_000
) (
    input  wire logic           clk_i,
    input  wire logic           rst_ni,
    // instructions
    input  wire logic           act_i,           // carry block_i out
    input  wire block_t         block_i,
    input  wire logic           built_i,         // a new table is in force
    input  wire table_t         table_i,
    input  wire target_t        home_i,
    output logic                side_o,          // into the table
    output logic         [ 6:0] addr_o,
    input  wire logic    [15:0] table_rate_i,
    input  wire logic    [23:0] table_pulses_i,
    input  wire logic           start_i,
    input  wire logic           change_i,
    input  wire op_t            op_i,
    input  wire plan_t          plan_i,
    input  wire logic           pos_halt_i,
    input  wire logic           settled_i,
    input  wire logic           multi_i,
    input  wire logic    [ 1:0] multi_code_i,
    // pins
    input  wire levels_t        levels_i,
    input  wire logic           run_i,
    input  wire logic           epin_i,
    input  wire logic           epdir_i,
    input  wire logic           extck_i,
    output logic                pout_o,
    output logic                dir_o,
    output logic                exon_no,
    output logic                cclr_no,
    output logic                aclr_no,
    output logic                zclmp_no,
    output logic                cd_no,
    output logic         [ 5:0] auxo_no,
    // state
    output status_e             status_o,
    output logic                end_wait_o,
    output logic         [15:0] limit_rate_o,
    output logic                end_watch_o,
    output logic                ungated_o,
    output logic         [31:0] pos_o,
    output logic         [31:0] enc_o,
    output logic                counted_o,
    output logic                lock_o,
    output logic         [ 1:0] window_on_o,
    output logic         [ 1:0] outside_o,
    // reports
    output logic                alarm_o,
    output logic         [ 1:0] alarm_code_o,
    output logic                held_o,
    output logic                stop_o,
    output cause_t              cause_o,
    output logic                unlock_o,
    output logic         [ 1:0] wait_o,
    output logic         [ 1:0] value_o,
    input  wire logic    [ 1:0] load_i,
    input  wire logic    [ 1:0] read_i
);

  logic [ 7:0] code;
  logic [31:0] value;
  logic halt_q, decel_q, output_on, launch, rested, count, leave, near, coupled;

  assign code = block_i.code;

  // The code stands long before act_i; a halt has a long way to go.
  always_ff @(posedge clk_i) begin
    halt_q  <= code == I_HALT;
    decel_q <= code == I_DECEL;
  end

  assign value = (code == I_LOCK_POS) ? {block_i.par[0], block_i.par[1], block_i.par[2], block_i.par[3]} :
      {block_i.par[1], block_i.par[2], block_i.par[3], block_i.par[4]};

  ppmc312_settings u_settings (
      .clk_i,
      .rst_ni,
      .do_i   (act_i),
      .code_i (code),
      .value_i({block_i.par[0], block_i.par[1]}),
      .built_i,
      .fast_i (table_i.fast),
      .limit_rate_o,
      .end_watch_o,
      .ungated_o
  );

  ppmc312_motion #(
      .ClkHz (ClkHz),
      .XtalHz(XtalHz)
  ) u_motion (
      .clk_i,
      .rst_ni,
      .table_i,
      .home_i,
      .side_o,
      .addr_o,
      .table_rate_i,
      .table_pulses_i,
      .start_i,
      .op_i,
      .plan_i,
      .halt_i       (act_i && halt_q),
      .decel_i      (act_i && decel_q),
      .change_i,
      .change_ramp_i(code == I_RAMP),
      .pos_halt_i,
      .settled_i,
      .limit_rate_i (limit_rate_o),
      .end_watch_i  (end_watch_o),
      .ungated_i    (ungated_o),
      .levels_i,
      .run_i,
      .extck_i,
      .pout_o,
      .dir_o,
      .multi_i,
      .multi_code_i,
      .leave_i      (leave),
      .alarm_o,
      .alarm_code_o,
      .status_o,
      .end_wait_o,
      .output_o     (output_on),
      .launch_o     (launch),
      .rested_o     (rested),
      .counted_o    (count),
      .held_o,
      .stop_o,
      .cause_o
  );

  ppmc312_position u_position (
      .clk_i,
      .rst_ni,
      .count_i       (count),
      .ccw_i         (dir_o),
      .output_i      (output_on),
      .epin_i,
      .epdir_i,
      .value_i       (value),
      .set_pos_i     (act_i && code == I_POS_SET && !block_i.par[0][0]),
      .set_enc_i     (act_i && code == I_POS_SET && block_i.par[0][0]),
      .set_lock_i    (act_i && code == I_LOCK_POS),
      .toggle_lock_i (act_i && code == I_LOCK),
      .set_window_i  ({act_i && code == I_ENCODE, act_i && code == I_INPOS}),
      .window_flags_i(block_i.par[0][2:0]),
      .window_range_i({block_i.par[1], block_i.par[2]}),
      .pos_o,
      .enc_o,
      .counted_o,
      .lock_o,
      .unlock_o,
      .window_on_o,
      .outside_o,
      .wait_o,
      .value_o,
      .load_i,
      .read_i,
      .near_o        (near),
      .coupled_o     (coupled)
  );

  ppmc312_outputs #(
      .ClkHz (ClkHz),
      .XtalHz(XtalHz)
  ) u_outputs (
      .clk_i,
      .rst_ni,
      .excite_i  (act_i && code == I_EXC_ON),
      .relax_i   (act_i && code == I_EXC_OFF),
      .cclr_i    (act_i && code == I_CCLR),
      .aclr_i    (act_i && code == I_ACLR),
      .clamp_i   (act_i && code == I_CLAMP),
      .aux_i     (act_i && code == I_AUX_OUT),
      .aux_data_i(block_i.par[0][5:0]),
      .launch_i  (launch),
      .rested_i  (rested),
      .abn_i     (status_o == StatusAbn),
      .alm_ni    (levels_i.alm_n),
      .end_ni    (levels_i.end_n),
      .near_i    (near),
      .coupled_i (coupled),
      .leave_o   (leave),
      .exon_no,
      .cclr_no,
      .aclr_no,
      .zclmp_no,
      .cd_no,
      .auxo_no
  );

  logic unused_bits;
  assign unused_bits = &{1'b0, block_i};

endmodule

`default_nettype wire
