// SPDX-License-Identifier: Apache-2.0
// spi_host: an SPI master in mode 0 that drives a PPMC-104 through ppmc_spi; 8 cycles per period of sck.
`default_nettype none

module spi_host (
    input  wire logic clk,
    input  wire logic rst_n,
    output logic      done    // 1: the session has passed
);

  localparam int HalfCycles = 4;  // half a period of sck in cycles; sck must be low for more than 3

  logic sck = 1'b0, mosi = 1'b0, ss_n = 1'b1;
  logic miso, irq, hold, pout_n, dir;
  logic [5:1] s;

  // ---- bridge and device -----------------------------------------------------------------------------

  logic rst_core_n, a0, cs_n, rd_n, wr_n, int_n;
  logic [7:0] to_part, from_part;

  assign irq = !int_n;

  ppmc_reset u_reset (
      .clk_i (clk),
      .rst_ni(rst_n),
      .rst_no(rst_core_n)
  );

  ppmc_spi #(
      .AddrBits(1)
  ) u_bridge (
      .clk_i    (clk),
      .rst_ni   (rst_core_n),
      .sck_i    (sck),
      .mosi_i   (mosi),
      .cs_ni    (ss_n),
      .miso_o   (miso),
      .miso_oe_o(),
      .active_o (),
      .cs_no    (cs_n),
      .rd_no    (rd_n),
      .wr_no    (wr_n),
      .a_o      (a0),
      .d_o      (to_part),
      .d_i      (from_part),
      .int_ni   (int_n)
  );

  ppmc104 u_part (
      .clk,
      .rst_n(rst_core_n),
      .a0,
      .cs_n,
      .rd_n,
      .wr_n,
      .d_i  (to_part),
      .d_o  (from_part),
      .d_oe (),
      .int_n,
      .csel (1'b1),
      .vsel (1'b1),
      .clock(1'b0),
      .l1_n (1'b1),
      .l2_n (1'b1),
      .l3_n (1'b1),
      .l4_n (1'b1),
      .cnp_n(1'b1),
      .alm_n(1'b1),
      .auxi (4'b0000),
      .auxo (),
      .aux_n(),
      .s,
      .hold,
      .pout_n,
      .dir
  );

  // ---- SPI master: mosi changes when sck falls, miso is sampled when sck rises --------------------------

  task automatic exchange(input logic [7:0] value, output logic [7:0] answer);
    for (int i = 7; i >= 0; i--) begin
      sck  = 1'b0;
      mosi = value[i];
      repeat (HalfCycles) @(negedge clk);
      answer[i] = miso;
      sck       = 1'b1;
      repeat (HalfCycles) @(negedge clk);
    end
    sck = 1'b0;
  endtask

  // The first two bytes of a frame. Bits 7 .. 4 of the status are 1000; FAST, CUT and REFUSED must be 0.
  task automatic header(input logic write, input logic register);
    logic [7:0] status, unused;
    ss_n = 1'b0;
    exchange({write, 7'b0}, status);
    check(status[7:1] == 7'b1000_000, $sformatf("status byte %h of the bridge", status));
    exchange({7'b0, register}, unused);
  endtask

  task automatic end_frame();
    repeat (HalfCycles) @(negedge clk);
    ss_n = 1'b1;
    repeat (HalfCycles) @(negedge clk);
  endtask

  task automatic write_reg(input logic register, input logic [7:0] value);
    logic [7:0] unused;
    header(1'b1, register);
    exchange(value, unused);
    end_frame();
  endtask

  // Byte FF requests one read. The next byte, 00, requests no read and returns the value that was read.
  task automatic read_reg(input logic register, output logic [7:0] value);
    logic [7:0] unused;
    header(1'b0, register);
    exchange(8'hFF, unused);
    exchange(8'h00, value);
    end_frame();
  endtask

  `include "session.svh"

endmodule

`default_nettype wire
