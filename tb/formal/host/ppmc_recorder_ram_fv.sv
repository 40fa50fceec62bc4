// SPDX-License-Identifier: Apache-2.0
// ppmc_recorder_ram_fv: proves for every word that a read returns the last value written to its address,
// one cycle after the address.
`include "ppmc_fv.svh"
`default_nettype none

module ppmc_recorder_ram_fv (
    input wire logic       clk_i,
    input wire logic       we_i,
    input wire logic [1:0] addr_i,
    input wire logic [1:0] wdata_i,
    input wire logic [1:0] watched_i  // any address
);

  logic [1:0] rdata_o, word_q, was_q;
  logic known_q, hit_q;

  `FV_RESET

  ppmc_recorder_ram #(
      .Width   (2),
      .AddrBits(2)
  ) dut (
      .we_i(we_i && rst_ni),
      .*
  );

  `FV_ASSUME(one_address, watched_i == $past(watched_i))

  always_ff @(posedge clk_i) begin
    was_q <= word_q;
    if (!rst_ni) {known_q, hit_q, word_q} <= '0;
    else begin
      hit_q <= known_q && !we_i && addr_i == watched_i;
      if (we_i && addr_i == watched_i) {known_q, word_q} <= {1'b1, wdata_i};
    end
  end

  `FV_ASSERT(what_was_written, !hit_q || rdata_o == was_q)
  `FV_COVER(seen_read, hit_q && rdata_o == 2'd3)

endmodule

`default_nettype wire
