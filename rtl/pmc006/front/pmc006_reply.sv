// SPDX-License-Identifier: Apache-2.0
// pmc006_reply: selects the data of a reply. The data are the values that are active after the instruction.
// Rules:  P006-CMD-01..57, P006-FRM-09; reply data: docs/pmc006/README.md, 4; status words: 5, 12.
// Timing: reply_o follows sample_i by one cycle. sample_i is one cycle after the instruction takes effect.
`default_nettype none

module pmc006_reply
  import pmc006_pkg::*;
#(
    parameter bit          Echo    = 1'b0,          // 1: the reply to instruction s contains the data of s
    parameter logic [31:0] Version = 32'h0000_0123
) (
    input wire logic clk_i,
    input wire logic sample_i,  // strobe: sample the reply data
    input wire exec_cmd_t cmd_i,  // the instruction
    input wire logic accepted_i,  // 1: the instruction (s, t, B, E, W, G, z) was accepted
    input wire logic [13:0] value_i,  // value of the register of cmd_i, 0 if none; valid after sample_i
    input wire motor_settings_t settings_i,  // parameter registers
    input wire control_settings_t control_i,  // settings used only by the control
    input wire logic speed_mode_i,  // register SPEED_MODE
    input wire logic busy_i,  // 1: a motion is in progress
    input wire logic stall_i,  // register STALL
    input wire logic [1:0] flags_i,  // EXT flags, [0]: EXT1
    input wire logic [1:0] ext_i,  // pins EXT1, EXT2, synchronised
    input wire logic [4:0] gpi_i,  // general inputs, synchronised
    input wire logic [4:0] gpo_i,  // pins of the general outputs
    input wire logic [4:0] gpo_reg_i,  // register GPO
    input wire logic [7:0] pp_i,  // pointer PP of the user program
    input wire logic [31:0] pos_i,  // position
    input wire logic [31:0] stpos_i,  // position of the last stall
    input wire logic [31:0] word_i,  // word of the user program
    input wire logic ee_idle_i,  // EEPROM, 1: no operation in progress
    input wire logic ee_failed_i,  // EEPROM, 1: the last operation failed
    output logic [31:0] reply_o  // data of the reply
);

  logic [31:0] wide, reply_q;
  logic [13:0] narrow;
  logic unused_bits;

  assign unused_bits = &{1'b0, cmd_i, settings_i, control_i};

  // wide: replies that may have more than 14 bits; narrow: all other replies
  always_comb begin
    unique case (cmd_i.op)
      I_ABORT, I_POS_SET: wide = cmd_i.data;
      I_STEP: wide = !accepted_i ? 32'd0 : Echo ? cmd_i.data : 32'd3;
      I_PUT: wide = accepted_i ? cmd_i.data : 32'd0;
      I_GET: wide = accepted_i ? word_i : 32'd0;
      I_POS: wide = pos_i;
      I_STPOS: wide = stpos_i;
      I_VERSION: wide = Version;
      default: wide = 32'd0;
    endcase
  end

  always_comb begin
    unique case (cmd_i.op)
      I_POINTER: narrow = 14'(pp_i);
      I_BURN, I_TRY, I_SAVE, I_START: narrow = 14'(accepted_i);
      I_STORED: narrow = 14'({ee_failed_i && ee_idle_i, !ee_idle_i});
      I_RUN: narrow = 14'(speed_mode_i);
      I_STATUS2:
      narrow = 14'({control_i.offline, settings_i.dir, speed_mode_i, control_i.exten, settings_i.free});
      I_STATUS1: narrow = 14'({stall_i, settings_i.autodec, flags_i, busy_i});
      I_PORTS: narrow = 14'({ext_i, gpi_i[4:3], gpo_i, gpi_i[2:0]});
      I_OUT: narrow = 14'({gpo_reg_i, 3'd0});
      default: narrow = 14'd0;
    endcase
  end

  always_ff @(posedge clk_i) if (sample_i) reply_q <= wide | 32'(narrow);

  // The reply is either reply_q or value_i. The value that is not used is 0.
  assign reply_o = reply_q | 32'(value_i);

endmodule

`default_nettype wire
