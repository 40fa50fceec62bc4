// SPDX-License-Identifier: Apache-2.0
// pmc006_frame, stub for proofs that hold for any frames: any received byte can complete a frame.
// pmc006_frame_fv proves which byte does.
`default_nettype none

module pmc006_frame
  import pmc006_pkg::frame_t;
(
    input  wire logic       clk_i,
    input  wire logic       rst_ni,
    input  wire logic [7:0] addr_i,
    input  wire logic [7:0] byte_i,
    input  wire logic       valid_i,
    input  wire logic       error_i,
    input  wire logic       timeout_i,
    output frame_t          frame_o
);

  logic any;  // not driven; the register ensures that all blocks read the same value
  logic last_q;
  always_ff @(posedge clk_i) last_q <= any;
  assign frame_o = '{go: valid_i && last_q, code: '0, data: '0};

endmodule

`default_nettype wire
