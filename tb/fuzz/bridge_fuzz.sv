// SPDX-License-Identifier: Apache-2.0
// bridge_fuzz: the deframer of the UART bridge, for tb/fuzz/main.cpp.
// The first (highest) byte of what_o is 1 for a request, followed by SEQ, length and digest of the script.
// The first byte is 2 for a NAK, followed by the code of the NAK.
`default_nettype none

module bridge_fuzz
  import ppmc_bridge_pkg::*;
(
    input  wire logic        clk_i,
    input  wire logic        rst_ni,
    input  wire logic  [7:0] byte_i,     // character
    input  wire logic        valid_i,    // strobe: byte_i was received with a stop bit
    input  wire logic        error_i,    // strobe: byte_i was received without a stop bit
    input  wire logic        silence_i,  // 1 during silence; each cycle counts as 1 ms
    output logic             event_o,    // strobe: an event
    output logic      [63:0] what_o      // description of the event
);

  logic we, good, request, dropped;
  logic [7:0] waddr, wdata, length;
  logic [6:0] seq;
  nak_e nak;
  logic [7:0] script[256];

  ppmc_bridge_rx dut (
      .clk_i,
      .rst_ni,
      .ms_i       (silence_i),
      .byte_i,
      .valid_i,
      .error_i,
      .we_o       (we),
      .waddr_o    (waddr),
      .wdata_o    (wdata),
      .good_o     (good),
      .request_o  (request),
      .seq_o      (seq),
      .length_o   (length),
      .busy_i     (1'b0),
      .dropped_o  (dropped),
      .nak_o      (nak),
      .nak_taken_i(nak != NakNone)
  );

  function automatic logic [31:0] digest(int unsigned count);
    logic [31:0] sum = '0;
    for (int unsigned at = 0; at < count; at++) sum = sum * 32'd31 + 32'(script[at[7:0]]) + 32'd1;
    return sum;
  endfunction

  assign event_o = request || nak != NakNone;
  always_comb begin
    what_o = {8'd2, 48'd0, 8'(nak)};
    if (request) what_o = {8'd1, 1'b0, seq, 16'(length), digest(32'(length))};
  end

  always_ff @(posedge clk_i) if (we) script[waddr] <= wdata;

  logic unused;
  assign unused = &{1'b0, good, dropped};

endmodule

`default_nettype wire
