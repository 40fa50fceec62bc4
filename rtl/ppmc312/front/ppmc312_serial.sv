// SPDX-License-Identifier: Apache-2.0
// ppmc312_serial: serial front end, a station on a line with one host. It receives frames, passes blocks to
//         the core and sends replies.
// Rules:  P312-SER-01..22, P312-PRT-01..03, P312-BAD-16/17.
// Timing: a character is received in the middle of its stop bit. See also ppmc312_serial_reply and
//         ppmc312_serial_tx.
// Rate:   a phase accumulator with an exact modulus generates the bit times. Baud rates: XTAL * {3/2500,
//         6/2500, 1/192}.
`include "ppmc_assert.svh"
`default_nettype none

module ppmc312_serial
  import ppmc312_pkg::*;
  import ppmc312_link_pkg::*;
  import ppmc312_serial_pkg::*;
#(
    parameter int unsigned ClkHz    = 16_000_000,
    parameter int unsigned XtalHz   = 16_000_000,
    parameter bit          CharsSum = 1'b0,
    parameter int unsigned SndLead  = 1,           // bits from the rise of snd_o to the start bit, 1 .. 16
    parameter int unsigned SndWait  = 0            // snd_o rises SndWait + 0.5 bits after a stop bit, 0 .. 8
) (
    input wire logic clk_i,  // clock
    input wire logic rst_ni,  // reset, asynchronous
    input wire logic ready_i,  // 0: received characters are ignored
    input wire logic enable_i,  // 0: nothing is received or sent
    input wire logic [1:0] rate_i,  // 1: 19 200, 2: 38 400, 3: 83 333 baud
    input wire logic [3:0] adr_i,  // station number
    // pins
    input wire logic rxd_i,  // line, asynchronous; idle high
    output logic txd_o,  // line, idle high
    output logic snd_o,  // 1: drive the line
    // blocks from the host
    output host_block_t host_block_o,  // block for the core
    output block_write_t block_write_o,  // byte for the write window
    // responses to these blocks
    input wire host_result_t host_result_i,  // result of the executed block
    output logic [BLOCK_BITS-1:0] rd_addr_o,  // byte of the response, 0 = header
    input wire logic [7:0] rd_data_i,  // byte at rd_addr_o, two cycles later
    // state and reports
    input wire status_e status_i,  // status of the device
    output logic report_take_o,  // strobe: the report in poll_result_i is consumed
    input wire poll_result_t poll_result_i  // report for the next poll
);

  // A bit lasts Modulus / step cycles.
  localparam longint unsigned Clk = 64'(ClkHz) * 64'd480_000;
  localparam longint unsigned Xtal = 64'(XtalHz) * 64'd4;
  localparam longint unsigned Common = ppmc_pkg::gcd(Clk, Xtal);
  // The modulus is even, so that the middle of a bit is exact.
  localparam longint unsigned Twice = ((Clk / Common) % 2 == 0) ? 64'd1 : 64'd2;
  localparam longint unsigned Modulus = Twice * Clk / Common;
  localparam longint unsigned Unit = Twice * Xtal / Common;
  localparam int unsigned Width = 32'($clog2(Modulus));
  localparam longint unsigned Rest = (64'd1 << Width) - Modulus;

  logic [Width-1:0] step, wrap;
  logic [7:0] char, code, data;
  logic valid, error, take_valid, framing, unused_break;
  logic generated, poll, run, fault, unknown_code, overrun, busy, send, sent;
  logic [1:0] index;
  logic we;
  logic [3:0] addr;
  logic [7:0] block_byte;
  serial_code_t info;  // meaning of code
  reply_t reply;

  always_comb begin
    unique case (rate_i)
      2'd3: begin
        step = Width'(64'd625 * Unit);
        wrap = Width'(64'd625 * Unit + Rest);
      end
      2'd2: begin
        step = Width'(64'd288 * Unit);
        wrap = Width'(64'd288 * Unit + Rest);
      end
      default: begin
        step = Width'(64'd144 * Unit);
        wrap = Width'(64'd144 * Unit + Rest);
      end
    endcase
  end

  ppmc_uart_rx #(
      .Width  (Width),
      .Modulus(Modulus)
  ) u_rx (
      .clk_i,
      .rst_ni,
      .step_i (step),
      .wrap_i (wrap),
      .rxd_i  (rxd_i || !enable_i),
      .byte_o (char),
      .valid_o(valid),
      .error_o(error),
      .break_o(unused_break)
  );

  assign take_valid = valid && ready_i;
  assign framing = error && ready_i;

  ppmc312_serial_code_rom u_code_rom (
      .clk_i,
      .code_i(code),
      .info_o(info)
  );

  ppmc312_serial_rx #(
      .ClkHz   (ClkHz),
      .XtalHz  (XtalHz),
      .CharsSum(CharsSum)
  ) u_rx_frame (
      .clk_i,
      .rst_ni,
      .adr_i,
      .byte_i        (char),
      .valid_i       (take_valid),
      .error_i       (framing),
      .busy_i        (busy),
      .code_o        (code),
      .info_i        (info),
      .we_o          (we),
      .generated_o   (generated),
      .addr_o        (addr),
      .data_o        (data),
      .poll_o        (poll),
      .run_o         (run),
      .fault_o       (fault),
      .unknown_code_o(unknown_code),
      .overrun_o     (overrun)
  );

  ppmc312_serial_block u_block (
      .clk_i,
      .info_i(info),
      .we_i(we),
      .generated_i(generated),
      .addr_i(addr),
      .data_i(data),
      .data_o(block_byte),
      .size_o(host_block_o.size)
  );

  assign block_write_o = '{we: we, addr: addr, data: block_byte};

  ppmc312_serial_reply u_reply (
      .clk_i,
      .rst_ni,
      .poll_i        (poll),
      .run_i         (run),
      .fault_i       (fault),
      .unknown_code_i(unknown_code),
      .code_i        (code),
      .info_i        (info),
      .framing_i     (framing),
      .overrun_i     (overrun),
      .busy_o        (busy),
      .status_i,
      .report_take_o,
      .poll_result_i,
      .blk_valid_o   (host_block_o.valid),
      .host_result_i,
      .send_o        (send),
      .reply_o       (reply),
      .sent_i        (sent)
  );

  // The response to I_POS (position read) repeats parameter s, which selects the position, before the value.
  // The reply omits this byte.
  assign rd_addr_o = BLOCK_BITS'(index) + ((info.code == I_POS) ? 5'd4 : 5'd3);

  ppmc312_serial_tx #(
      .Width   (Width),
      .CharsSum(CharsSum),
      .SndLead (SndLead),
      .SndWait (SndWait)
  ) u_tx (
      .clk_i,
      .rst_ni,
      .adr_i,
      .step_i(step),
      .wrap_i(wrap),
      .rx_char_i(take_valid || framing),
      .send_i(send),
      .reply_i(reply),
      .index_o(index),
      .response_byte_i(rd_data_i),
      .sent_o(sent),
      .txd_o,
      .snd_o
  );

`ifndef SYNTHESIS
  `PPMC_ASSERT(p312_bad_17, enable_i || !snd_o)
  `PPMC_ASSERT(p312_prt_02, ready_i || !busy)
`endif

endmodule

`default_nettype wire
