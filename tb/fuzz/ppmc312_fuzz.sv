// SPDX-License-Identifier: Apache-2.0
// ppmc312_fuzz: the deframer of the PPMC-312 in serial mode, with the table of its codes and address 5, for
// tb/fuzz/main.cpp.
// The first (highest) byte of what_o is 1 for a poll; 2 for an instruction, followed by the code, the number
// of data bytes and the digest of the data; 3 for a wrong checksum; 4 for an unknown code, followed by the
// code.
`default_nettype none

module ppmc312_fuzz
  import ppmc312_serial_pkg::*;
#(
    parameter bit CharsSum = 1'b0
) (
    input  wire logic        clk_i,
    input  wire logic        rst_ni,
    input  wire logic [ 7:0] byte_i,     // character
    input  wire logic        valid_i,    // strobe: byte_i was received with a stop bit
    input  wire logic        error_i,    // strobe: byte_i was received without a stop bit
    input  wire logic        silence_i,  // 1 during silence
    output logic             event_o,    // strobe: an event
    output logic      [63:0] what_o      // description of the event
);

  serial_code_t info;
  logic [7:0] code, data;
  logic we, generated, poll, run, fault, unknown_code, overrun;
  logic [ 3:0] addr;
  logic [15:0] count_q;
  logic [31:0] digest_q;

  // At this clock rate, 20 cycles are 20 ms.
  ppmc312_serial_rx #(
      .ClkHz   (1_000),
      .CharsSum(CharsSum)
  ) dut (
      .clk_i,
      .rst_ni,
      .adr_i         (4'd5),
      .byte_i,
      .valid_i,
      .error_i,
      .busy_i        (1'b0),
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

  ppmc312_serial_code_rom u_code_rom (
      .clk_i,
      .code_i(code),
      .info_o(info)
  );

  assign event_o = poll || run || fault || unknown_code;
  always_comb begin
    what_o = {8'd1, 56'd0};
    if (run) what_o = {8'd2, code, count_q, digest_q};
    else if (fault) what_o = {8'd3, 56'd0};
    else if (unknown_code) what_o = {8'd4, code, 48'd0};
  end

  always_ff @(posedge clk_i) begin
    if (valid_i && byte_i[7]) {count_q, digest_q} <= '0;
    else if (we && !generated) begin
      count_q  <= count_q + 1'b1;
      digest_q <= digest_q * 32'd31 + 32'(data) + 32'd1;
    end
  end

  logic unused;
  assign unused = &{1'b0, silence_i, addr, overrun};

endmodule

`default_nettype wire
