// SPDX-License-Identifier: Apache-2.0
// pmc006_frame_fv: proves that exactly the valid frames for this device are output, with their code and data.
`include "ppmc_fv.svh"
`default_nettype none

module pmc006_frame_fv
  import pmc006_pkg::frame_t;
(
    input wire logic       clk_i,
    input wire logic [7:0] addr_i,
    input wire logic [7:0] byte_i,
    input wire logic       valid_i,
    input wire logic       error_i,
    input wire logic       timeout_i
);

  frame_t frame_o;

  `FV_RESET

  pmc006_frame dut (.*);

  `FV_ASSUME(one_outcome, !(valid_i && error_i))

  logic [6:0][7:0] bytes_q;  // bytes of the frame, [0]: the first
  logic [7:0] sum_q;  // sum of these bytes
  logic mine_q;  // byte 1 was the address of the device
  logic [2:0] place, place_q;  // place of the next byte in its frame; 0: the byte must be A5

  assign place = timeout_i ? 3'd0 : place_q;

  always_ff @(posedge clk_i) begin
    if (valid_i && place != 3'd7) bytes_q[place] <= byte_i;
    if (valid_i) sum_q <= (place == '0) ? byte_i : sum_q + byte_i;
    if (valid_i && place == 3'd1) mine_q <= byte_i == addr_i;
    if (!rst_ni || error_i) place_q <= '0;
    else if (valid_i) place_q <= (place == '0 && byte_i != 8'hA5) ? '0 : place + 3'd1;
  end

  `FV_ASSERT(lemma_place, dut.index_q == place_q)
  `FV_ASSERT(lemma_head, place_q < 1 || bytes_q[0] == 8'hA5)
  `FV_ASSERT(lemma_sum, place_q < 1 || dut.sum_q == sum_q)
  `FV_ASSERT(lemma_address, place_q < 2 || dut.addr_match_q == mine_q)
  `FV_ASSERT(lemma_code, place_q < 3 || dut.code_q == bytes_q[2])
  for (genvar n = 0; n < 4; n++) begin : g_data
    `FV_ASSERT(lemma_data, place_q < 4 + n || dut.data_q[31-8*n-:8] == bytes_q[place_q-1-n])
  end

  `FV_ASSERT(frame_is_valid, frame_o.go == (valid_i && place == 3'd7 && mine_q && byte_i == sum_q))
  `FV_ASSERT(frame_begins_with_head, !frame_o.go || bytes_q[0] == 8'hA5)
  `FV_ASSERT(frame_code, !frame_o.go || frame_o.code == bytes_q[2])
  `FV_ASSERT(frame_data, !frame_o.go || frame_o.data == bytes_q[6:3])
  `FV_ASSERT(frame_kept, !$past(rst_ni && (frame_o.go || !valid_i)) || {frame_o.code, frame_o.data} == $past
             ({frame_o.code, frame_o.data}))
  `FV_COVER(seen_frame, frame_o.go && bytes_q[3] == 8'hA5)

endmodule

`default_nettype wire
