// SPDX-License-Identifier: Apache-2.0
// pmc006_control: all logic between the line to the host and the motor: executor, registers, user program,
// EEPROM, stop conditions.
// Rules:  sections 3, 4, 7, 12 and 13, through its blocks.
// Timing: launch_o and halt_o are combinational, in the cycle before the edge on which BUSY changes.
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
    input  wire logic           clk_i,
    input  wire logic           rst_ni,
    input  wire logic           us_i,        // strobe every microsecond
    output logic                boot_o,      // the device is booting
    // host
    input  wire frame_t         frame_i,     // frame to be executed
    output logic         [31:0] reply_o,     // data of the reply
    output logic         [ 7:0] addr_o,      // address of the device
    // pins, inputs synchronised
    input  wire logic           fset_ni,     // factory settings
    input  wire logic    [ 1:0] ext_i,       // EXT1, EXT2
    input  wire logic    [ 4:0] gpi_i,       // general inputs
    output logic         [ 1:0] pull_up_o,   // pull-ups of EXT1, EXT2
    output logic         [ 4:0] gpo_o,       // general outputs
    input  wire sample_t        bemf_i,      // back EMF
    input  wire logic           scl_i,       // clock of the EEPROM bus
    input  wire logic           sda_i,       // data of the EEPROM bus
    output logic                scl_oe_o,    // 1: pull the clock low
    output logic                sda_oe_o,    // 1: pull the data low
    // motion
    output settings_t           settings_o,  // settings used by motion and drive
    output launch_t             launch_o,    // start of a motion
    output logic                halt_o,      // stop immediately
    input  wire motion_t        motion_i,    // state of the motion
    input  wire logic           step_i       // a step is made at the next rising edge
);

  order_t order;
  access_t access;
  logic [13:0] value;
  control_t control;
  logic next, cancel, begins, claim, second, trial, tries;
  logic load, load_wide, store, legal, act, place, take, write, took, took_q;
  logic put, program_took, burning, autostart, byte_we, key_stop;
  logic free, failed, save, burn, mode, stall, ext_event, stall_stop, stall_mark;
  logic rst_set, restore, unused_armed;
  logic [1:0] flags;
  logic [4:0] out;
  logic [7:0] load_op, byte_read, byte_written, word_at, pp;
  logic [ 9:0] byte_at;
  logic [15:0] pair;
  logic [31:0] word, position, stall_position;

  // ---- executor, registers --------------------------------------------------------------------------------

  pmc006_exec u_exec (
      .clk_i,
      .rst_ni,
      .frame_i,
      .next_i     (next),
      .cancel_i   (cancel),
      .begin_o    (begins),
      .claim_o    (claim),
      .second_o   (second),
      .trial_o    (trial),
      .word_i     (word),
      .load_i     (load),
      .load_op_i  (load_op),
      .load_data_i({load_wide ? pair[15:8] : 8'd0, pair[7:0]}),
      .store_i    (store),
      .order_o    (order),
      .access_o   (access),
      .legal_o    (legal),
      .act_o      (act),
      .place_o    (place),
      .step_i,
      .try_i      (tries),
      .reply_o    (take)
  );

  assign write = act && legal;

  pmc006_settings u_settings (
      .clk_i,
      .rst_ni   (rst_set),
      .order_i  (order),
      .access_i (access),
      .write_i  (write),
      .take_i   (take),
      .settings_o,
      .control_o(control),
      .value_o  (value)
  );

  // ---- user program ---------------------------------------------------------------------------------------

  pmc006_program u_program (
      .clk_i,
      .rst_ni,
      .autostart_i(autostart),
      .order_i    (order),
      .legal_i    (legal),
      .act_i      (act),
      .begin_i    (begins),
      .next_o     (next),
      .cancel_o   (cancel),
      .second_i   (second),
      .trial_i    (trial),
      .word_at_o  (word_at),
      .try_o      (tries),
      .put_o      (put),
      .took_o     (program_took),
      .burning_i  (burning),
      .pp_o       (pp),
      .us_i,
      .stop_o     (key_stop),
      .gpi_i,
      .flags_i    (flags),
      .busy_i     (motion_i.busy),
      .stall_i    (stall)
  );

  pmc006_buffer u_buffer (
      .clk_i,
      .claim_i  (claim),
      .word_at_i(word_at),
      .put_i    (put),
      .data_i   (order.data),
      .word_o   (word),
      .byte_at_i(byte_at),
      .we_i     (byte_we),
      .byte_i   (byte_written),
      .byte_o   (byte_read),
      .pair_o   (pair)
  );

  // ---- EEPROM ---------------------------------------------------------------------------------------------

  assign save = act && order.op == I_SAVE && free;
  assign burn = act && order.op == I_BURN && free;

  pmc006_debounce #(
      .LowTicks (20_001),
      .HighTicks(0),
      .Armed    (1'b1)
  ) u_fset (
      .clk_i,
      .rst_ni,
      .us_i,
      .pin_i  (fset_ni),
      .hit_o  (restore),
      .armed_o(unused_armed)
  );

  pmc006_eeprom #(
      .ClkHz (ClkHz),
      .I2cHz (I2cHz),
      .Device(Device)
  ) u_eeprom (
      .clk_i,
      .rst_ni,
      .fset_ni,
      .restore_i  (restore),
      .save_i     (save),
      .burn_i     (burn),
      .free_o     (free),
      .failed_o   (failed),
      .burning_o  (burning),
      .boot_o,
      .autostart_o(autostart),
      .rst_set_no (rst_set),
      .settings_i (settings_o),
      .control_i  (control),
      .load_o     (load),
      .load_op_o  (load_op),
      .load_wide_o(load_wide),
      .store_o    (store),
      .legal_i    (legal),
      .claim_i    (claim),
      .byte_at_o  (byte_at),
      .we_o       (byte_we),
      .byte_o     (byte_written),
      .byte_i     (byte_read),
      .scl_i,
      .sda_i,
      .scl_oe_o,
      .sda_oe_o
  );

  // ---- motion ---------------------------------------------------------------------------------------------

  pmc006_start_check u_accept (
      .clk_i,
      .rst_ni,
      .order_i   (order),
      .legal_i   (legal),
      .act_i     (act),
      .settings_i(settings_o),
      .busy_i    (motion_i.busy),
      .locked_i  (|flags),
      .ext_i     (ext_event),
      .stall_i   (stall_stop),
      .key_i     (key_stop),
      .start_o   (launch_o.start),
      .run_o     (launch_o.run),
      .halt_o,
      .speed_o   (launch_o.speed),
      .mode_o    (mode)
  );

  pmc006_position u_position (
      .clk_i,
      .rst_ni,
      .step_i,
      .forward_i(motion_i.forward),
      .set_i(place),
      .data_i(order.data),
      .mark_i(stall_mark),
      .pos_o(position),
      .stall_o(stall_position)
  );

  // ---- guards, ports, answer ------------------------------------------------------------------------------

  pmc006_ext_stop u_guard (
      .clk_i,
      .rst_ni,
      .ext_i,
      .rising_i(control.trigm),
      .enable_i(control.exten),
      .clear_i ({act && order.op == I_CLEAR2, act && order.op == I_CLEAR1}),
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
      .start_i (launch_o.start || launch_o.run),
      .clear_i (act && order.op == I_STALL),
      .stop_o  (stall_stop),
      .mark_o  (stall_mark),
      .stall_o (stall)
  );

  pmc006_ports u_ports (
      .clk_i,
      .rst_ni,
      .order_i(order),
      .write_i(write),
      .pull_i (stall && control.stcfg[2]),
      .out_o  (out),
      .gpo_o
  );

  assign took = program_took || save || burn || launch_o.start;

  pmc006_reply #(
      .Echo(Echo),
      .Version(Version)
  ) u_answer (
      .clk_i,
      .take_i    (take),
      .order_i   (order),
      .took_i    (took_q),
      .value_i   (value),
      .settings_i(settings_o),
      .control_i (control),
      .speed_i   (mode),
      .busy_i    (motion_i.busy),
      .stall_i   (stall),
      .flags_i   (flags),
      .ext_i,
      .gpi_i,
      .gpo_i     (gpo_o),
      .out_i     (out),
      .pp_i      (pp),
      .pos_i     (position),
      .stpos_i   (stall_position),
      .word_i    (word),
      .free_i    (free),
      .failed_i  (failed),
      .reply_o
  );

  always_ff @(posedge clk_i) took_q <= took;

  assign addr_o = control.addr;
  assign launch_o.count = order.data[30:0];
  assign pull_up_o = ~control.trigm;

endmodule

`default_nettype wire
