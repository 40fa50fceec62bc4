// SPDX-License-Identifier: Apache-2.0
// pmc006_control: logic between the serial line and the motion. Contains executor, registers, user program,
//         EEPROM interface and stop conditions.
// Rules:  P006-CMD, P006-STA, P006-EXT, P006-STL, P006-IO, P006-PRG, P006-EEP: see the instantiated blocks.
// Timing: motion_start_o and halt_o are combinational. They are asserted in the cycle before the edge at
//         which BUSY changes.
`default_nettype none

module pmc006_control
  import pmc006_pkg::*;
#(
    parameter int unsigned        ClkHz   = 16_000_000,
    parameter int unsigned        I2cHz   = 400_000,
    parameter logic        [ 6:0] Device  = 7'h50,
    parameter bit                 Echo    = 1'b0,
    parameter logic        [31:0] Version = 32'h0000_0123
) (
    input  wire logic                  clk_i,
    input  wire logic                  rst_ni,
    input  wire logic                  us_i,            // strobe every microsecond
    output logic                       boot_o,          // 1: the device is booting
    // host
    input  wire frame_t                frame_i,         // valid frame from the host
    output logic                [31:0] reply_o,         // data of the reply
    output logic                [ 7:0] addr_o,          // address of the device
    // pins; the inputs are synchronised
    input  wire logic                  fset_ni,         // pin FSET; low: factory settings
    input  wire logic           [ 1:0] ext_i,           // [0]: EXT1, [1]: EXT2
    input  wire logic           [ 4:0] gpi_i,           // general inputs
    output logic                [ 1:0] pull_up_o,       // 1: pull-up enabled, [0]: EXT1, [1]: EXT2
    output logic                [ 4:0] gpo_o,           // general outputs
    input  wire sample_t               bemf_i,          // sample of the back EMF
    input  wire logic                  scl_i,           // SCL of the EEPROM bus
    input  wire logic                  sda_i,           // SDA of the EEPROM bus
    output logic                       scl_oe_o,        // 1: drive SCL low
    output logic                       sda_oe_o,        // 1: drive SDA low
    // motion
    output motor_settings_t            settings_o,      // settings used by motion and drive
    output motion_start_t              motion_start_o,  // start of a motion
    output logic                       halt_o,          // 1: stop the motion immediately
    input  wire motion_status_t        motion_i,        // state of the motion
    input  wire logic                  step_i           // 1: a step is made at the next rising edge
);

  exec_cmd_t cmd;
  reg_access_t access;
  logic [13:0] reg_value;
  control_settings_t control;
  logic instr_req, instr_cancel, instr_ack, claim, word1, use_pp, try_accept;
  logic load, load_wide, store, legal, exec, set_position, reply_sample, write, accepted, accepted_q;
  logic put, program_accepted, burning, autostart, byte_we, key_stop;
  logic ee_idle, ee_failed, save, burn, speed_mode, stall, ext_event, stall_stop, stall_mark;
  logic rst_settings_n, restore, unused_rearm;
  logic [1:0] flags;
  logic [4:0] gpo_reg;
  logic [7:0] load_op, byte_read, byte_written, word_addr, pp;
  logic [ 9:0] byte_addr;
  logic [15:0] pair;
  logic [31:0] word, position, stall_position;

  // ---- executor, registers --------------------------------------------------------------------------------

  pmc006_exec u_exec (
      .clk_i,
      .rst_ni,
      .frame_i,
      .instr_req_i   (instr_req),
      .cancel_i      (instr_cancel),
      .instr_ack_o   (instr_ack),
      .claim_o       (claim),
      .word1_o       (word1),
      .use_pp_o      (use_pp),
      .word_i        (word),
      .load_i        (load),
      .load_op_i     (load_op),
      .load_data_i   ({load_wide ? pair[15:8] : 8'd0, pair[7:0]}),
      .store_i       (store),
      .cmd_o         (cmd),
      .access_o      (access),
      .legal_o       (legal),
      .exec_o        (exec),
      .set_position_o(set_position),
      .step_i,
      .try_accept_i  (try_accept),
      .reply_sample_o(reply_sample)
  );

  assign write = exec && legal;

  pmc006_settings u_settings (
      .clk_i,
      .rst_ni   (rst_settings_n),
      .cmd_i    (cmd),
      .access_i (access),
      .write_i  (write),
      .sample_i (reply_sample),
      .settings_o,
      .control_o(control),
      .value_o  (reg_value)
  );

  // ---- user program ---------------------------------------------------------------------------------------

  pmc006_program u_program (
      .clk_i,
      .rst_ni,
      .autostart_i (autostart),
      .cmd_i       (cmd),
      .legal_i     (legal),
      .exec_i      (exec),
      .instr_ack_i (instr_ack),
      .instr_req_o (instr_req),
      .cancel_o    (instr_cancel),
      .word1_i     (word1),
      .use_pp_i    (use_pp),
      .word_addr_o (word_addr),
      .try_accept_o(try_accept),
      .put_o       (put),
      .accepted_o  (program_accepted),
      .burning_i   (burning),
      .pp_o        (pp),
      .us_i,
      .stop_o      (key_stop),
      .gpi_i,
      .flags_i     (flags),
      .busy_i      (motion_i.busy),
      .stall_i     (stall)
  );

  pmc006_buffer u_buffer (
      .clk_i,
      .claim_i    (claim),
      .word_addr_i(word_addr),
      .put_i      (put),
      .data_i     (cmd.data),
      .word_o     (word),
      .byte_addr_i(byte_addr),
      .we_i       (byte_we),
      .byte_i     (byte_written),
      .byte_o     (byte_read),
      .pair_o     (pair)
  );

  // ---- EEPROM ---------------------------------------------------------------------------------------------

  assign save = exec && cmd.op == I_SAVE && ee_idle;
  assign burn = exec && cmd.op == I_BURN && ee_idle;

  pmc006_debounce #(
      .LowTicks    (20_001),
      .HighTicks   (0),
      .ArmedAtReset(1'b1)
  ) u_fset (
      .clk_i,
      .rst_ni,
      .us_i,
      .pin_i  (fset_ni),
      .hit_o  (restore),
      .rearm_o(unused_rearm)
  );

  pmc006_eeprom #(
      .ClkHz (ClkHz),
      .I2cHz (I2cHz),
      .Device(Device)
  ) u_eeprom (
      .clk_i,
      .rst_ni,
      .fset_ni,
      .restore_i      (restore),
      .save_i         (save),
      .burn_i         (burn),
      .idle_o         (ee_idle),
      .failed_o       (ee_failed),
      .burning_o      (burning),
      .boot_o,
      .autostart_o    (autostart),
      .rst_settings_no(rst_settings_n),
      .settings_i     (settings_o),
      .control_i      (control),
      .load_o         (load),
      .load_op_o      (load_op),
      .load_wide_o    (load_wide),
      .store_o        (store),
      .legal_i        (legal),
      .claim_i        (claim),
      .byte_addr_o    (byte_addr),
      .we_o           (byte_we),
      .byte_o         (byte_written),
      .byte_i         (byte_read),
      .scl_i,
      .sda_i,
      .scl_oe_o,
      .sda_oe_o
  );

  // ---- motion ---------------------------------------------------------------------------------------------

  pmc006_start_check u_start_check (
      .clk_i,
      .rst_ni,
      .cmd_i       (cmd),
      .legal_i     (legal),
      .exec_i      (exec),
      .settings_i  (settings_o),
      .busy_i      (motion_i.busy),
      .locked_i    (|flags),
      .ext_event_i (ext_event),
      .stall_stop_i(stall_stop),
      .key_stop_i  (key_stop),
      .start_o     (motion_start_o.start),
      .run_o       (motion_start_o.run),
      .halt_o,
      .speed_o     (motion_start_o.speed),
      .speed_mode_o(speed_mode)
  );

  pmc006_position u_position (
      .clk_i,
      .rst_ni,
      .step_i,
      .forward_i(motion_i.forward),
      .set_i(set_position),
      .data_i(cmd.data),
      .mark_i(stall_mark),
      .pos_o(position),
      .stall_o(stall_position)
  );

  // ---- stop conditions, outputs, reply --------------------------------------------------------------------

  pmc006_ext_stop u_ext_stop (
      .clk_i,
      .rst_ni,
      .ext_i,
      .rising_i(control.trigm),
      .enable_i(control.exten),
      .clear_i ({exec && cmd.op == I_CLEAR2, exec && cmd.op == I_CLEAR1}),
      .event_o (ext_event),
      .flags_o (flags)
  );

  pmc006_stall u_stall (
      .clk_i,
      .rst_ni,
      .sample_i(bemf_i),
      .config_i(control.stcfg),
      .length_i(control.stlen),
      .limit_i (control.stlvl),
      .busy_i  (motion_i.busy),
      .steady_i(motion_i.steady),
      .start_i (motion_start_o.start || motion_start_o.run),
      .clear_i (exec && cmd.op == I_STALL),
      .stop_o  (stall_stop),
      .mark_o  (stall_mark),
      .stall_o (stall)
  );

  pmc006_ports u_ports (
      .clk_i,
      .rst_ni,
      .cmd_i(cmd),
      .write_i(write),
      .stall_pin_i(stall && control.stcfg[2]),
      .gpo_reg_o(gpo_reg),
      .gpo_o
  );

  assign accepted = program_accepted || save || burn || motion_start_o.start;

  pmc006_reply #(
      .Echo(Echo),
      .Version(Version)
  ) u_reply (
      .clk_i,
      .sample_i    (reply_sample),
      .cmd_i       (cmd),
      .accepted_i  (accepted_q),
      .value_i     (reg_value),
      .settings_i  (settings_o),
      .control_i   (control),
      .speed_mode_i(speed_mode),
      .busy_i      (motion_i.busy),
      .stall_i     (stall),
      .flags_i     (flags),
      .ext_i,
      .gpi_i,
      .gpo_i       (gpo_o),
      .gpo_reg_i   (gpo_reg),
      .pp_i        (pp),
      .pos_i       (position),
      .stpos_i     (stall_position),
      .word_i      (word),
      .ee_idle_i   (ee_idle),
      .ee_failed_i (ee_failed),
      .reply_o
  );

  always_ff @(posedge clk_i) accepted_q <= accepted;

  assign addr_o = control.addr;
  assign motion_start_o.count = cmd.data[30:0];
  assign pull_up_o = ~control.trigm;

endmodule

`default_nettype wire
