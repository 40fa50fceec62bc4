// SPDX-License-Identifier: Apache-2.0
// ppmc312_table_read: writes the data blocks of a table read. The blocks contain a list of rates, a list of
//         acceleration pulses and, if the table has deceleration pulses of its own, a list of these. Each
//         list begins with the fastest stage.
// Rules:  P312-CMD-41.
// Timing: next_i starts the next block. A block of n stages takes 5 n + 1 cycles for rates, 6 n + 1 cycles
//         for pulses. done_o is asserted in the last cycle.
`default_nettype none

module ppmc312_table_read
  import ppmc312_pkg::*;
  import ppmc312_link_pkg::*;
  import ppmc312_instr_pkg::*;
  import ppmc312_stage_pkg::*;
(
    input wire logic clk_i,  // clock
    input wire logic rst_ni,  // reset, asynchronous
    input wire logic open_i,  // strobe: a table read begins; ppmc312_response_writer writes its first block
    output logic more_o,  // more blocks follow
    input wire logic next_i,  // strobe: write the next block
    output logic busy_o,  // a block is being written
    output logic done_o,  // strobe: the block is written
    // table
    input wire table_t table_i,  // active table
    input wire logic [6:0] first_i,  // first used stage of the table
    output table_addr_t table_addr_o,  // read port of the table
    input wire stage_t stage_i,  // stage at table_addr_o, two cycles later
    // queue of class 2
    output response_write_t response_write_o,  // byte of the block
    output logic [BLOCK_BITS:0] size_o  // bytes of the block, 5 .. 15; with done_o
);

  localparam logic [6:0] Fastest = 7'd126;
  localparam logic [7:0][3:0] Lengths = {
    12'd0, 4'd13, 4'd10, 4'd7, 4'd4, 4'd1
  };  // 3 * n + 1 bytes for n = 4 .. 0 stages

  logic run_q, rates, last_item, ends, stage_ends, in_words;
  logic [1:0] item_q, part_q, wait_q;
  logic [2:0] left_q;  // remaining stages of the block
  logic [6:0] stage_q, first;
  logic [ 2:0] room;
  logic [ 6:0] rest_q;  // remaining stages of the list
  logic [ 5:0] at_q;
  logic [23:0] word;

  assign rates = item_q == 2'd1;
  assign last_item = item_q == (table_i.split ? 2'd3 : 2'd2);
  assign room = rates ? 3'd6 : 3'd4;
  assign table_addr_o = '{side: item_q[0], stage: stage_q};
  assign busy_o = run_q;
  assign in_words = at_q[5:2] != '0 || at_q[1:0] == 2'd3;
  assign done_o = run_q && in_words && left_q == '0;
  assign stage_ends = run_q && !done_o && wait_q == '0 && in_words && part_q == (rates ? 2'd1 : 2'd2);
  assign size_o = at_q;
  assign response_write_o.addr = at_q[BLOCK_BITS-1:0];

  always_comb begin
    unique case (item_q)
      2'd1:    first = first_i;
      2'd2:    first = table_i.first_acc;
      default: first = table_i.first_dec;
    endcase
    word = rates ? {stage_i.rate, 8'd0} : stage_i.pulses;
    response_write_o.we = run_q && !done_o && (!in_words || wait_q == '0);
    unique case (at_q)
      6'd0: response_write_o.data = 8'(last_item && ends);
      6'd1: begin
        response_write_o.data = rates ? {4'd0, left_q, 1'b1} : {4'd0, Lengths[left_q]};
      end
      6'd2: response_write_o.data = 8'(item_q);
      default: begin
        unique case (part_q)
          2'd0:    response_write_o.data = word[23:16];
          2'd1:    response_write_o.data = word[15:8];
          default: response_write_o.data = word[7:0];
        endcase
      end
    endcase
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      more_o  <= 1'b0;
      run_q   <= 1'b0;
      item_q  <= 2'd1;
      stage_q <= Fastest;
      part_q  <= '0;
      wait_q  <= '0;
      left_q  <= '0;
      at_q    <= '0;
    end else if (open_i) begin
      more_o  <= 1'b1;
      item_q  <= 2'd1;
      stage_q <= Fastest;
    end else if (next_i) begin
      run_q  <= 1'b1;
      at_q   <= '0;
      part_q <= '0;
      wait_q <= 2'd0;
      left_q <= ends ? rest_q[2:0] : room;
    end else if (done_o) begin
      run_q <= 1'b0;
      if (rest_q == '0) begin
        item_q  <= item_q + 1'b1;
        stage_q <= Fastest;
        more_o  <= !last_item;
      end
    end else if (run_q) begin
      if (response_write_o.we) at_q <= 6'(ppmc_pkg::inc(32'(at_q)));
      if (wait_q != '0) wait_q <= wait_q - 1'b1;
      else if (in_words) begin
        part_q <= part_q + 1'b1;
        if (stage_ends) begin
          part_q  <= '0;
          stage_q <= 7'(ppmc_pkg::dec(32'(stage_q)));
          left_q  <= 3'(ppmc_pkg::dec(32'(left_q)));
          wait_q  <= 2'd3;
        end
      end
    end
  end

  // These registers are used long after their inputs change, so their delay of one cycle has no effect.
  always_ff @(posedge clk_i) begin
    if (!run_q && stage_q == Fastest) rest_q <= ~first;  // 127 - first
    else if (stage_ends) rest_q <= 7'(ppmc_pkg::dec(32'(rest_q)));
    // ends = 1: the remaining stages fit into this block, which has at most 6 rates or 4 numbers of pulses.
    ends <= rest_q[6:3] == '0 && (rates ? rest_q[2:0] != '1 : !rest_q[2] || rest_q[1:0] == '0);
  end

  logic unused_table;
  assign unused_table = &{1'b0, table_i};

endmodule

`default_nettype wire
