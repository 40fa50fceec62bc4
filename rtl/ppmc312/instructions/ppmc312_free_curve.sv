// SPDX-License-Identifier: Apache-2.0
// ppmc312_free_curve: receives a free-curve transfer. Writes blocks of rates and pulse numbers into the
//         stage table.
// Rules:  P312-CMD-FC-1..10.
// Timing: open_i latches split_i, acc_i and dec_i. done_o follows data_i by bytes_i + 4 cycles. The results
//         of a block are valid until the next block.
// Note:   an invalid block may write into the table. This has no effect, because any error ends the
//         transfer without a table.
`default_nettype none

module ppmc312_free_curve
  import ppmc312_pkg::*;
  import ppmc312_stage_pkg::*;
(
    input wire logic clk_i,  // clock
    input wire logic rst_ni,  // reset, asynchronous
    input wire logic open_i,  // strobe: a transfer begins
    input wire logic split_i,  // with open_i: flag LE, 1: separate deceleration side
    input wire logic [6:0] acc_i,  // with open_i: stages of the acceleration, 2 .. 127
    input wire logic [6:0] dec_i,  // with open_i and split_i: stages of the deceleration
    input wire logic abort_i,  // strobe: end the transfer without a table
    output logic transfer_o,  // 1: a transfer is open
    // a data block
    input wire logic data_i,  // strobe: process a block
    input wire logic [4:0] bytes_i,  // bytes of the block, 1 .. 30
    input wire logic last_i,  // the block is marked as the last block
    output logic busy_o,  // from the cycle after data_i to the cycle of done_o
    output logic done_o,  // strobe: the block is processed
    output logic [BLOCK_BITS-1:0] addr_o,  // byte of the block; byte_i follows two cycles later
    input wire logic [7:0] byte_i,  // byte at addr_o, two cycles later
    output logic bad_o,  // with done_o: the block is invalid
    output logic [7:0] error_o,  // with bad_o: error number of response F0
    // progress
    output logic complete_o,  // the curve is complete
    output logic [1:0] next_list_o,  // 0: rates, 1: acceleration, 2: deceleration
    output logic [6:0] left_o,  // remaining stages of list next_list_o
    output logic [23:0] acc_sum_o,  // acceleration pulses; valid with complete_o
    output logic [23:0] dec_sum_o,  // deceleration pulses; valid with complete_o
    output table_write_t table_write_o  // word for the table
);

  localparam logic [6:0] Fastest = 7'd126;

  logic [1:0] valid_q, byte_q;
  logic run_q, split_q, whole, tiny, size_bad_q, rate_bad_q, pulses_bad_q, sum_bad_q, finishing_q, list_done;
  logic [4:0] sent_q, sent_s1_q, received_q;
  logic last_byte;
  logic [6:0] stage_q, acc_q, dec_q;
  logic [15:0] high_q;
  logic [23:0] word;
  logic [24:0] sum;
  logic rates;

  assign rates = next_list_o == 2'd0;
  assign word = {high_q, byte_i};
  assign whole = valid_q[1] && byte_q == (rates ? 2'd1 : 2'd2);
  assign tiny = (rates ? 24'(word[15:0]) : word) <= 24'd1;
  assign sum = {1'b0, dec_sum_o} + {1'b0, word};  // running sum of the current list
  assign list_done = whole && left_o == 7'd1;
  assign addr_o = {4'(ppmc_pkg::inc(32'(sent_q[4:1]))), sent_q[0]};  // sent_q + 2
  assign busy_o = run_q;
  assign done_o = finishing_q;
  assign last_byte = 5'(ppmc_pkg::inc(32'(received_q))) == bytes_i;

  assign table_write_o = '{
          we_rate: whole && rates && !complete_o,
          we_acc: whole && next_list_o == 2'd1 && !complete_o,
          we_dec: whole && (next_list_o == 2'd2 || (next_list_o == 2'd1 && !split_q)) && !complete_o,
          stage: stage_q,
          data: rates ? 24'(word[15:0]) : word
      };

  always_comb begin
    bad_o   = 1'b1;
    error_o = E_FREE_SIZE;
    if (size_bad_q) error_o = E_FREE_SIZE;
    else if (rate_bad_q) error_o = E_FREE_RATE;
    else if (pulses_bad_q) error_o = E_FREE_PULSES;
    else if (sum_bad_q) error_o = E_FREE_SUM;
    else if (last_i != complete_o) error_o = E_FREE_LAST;
    else bad_o = 1'b0;
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      transfer_o  <= 1'b0;
      run_q       <= 1'b0;
      valid_q     <= '0;
      finishing_q <= 1'b0;
    end else begin
      if (open_i) transfer_o <= 1'b1;
      else if (abort_i || (done_o && (bad_o || complete_o))) transfer_o <= 1'b0;
      if (data_i) run_q <= 1'b1;
      else if (finishing_q) run_q <= 1'b0;
      valid_q     <= {valid_q[0], run_q && sent_q != bytes_i};
      finishing_q <= valid_q[1] && last_byte;
    end
  end

  // No reset: open_i initialises the registers of a transfer, data_i those of a block.
  always_ff @(posedge clk_i) begin
    // If the curve has no deceleration pulses of its own, the deceleration uses those of the acceleration.
    if (open_i || (list_done && next_list_o == 2'd1 && split_q)) dec_sum_o <= '0;
    else if (whole && !rates) dec_sum_o <= sum[23:0];
    if (open_i) begin
      split_q     <= split_i;
      acc_q       <= acc_i;
      dec_q       <= split_i ? dec_i : acc_i;
      next_list_o <= 2'd0;
      complete_o  <= 1'b0;
    end
    if (open_i || (!data_i && list_done)) stage_q <= Fastest;
    else if (!data_i && whole) stage_q <= 7'(ppmc_pkg::dec(32'(stage_q)));
    if (open_i) left_o <= (split_i && ppmc_pkg::less(32'(acc_i), 32'(dec_i))) ? dec_i : acc_i;
    else if (!data_i && whole) left_o <= !list_done ? 7'(ppmc_pkg::dec(32'(left_o))) : rates ? acc_q : dec_q;
    // received_q is the number of the byte on byte_i, which was requested two cycles before.
    if (data_i) {received_q, sent_s1_q} <= '0;
    else {received_q, sent_s1_q} <= {sent_s1_q, sent_q};
    if (data_i) begin
      {size_bad_q, rate_bad_q, pulses_bad_q, sum_bad_q} <= '0;
      byte_q <= '0;
      sent_q <= '0;
    end else begin
      if (run_q && sent_q != bytes_i) sent_q <= 5'(ppmc_pkg::inc(32'(sent_q)));
      if (valid_q[1]) begin
        high_q <= {high_q[7:0], byte_i};
        byte_q <= whole ? '0 : byte_q + 1'b1;
        // A block must contain complete stages of only one list.
        if (last_byte ? !whole : list_done) size_bad_q <= 1'b1;
        if (complete_o) size_bad_q <= 1'b1;
      end
      if (whole) begin
        if (rates && tiny) rate_bad_q <= 1'b1;
        if (!rates && tiny) pulses_bad_q <= 1'b1;
        if (!rates && sum[24]) sum_bad_q <= 1'b1;
        if (next_list_o == 2'd1) acc_sum_o <= sum[23:0];
        if (list_done) begin
          next_list_o <= next_list_o + 1'b1;
          complete_o  <= next_list_o == (split_q ? 2'd2 : 2'd1);
        end
      end
    end
  end

endmodule

`default_nettype wire
