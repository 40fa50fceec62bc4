// SPDX-License-Identifier: Apache-2.0
// pmc006_page: memory map of the EEPROM. For an address, it returns the byte to be sent or expected, and
//         the instruction that loads the parameter at this address. Also computes the check sum.
// Rules:  P006-EEP-10/11/22, P006-BAD-14/15; memory map, factory page: docs/pmc006/README.md, 14.
// Timing: byte_o and mismatch_o are combinational. When the low byte of a pair is sent, the high byte is
//         stored, so that both bytes are from the same value of the register.
`default_nettype none

module pmc006_page
  import pmc006_pkg::*;
(
    input wire logic clk_i,
    input wire logic rst_ni,
    input wire logic [9:0] addr_i,  // address in the EEPROM
    input wire logic byte_sent_i,  // strobe: byte_o is sent
    input wire logic byte_received_i,  // strobe: received_i is valid
    input wire logic [7:0] received_i,  // received byte
    input wire logic clear_i,  // 1: clear the check sum
    input wire logic burn_i,  // 1: the program is being written, 0: the parameters
    input wire logic mark_i,  // 1: write the program mark as 00 (invalid)
    input wire logic [7:0] prefetch_i,  // byte of the program, prefetched from the buffer
    input wire logic factory_i,  // 1: factory values, 0: values of the registers
    input wire motor_settings_t settings_i,  // parameter registers
    input wire control_settings_t control_i,  // settings used only by the control
    output logic [7:0] byte_o,  // byte to be sent or expected
    output logic mismatch_o,  // strobe: received_i differs from byte_o at a checked address
    output logic [7:0] op_o,  // instruction that loads the byte or pair; I_NONE: no instruction
    output logic wide_o  // data of op_o, 1: two bytes, 0: one byte
);

  typedef struct packed {
    logic [15:0] pair;    // pair of bytes (one register) at this offset
    logic [7:0]  single;  // byte at this offset, if not part of a pair
  } page_field_t;

  // Contents of the parameter page at an offset.
  function automatic page_field_t page_field(motor_settings_t set, control_settings_t ctl,
                                             logic [4:0] offset);
    page_field_t f;
    logic unused_bits;
    unused_bits = &{1'b0, set, ctl};
    unique case (offset[4:1])
      4'h6:    f.pair = 16'(set.vstart);
      4'h7:    f.pair = 16'(set.vstop);
      4'h8:    f.pair = 16'(set.ccomp);
      4'h9:    f.pair = 16'(set.scomp);
      4'ha:    f.pair = 16'(set.cur);
      default: f.pair = 16'd0;
    endcase
    unique case (offset)
      5'h03:   f.single = ctl.addr;
      5'h04:   f.single = set.mstep;
      5'h06:   f.single = 8'(set.acc);
      5'h07:   f.single = 8'(set.dec);
      5'h08:   f.single = 8'(set.autodec);
      5'h09:   f.single = 8'(set.att);
      5'h0a:   f.single = 8'(ctl.trigm);
      5'h0b:   f.single = 8'(ctl.offline);
      default: f.single = 8'd0;
    endcase
    return f;
  endfunction

  page_field_t field;
  logic [4:0] offset;
  logic [7:0] page, high_q;
  logic [15:0] sum_q;
  logic in_trailer, is_checked;

  assign offset = addr_i[4:0];
  assign in_trailer = addr_i[9:8] == 2'b11 && addr_i[6];  // addresses after the program
  assign field = factory_i ? page_field(
      SETTINGS_RESET, CONTROL_RESET, offset
  ) : page_field(
      settings_i, control_i, offset
  );

  always_comb begin
    unique case (offset)
      5'h00: page = 8'h50;
      5'h01: page = 8'h36;
      5'h02: page = 8'h01;
      5'h03, 5'h04, 5'h06, 5'h07, 5'h08, 5'h09, 5'h0a, 5'h0b: page = field.single;
      5'h1f: page = sum_q[7:0];
      default: page = offset[0] ? high_q : field.pair[7:0];
    endcase
  end

  always_comb begin
    byte_o = burn_i ? prefetch_i : page;
    if (in_trailer) begin
      unique case (offset[1:0])
        2'd0:    byte_o = sum_q[7:0];
        2'd1:    byte_o = sum_q[15:8];
        default: byte_o = mark_i ? 8'h00 : 8'h5a;
      endcase
    end
    is_checked = in_trailer || addr_i inside {10'h000, 10'h001, 10'h002, 10'h01f};
    mismatch_o = byte_received_i && is_checked && received_i != byte_o;
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) sum_q <= '0;
    else if (clear_i) sum_q <= '0;
    else if ((byte_sent_i || byte_received_i) && !in_trailer)
      sum_q <= sum_q + {8'd0, byte_received_i ? received_i : byte_o};
  end

  always_ff @(posedge clk_i) if (byte_sent_i) high_q <= field.pair[15:8];

  always_comb begin
    unique case (offset)
      5'h03:   op_o = I_ADDR;
      5'h04:   op_o = I_MSTEP;
      5'h06:   op_o = I_ACC;
      5'h07:   op_o = I_DEC;
      5'h08:   op_o = I_AUTODEC;
      5'h09:   op_o = I_ATT;
      5'h0a:   op_o = I_TRIGGER;
      5'h0b:   op_o = I_OFFLINE;
      5'h0c:   op_o = I_VSTART;
      5'h0e:   op_o = I_VSTOP;
      5'h10:   op_o = I_CCOMP;
      5'h12:   op_o = I_SCOMP;
      5'h14:   op_o = I_CURRENT;
      default: op_o = I_NONE;
    endcase
    wide_o = offset >= 5'h0c;
  end

endmodule

`default_nettype wire
