// SPDX-License-Identifier: Apache-2.0
// pmc006_frame: assembles received bytes into frames of eight bytes, and checks address and sum.
// Rules:  P006-FRM-01/02/04/06/08, P006-UART-03, P006-BAD-01..05.
// Timing: frame_o.go is combinational: it is high in the cycle of valid_i of the last byte. frame_o.code
//         and frame_o.data are valid from this cycle until a byte of the next frame is received.
`include "ppmc_assert.svh"
`default_nettype none

module pmc006_frame
  import pmc006_pkg::frame_t;
(
    input  wire logic       clk_i,
    input  wire logic       rst_ni,
    input  wire logic [7:0] addr_i,     // address of the device
    input  wire logic [7:0] byte_i,     // received byte; valid with valid_i
    input  wire logic       valid_i,    // strobe: a byte has been received
    input  wire logic       error_i,    // strobe: framing error
    input  wire logic       timeout_i,  // 1: the next byte begins a new frame (silence on the line)
    output frame_t          frame_o     // valid frame for this device
);

  localparam logic [7:0] HeadByte = 8'ha5;

  logic [2:0] index_q, index;
  logic addr_match_q;
  logic [7:0] sum_q, code_q;
  logic [31:0] data_q;

  assign index = timeout_i ? 3'd0 : index_q;
  assign frame_o = '{
          go: valid_i && index == 3'd7 && addr_match_q && byte_i == sum_q,
          code: code_q,
          data: data_q
      };

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) index_q <= '0;
    else if (error_i) index_q <= '0;
    else if (valid_i) index_q <= (index == '0 && byte_i != HeadByte) ? 3'd0 : index + 1'b1;
  end

  always_ff @(posedge clk_i) begin
    if (valid_i) begin
      sum_q <= byte_i + ((index == '0) ? 8'd0 : sum_q);
      if (index == 3'd1) addr_match_q <= byte_i == addr_i;
      if (index == 3'd2) code_q <= byte_i;
      if (index inside {[3'd3 : 3'd6]}) data_q <= {byte_i, data_q[31:8]};
    end
  end

`ifndef SYNTHESIS
  `PPMC_ASSERT(p006_frm_02, !frame_o.go || !error_i)
`endif

endmodule

`default_nettype wire
