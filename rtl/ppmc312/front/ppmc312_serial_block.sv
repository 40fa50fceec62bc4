// SPDX-License-Identifier: Apache-2.0
// ppmc312_serial_block: converts an instruction received in serial mode to the equivalent block of the
//         parallel bus.
// Rules:  P312-SER-40..43, P312-GEN-04.
// Timing: data_o is combinational. size_o is valid from the last data byte on.
`default_nettype none

module ppmc312_serial_block
  import ppmc312_pkg::*;
  import ppmc312_serial_pkg::*;
(
    input wire logic clk_i,  // clock
    input wire serial_code_t info_i,  // meaning of the received code, stable
    // bytes for the write window
    input wire logic we_i,  // strobe: a byte
    input wire logic generated_i,  // 1: the byte is generated (header, length, code, flags), 0: received
    input wire logic [3:0] addr_i,  // position of the byte, 0 = header
    input wire logic [7:0] data_i,  // received byte
    output logic [7:0] data_o,  // byte for the window
    output logic [BLOCK_BITS:0] size_o  // bytes of the block, 2 .. 15
);

  localparam logic [3:0] FlagsAt = 4'd3;  // position of the first parameter
  localparam logic [3:0] InnerLenAt = 4'd5;  // position of the length byte of the embedded block
  localparam logic [BLOCK_BITS:0] InnerOverhead = 6'd6;  // bytes that the embedded length byte does not count
  localparam logic [BLOCK_BITS:0] InvalidSize = 6'd2;  // size that causes the error "size abnormality"

  logic [3:0] inner_q;
  logic too_long_q;

  always_ff @(posedge clk_i) begin
    if (we_i && !generated_i && addr_i == InnerLenAt) begin
      inner_q <= data_i[3:0];
      too_long_q <= data_i[7:4] != '0 || (data_i[3] && data_i[2:0] != '0);  // length above 8
    end
  end

  always_comb begin
    size_o = (BLOCK_BITS + 1)'(info_i.size);
    if (info_i.has_inner) size_o = too_long_q ? InvalidSize : (BLOCK_BITS + 1)'(inner_q) + InnerOverhead;
  end

  // Serial instruction 00 cannot set up a separate deceleration side, so bits 7:4 of its first parameter are
  // 0 (bit 4 is LE). The monitors of serial instructions 02 and 03 always continue after a report, so bit 1
  // (RES) of their first parameter is 1.
  always_comb begin
    data_o = data_i;
    if (generated_i) begin
      unique case (addr_i[1:0])
        2'd0:    data_o = 8'h03;
        2'd1:    data_o = 8'(size_o) - 8'd2;
        2'd2:    data_o = info_i.code;
        default: data_o = info_i.flags;
      endcase
    end else if (addr_i == FlagsAt) begin
      if (info_i.code == I_INIT) data_o[7:4] = '0;
      if (info_i.code inside {I_INPOS, I_ENCODE}) data_o[1] = 1'b1;
    end
  end

  logic unused_info;
  assign unused_info = &{1'b0, info_i};

endmodule

`default_nettype wire
