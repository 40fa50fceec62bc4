// SPDX-License-Identifier: Apache-2.0
// ppmc312_axis: motor side of the PPMC-312. Contains settings, motion, positions and outputs.
// Rules:  see the instantiated blocks.
// Timing: block_i takes effect at the edge that ends the cycle of execute_i; an immediate stop takes effect
//         one cycle later.
`default_nettype none

module ppmc312_axis
  import ppmc312_pkg::*;
  import ppmc312_link_pkg::*;
  import ppmc312_stage_pkg::*;
#(
    parameter int unsigned ClkHz  = 16_000_000,
    parameter int unsigned XtalHz = 16_000_000
) (
    input  wire logic         clk_i,           // clock
    input  wire logic         rst_ni,          // reset, asynchronous
    // instructions
    input  wire logic         execute_i,       // strobe: execute block_i
    input  wire block_t       block_i,         // instruction; stable long before execute_i
    input  wire motion_req_t  motion_req_i,    // starts and rate changes
    input  wire alarm_event_t multi_i,         // multiple-occurrence alarm
    // active table
    input  wire logic         built_i,         // strobe: a new table is active
    input  wire table_t       table_i,         // description of the table
    input  wire target_t      start_target_i,  // look-up result for table_i.rate_acc
    output table_addr_t       table_addr_o,    // read port of the table
    input  wire stage_t       stage_i,         // stage at table_addr_o, two cycles later
    // pins
    input  wire inputs_t      inputs_i,        // input pins, synchronised
    input  wire logic         extck_i,         // external clock, asynchronous
    output outputs_t          outputs_o,       // output pins, registered
    // state and reports
    output axis_state_t       state_o,         // state of the motor side
    output axis_event_t       axis_event_o,    // events to be reported
    output monitor_req_t      monitor_req_o,   // reports of the monitors
    input  wire monitor_ack_t monitor_ack_i    // a report of a monitor is being loaded, or has been read
);

  logic [7:0] code;
  logic halt_q, decel_q, output_on, launch, output_end, count, abn_end, coupled_inside, coupled;

  assign code = block_i.code;

  // The path from an immediate stop to the pulses is timing-critical, so it contains a register. The
  // instruction code is stable long before execute_i.
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) {halt_q, decel_q} <= '0;
    else begin
      halt_q  <= execute_i && code == I_HALT;
      decel_q <= code == I_DECEL;
    end
  end

  ppmc312_settings u_settings (
      .clk_i,
      .rst_ni,
      .execute_i   (execute_i),
      .code_i (code),
      .value_i({block_i.par[0], block_i.par[1]}),
      .built_i,
      .high_rate_i (table_i.high_rate),
      .limit_rate_o(state_o.settings.limit_rate),
      .end_monitored_o (state_o.settings.end_monitored),
      .run_ignored_o   (state_o.settings.run_ignored)
  );

  ppmc312_motion #(
      .ClkHz (ClkHz),
      .XtalHz(XtalHz)
  ) u_motion (
      .clk_i,
      .rst_ni,
      .table_i,
      .start_target_i,
      .table_addr_o,
      .stage_i,
      .motion_req_i,
      .change_ramp_i(code == I_RAMP),
      .halt_i       (halt_q),
      .decel_i      (execute_i && decel_q),
      .settings_i   (state_o.settings),
      .levels_i     (inputs_i.filtered),
      .run_i        (inputs_i.run),
      .extck_i,
      .pout_o       (outputs_o.pout),
      .dir_o        (outputs_o.dir),
      .multi_i,
      .abn_end_i    (abn_end),
      .alarm_o      (axis_event_o.alarm),
      .status_o     (state_o.status),
      .end_wait_o   (state_o.end_wait),
      .output_o     (output_on),
      .launch_o     (launch),
      .output_end_o (output_end),
      .counted_o    (count),
      .hold_end_o   (axis_event_o.hold_end),
      .stop_o       (axis_event_o.stop),
      .cause_o      (axis_event_o.cause)
  );

  ppmc312_position u_position (
      .clk_i,
      .rst_ni,
      .count_i         (count),
      .ccw_i           (outputs_o.dir),
      .output_i        (output_on),
      .epin_i          (inputs_i.epin),
      .epdir_i         (inputs_i.epdir),
      .value_i         ({block_i.par[1], block_i.par[2], block_i.par[3], block_i.par[4]}),
      .lock_value_i    ({block_i.par[0], block_i.par[1], block_i.par[2], block_i.par[3]}),
      .set_pos_i       (execute_i && code == I_POS_SET && !block_i.par[0][0]),
      .set_enc_i       (execute_i && code == I_POS_SET && block_i.par[0][0]),
      .set_lock_i      (execute_i && code == I_LOCK_POS),
      .toggle_lock_i   (execute_i && code == I_LOCK),
      .set_window_i    ({execute_i && code == I_ENCODE, execute_i && code == I_INPOS}),
      .window_flags_i  (block_i.par[0][2:0]),
      .window_range_i  ({block_i.par[1], block_i.par[2]}),
      .pos_o           (state_o.pos),
      .enc_o           (state_o.enc),
      .counted_o       (state_o.counted),
      .lock_o          (state_o.lock),
      .unlock_o        (axis_event_o.unlock),
      .window_on_o     (state_o.window_on),
      .outside_o       (state_o.outside),
      .pending_o       (monitor_req_o.pending),
      .value_o         (monitor_req_o.outside),
      .load_i          (monitor_ack_i.load),
      .read_i          (monitor_ack_i.read),
      .coupled_inside_o(coupled_inside),
      .coupled_o       (coupled)
  );

  ppmc312_outputs #(
      .ClkHz (ClkHz),
      .XtalHz(XtalHz)
  ) u_outputs (
      .clk_i,
      .rst_ni,
      .exc_on_i        (execute_i && code == I_EXC_ON),
      .exc_off_i       (execute_i && code == I_EXC_OFF),
      .cclr_i          (execute_i && code == I_CCLR),
      .aclr_i          (execute_i && code == I_ACLR),
      .clamp_i         (execute_i && code == I_CLAMP),
      .aux_i           (execute_i && code == I_AUX_OUT),
      .aux_data_i      (block_i.par[0][5:0]),
      .launch_i        (launch),
      .output_end_i    (output_end),
      .abn_i           (state_o.status == StatusAbn),
      .alm_ni          (inputs_i.filtered.alm_n),
      .end_ni          (inputs_i.filtered.end_n),
      .coupled_inside_i(coupled_inside),
      .coupled_i       (coupled),
      .abn_end_o       (abn_end),
      .lock_i          (state_o.lock),
      .intlk_no        (outputs_o.intlk_n),
      .exon_no         (outputs_o.exon_n),
      .cclr_no         (outputs_o.cclr_n),
      .aclr_no         (outputs_o.aclr_n),
      .zclmp_no        (outputs_o.zclmp_n),
      .cd_no           (outputs_o.cd_n),
      .auxo_no         (outputs_o.auxo_n)
  );

  logic unused_bits;
  assign unused_bits = &{1'b0, block_i, inputs_i};

endmodule

`default_nettype wire
