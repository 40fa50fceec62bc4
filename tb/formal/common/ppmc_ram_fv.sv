// SPDX-License-Identifier: Apache-2.0
// ppmc_ram_fv: proves for every word that a read returns the last value written to its address, two cycles
// after the address.
`include "ppmc_fv.svh"
`default_nettype none

module ppmc_ram_fv (
    input wire logic       clk_i,
    input wire logic       we_i,
    input wire logic [1:0] waddr_i,
    input wire logic [1:0] wdata_i,
    input wire logic [1:0] raddr_i,
    input wire logic [1:0] watched_i  // any address
);

  logic [1:0] rdata_o, word_q, word1_q, word2_q;
  logic hit1_q, hit2_q;

  `FV_RESET

  ppmc_ram #(
      .Width   (2),
      .AddrBits(2)
  ) dut (
      .we_i(we_i && rst_ni),
      .*
  );

  `FV_ASSUME(one_address, watched_i == $past(watched_i))

  always_ff @(posedge clk_i) begin
    if (!rst_ni) {word_q, hit1_q, hit2_q} <= '0;
    else begin
      if (we_i && waddr_i == watched_i) word_q <= wdata_i;
      hit1_q <= raddr_i == watched_i && !(we_i && waddr_i == watched_i);
      hit2_q <= hit1_q;
    end
    {word2_q, word1_q} <= {word1_q, word_q};
  end

  // No write occurs before the first cycle. Until the first write, the watched word is zero.
  `FV_ASSERT(what_was_written, !hit2_q || rdata_o == word2_q)
  `FV_COVER(seen_two_words, hit2_q && word_q != word2_q && word_q != '0 && word2_q != '0)

endmodule

`default_nettype wire
