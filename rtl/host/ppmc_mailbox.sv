// SPDX-License-Identifier: Apache-2.0
// ppmc_mailbox: one input byte and a short output queue between a host port and a command unit.
// Rules:  P104-HSK-01/02 (input), P104-HSK-05/06/08 (output).
// Timing: a byte that is written with wr_i is valid on byte_o from the next cycle on. ready_o follows one
//         cycle later, so that the decoding of the byte may be registered. take_i may coincide with the wr_i
//         of another byte: then the old byte is accepted, and the new byte is stored. After rd_done_i, obf_o
//         is low for one cycle; then the next byte of the queue is valid.
`default_nettype none

module ppmc_mailbox #(
    parameter int unsigned QueueBytes = 3  // bytes of the longest read data; at least 3
) (
    input  wire logic                    clk_i,
    input  wire logic                    rst_ni,
    // host port
    input  wire logic                    wr_i,       // strobe: the host has written
    input  wire logic                    wr_a0_i,    // with wr_i; 1: command, 0: data
    input  wire logic [             7:0] wr_data_i,  // written byte; valid with wr_i
    input  wire logic                    rd_done_i,  // strobe: the host has read out_o
    output logic      [             7:0] out_o,      // output buffer
    output logic                         obf_o,      // 1: out_o has not been read yet
    output logic                         new_o,      // 1: out_o changes at the next edge
    output logic                         ibf_o,      // 1: an input byte is pending
    // command unit
    output logic                         ready_o,    // 1: byte_o is available
    output logic                         command_o,  // 1: byte_o was written as a command, 0: as data
    output logic      [             7:0] byte_o,     // byte written by the host
    input  wire logic                    take_i,     // strobe: byte_o is accepted
    input  wire logic                    load_i,     // strobe: load new read data; discard unread bytes
    input  wire logic [8*QueueBytes-1:0] answer_i,   // read data; first byte in bits 7:0
    input  wire logic                    long_i      // 1: answer_i has QueueBytes bytes, 0: one byte
);

  if (QueueBytes < 3) begin : g_check
    $fatal(1, "ppmc_mailbox: QueueBytes must be at least 3");
  end

  logic settled_q;

  assign ready_o = ibf_o && settled_q;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      ibf_o     <= 1'b0;
      settled_q <= 1'b0;
      command_o <= 1'b0;
      byte_o    <= '0;
    end else begin
      settled_q <= ibf_o && !wr_i;
      if (wr_i) begin
        ibf_o     <= 1'b1;
        command_o <= wr_a0_i;
        byte_o    <= wr_data_i;
      end else if (take_i) begin
        ibf_o <= 1'b0;
      end
    end
  end

  localparam int unsigned MoreBits = 8 * (QueueBytes - 1);
  logic [MoreBits-1:0] more_q;  // bytes after the current byte
  logic [QueueBytes-2:0] more_valid_q;  // [n]: byte n of more_q is valid
  logic next;

  assign next  = !obf_o && more_valid_q[0];
  assign new_o = load_i || next;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      out_o <= '0;
      obf_o <= 1'b0;
      more_q <= '0;
      more_valid_q <= '0;
    end else if (load_i) begin
      {more_q, out_o} <= answer_i;
      more_valid_q    <= {(QueueBytes - 1) {long_i}};
      obf_o           <= 1'b1;
    end else if (next) begin
      out_o <= more_q[7:0];
      more_q <= {more_q[MoreBits-1-:8], more_q[MoreBits-1:8]};
      more_valid_q <= more_valid_q >> 1;
      obf_o <= 1'b1;
    end else if (rd_done_i) begin
      obf_o <= 1'b0;
    end
  end

endmodule

`default_nettype wire
