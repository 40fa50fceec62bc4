// SPDX-License-Identifier: Apache-2.0
// ppmc_bank_tables_fv: proves that a table is written only while an axis has booked it, for this axis and
// from its numbers, and that the build ends.
`include "ppmc_fv.svh"
`default_nettype none

module ppmc_bank_tables_fv (
    input wire logic       clk_i,
    input wire logic       book_i,
    input wire logic [0:0] book_axis_i,
    input wire logic [7:0] slow_i,
    input wire logic [7:0] fast_i,
    input wire logic [1:0] steps_i,
    input wire logic [0:0] axis_i,
    input wire logic [7:0] rate_i
);

  logic booked_o;
  logic [0:0] for_o;
  logic [1:0] threshold_o;

  `FV_RESET

  ppmc_bank_tables #(
      .AxisBits(1),
      .StepBits(2)
  ) dut (
      .*
  );

  `FV_ASSUME(when_free, !(book_i && booked_o))

  logic axis_q, word_q;  // axis_q: axis that has booked; word_q: its word was written
  logic [7:0] slow_q;
  logic [1:0] steps_q;
  logic [3:0] age_q;

  always_ff @(posedge clk_i)
    if (!rst_ni) {axis_q, slow_q, steps_q, age_q, word_q} <= '0;
    else if (book_i) {axis_q, slow_q, steps_q, age_q, word_q} <= {book_axis_i, slow_i, steps_i, 5'd0};
    else begin
      age_q  <= booked_o ? age_q + 1'b1 : '0;
      word_q <= word_q || dut.we;
    end

  `FV_ASSERT(bank_ini_01_for_who_has_booked,
             !dut.we || (booked_o && for_o == axis_q && dut.waddr == slow_q && dut.wdata == steps_q))
  `FV_ASSERT(bank_hsk_05_ends, age_q <= 4'd8)
  `FV_ASSERT(bank_hsk_05_whole_when_free, !($past(rst_ni && booked_o) && !booked_o) || word_q)
  `FV_COVER(seen_second_axis, dut.we && for_o == 1'b1)

endmodule

`default_nettype wire
