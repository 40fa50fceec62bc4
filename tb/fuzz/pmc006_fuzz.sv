// SPDX-License-Identifier: Apache-2.0
// pmc006_fuzz: the deframer of the PMC006B4 with address 3, for tb/fuzz/main.cpp.
// The first (highest) byte of what_o is 1, followed by the code and the data of the instruction.
`default_nettype none

module pmc006_fuzz (
    input  wire logic        clk_i,
    input  wire logic        rst_ni,
    input  wire logic [ 7:0] byte_i,     // character
    input  wire logic        valid_i,    // strobe: byte_i was received with a stop bit
    input  wire logic        error_i,    // strobe: byte_i was received without a stop bit
    input  wire logic        silence_i,  // 1 during silence
    output logic             event_o,    // strobe: an event
    output logic      [63:0] what_o      // description of the event
);

  pmc006_pkg::frame_t frame;
  logic timeout_q;

  pmc006_frame dut (
      .clk_i,
      .rst_ni,
      .addr_i(8'd3),
      .byte_i,
      .valid_i,
      .error_i,
      .timeout_i(timeout_q),
      .frame_o(frame)
  );

  assign event_o = frame.go;
  assign what_o  = {8'd1, frame.code, 16'd0, frame.data};

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) timeout_q <= 1'b0;
    else if (silence_i) timeout_q <= 1'b1;
    else if (valid_i || error_i) timeout_q <= 1'b0;
  end

endmodule

`default_nettype wire
