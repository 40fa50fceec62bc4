// SPDX-License-Identifier: Apache-2.0
// ppmc_host_port: host interface of a core. Contains the bus front end and the mailbox.
// Rules:  P104-BUS-01..07, P104-STA-01..03, P104-HSK-01..08.
// Timing: see ppmc_strobe_bus and ppmc_mailbox.
`default_nettype none

module ppmc_host_port #(
    parameter int unsigned QueueBytes = 3
) (
    input wire logic clk_i,
    input wire logic rst_ni,
    input wire logic style_i,  // 0: read and write strobe, 1: data strobe and direction
    // pins
    input wire logic cs_ni,  // chip select
    input wire logic rd_ni,  // read strobe, or direction
    input wire logic wr_ni,  // write strobe, or data strobe
    input wire logic a0_i,  // 0: data, 1: status or command
    input wire logic [7:0] d_i,  // data written by the host
    output logic [7:0] d_o,  // data read by the host
    output logic d_oe_o,  // 1: drive d_o, because the host reads
    // command unit
    input wire logic [5:0] state_i,  // status bits 7:2; bits 1 and 0 are IBF and OBF
    output logic ready_o,  // 1: byte_o is available
    output logic command_o,  // 1: byte_o was written as a command, 0: as data
    output logic [7:0] byte_o,  // byte written by the host
    input wire logic take_i,  // strobe: byte_o is accepted
    input wire logic load_i,  // strobe: load new read data
    input wire logic long_i,  // 1: answer_i has QueueBytes bytes, 0: one byte
    input wire logic [8*QueueBytes-1:0] answer_i  // read data; first byte in bits 7:0
);

  logic wr, wr_a0, wr_busy, rd_busy, rd_done, ibf, obf, fresh;
  logic [7:0] wr_data, out;

  ppmc_strobe_bus u_bus (
      .clk_i,
      .rst_ni,
      .style_i,
      .cs_ni,
      .rd_ni,
      .wr_ni,
      .a0_i,
      .d_i,
      .d_o,
      .d_oe_o,
      .wr_o        (wr),
      .wr_a0_o     (wr_a0),
      .wr_data_o   (wr_data),
      .wr_busy_o   (wr_busy),
      .status_i    ({state_i, ibf || wr_busy, obf && !rd_busy}),
      .data_i      (out),
      .data_valid_i(obf),
      .data_new_i  (fresh),
      .rd_busy_o   (rd_busy),
      .rd_done_o   (rd_done)
  );

  ppmc_mailbox #(
      .QueueBytes(QueueBytes)
  ) u_mailbox (
      .clk_i,
      .rst_ni,
      .wr_i     (wr),
      .wr_a0_i  (wr_a0),
      .wr_data_i(wr_data),
      .rd_done_i(rd_done),
      .out_o    (out),
      .obf_o    (obf),
      .new_o    (fresh),
      .ibf_o    (ibf),
      .ready_o,
      .command_o,
      .byte_o,
      .take_i,
      .load_i,
      .answer_i,
      .long_i
  );

endmodule

`default_nettype wire
