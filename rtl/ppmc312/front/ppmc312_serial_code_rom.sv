// SPDX-License-Identifier: Apache-2.0
// ppmc312_serial_code_rom: translates an instruction code of the serial mode to the code of the parallel
//         bus.
// Rules:  P312-SER-40..44.
// Timing: latency 2 cycles, because the slow block RAM has an output register.
// How:    look-up table in a block RAM. The function `meaning` computes its contents.
`default_nettype none

module ppmc312_serial_code_rom
  import ppmc312_pkg::*;
  import ppmc312_serial_pkg::*;
(
    input  wire logic          clk_i,   // clock
    input  wire logic    [7:0] code_i,  // received code
    output serial_code_t       info_o   // meaning of code_i, two cycles later
);

  function automatic serial_code_t meaning(logic [7:0] code);
    serial_code_t info;
    logic position;
    logic [3:0] bytes;  // data bytes received after the code
    logic [7:0] dir_flag, trigger;
    position      = code[5:4] == 2'b01;
    dir_flag      = {1'b0, code[5], 6'd0};  // flag DIR
    trigger       = {5'd0, code[5:4] != 2'b00, code[5] && code[4], code[5]};  // flags OV and TRG
    info          = '0;
    info.is_known = 1'b1;
    info.code     = code;
    bytes         = 4'd0;
    unique case (code)
      I_INIT:                                                                bytes = 4'd8;
      I_INPOS, I_ENCODE:                                                     bytes = 4'd3;
      I_LOCK_POS:                                                            bytes = 4'd4;
      I_LIMIT:                                                               bytes = 4'd2;
      I_END, I_AUX_OUT:                                                      bytes = 4'd1;
      I_EXC_ON, I_EXC_OFF, I_CCLR, I_CLAMP, I_ACLR, I_LOCK, I_SYNC, I_RESET: ;
      I_AUX_IN:                                                              info.reply_bytes = 3'd1;
      I_PINS:                                                                info.reply_bytes = 3'd2;
      I_STATUS:                                                              info.reply_bytes = 3'd3;
      I_MASK: begin
        bytes = 4'd1;
        info.has_flags = 1'b1;
        info.flags = 8'h01;  // RES: monitoring continues after a report
      end
      S_END, S_ERROR, S_COUNTS:                                              info.local_read = 1'b1;
      8'h41: begin
        info.code = I_VERSION;
        info.reply_bytes = 3'd1;
      end
      8'h42, 8'h62: begin
        info.code = I_POS;
        info.reply_bytes = 3'd4;
        info.has_flags = 1'b1;
        info.flags = {7'd0, code[5]};
      end
      8'h43, 8'h63: begin
        info.code = I_POS_SET;
        bytes = 4'd4;
        info.has_flags = 1'b1;
        info.flags = {7'd0, code[5]};
      end
      8'h49, 8'h59, 8'h69, 8'h79: begin
        info.code = I_EVT_SET;
        info.has_inner = !code[5];
        bytes = code[5] ? 4'd0 : 4'd10;
        info.has_flags = 1'b1;
        info.flags = {6'd0, code[5], code[4]};
      end
      8'h80, 8'h90, 8'ha0, 8'hb0, 8'h81, 8'h91, 8'ha1, 8'hb1: begin
        bytes = position ? 4'd4 : 4'd0;
        info.code = {7'h40, code[0]};
        info.has_flags = 1'b1;
        info.flags = trigger;
      end
      8'h89, 8'h99, 8'ha9, 8'hb9, 8'h8a, 8'h9a, 8'haa, 8'hba: begin
        bytes = position ? 4'd6 : 4'd2;
        info.code = code[0] ? I_RAMP : I_SPEED;
        info.has_flags = 1'b1;
        info.flags = trigger;
      end
      8'h82, 8'ha2: begin
        info.code = I_STEP;
        info.has_flags = 1'b1;
        info.flags = dir_flag;
      end
      8'h83, 8'ha3, 8'h84, 8'ha4: begin
        bytes = 4'd6;
        info.code = code[2] ? I_CONST : I_MOVE;
        info.has_flags = 1'b1;
        info.flags = dir_flag;
      end
      8'h85, 8'ha5, 8'h86, 8'ha6: begin
        bytes = 4'd2;
        info.code = code[1] ? I_HIGH : I_CONT;
        info.has_flags = 1'b1;
        info.flags = dir_flag;
      end
      8'h87, 8'h97, 8'ha7, 8'hb7, 8'h88, 8'h98, 8'ha8, 8'hb8: begin
        bytes = 4'd2;
        info.code = code[3] ? I_ZERO : I_ORIGIN;
        info.has_flags = 1'b1;
        info.flags = dir_flag | {3'd0, code[4], 4'd0};  // flag IDX
      end
      default:                                                               info.is_known = 1'b0;
    endcase
    info.size = 4'd3 + 4'(info.has_flags) + bytes;
    return info;
  endfunction

  // The table is a constant, because synthesis evaluates the branches of `meaning` wrongly in an initial
  // block.
  function automatic serial_code_t [255:0] every_code();
    serial_code_t [255:0] words;
    for (int unsigned i = 0; i < 256; i++) words[8'(i)] = meaning(8'(i));
    return words;
  endfunction

  localparam serial_code_t [255:0] Words = every_code();

  (* rom_style = "block" *)
  serial_code_t rom[256];
  serial_code_t word_q;

  initial for (int unsigned i = 0; i < 256; i++) rom[i] = Words[8'(i)];

  always_ff @(posedge clk_i) begin
    word_q <= rom[code_i];
    info_o <= word_q;
  end

endmodule

`default_nettype wire
