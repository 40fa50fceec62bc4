// SPDX-License-Identifier: Apache-2.0
// ppmc312_readback: the data blocks of a table read: rates, acceleration and deceleration pulses, fastest first.
// Rules:  P312-CMD-41.
// Timing: block_i writes the next block: 6 clk a stage; done_o comes with its last clk.
`default_nettype none

module ppmc312_readback
  import ppmc312_pkg::*;
  import ppmc312_stage_pkg::*;
(
    input wire logic clk_i,
    input wire logic rst_ni,
    input wire logic open_i,  // a table read begins; its first block is written elsewhere
    output logic more_o,  // blocks are to come
    input wire logic block_i,  // write the next one
    output logic busy_o,
    output logic done_o,
    // table
    input wire table_t table_i,
    output logic side_o,
    output logic [6:0] addr_o,
    input wire logic [15:0] rate_i,
    input wire logic [23:0] pulses_i,
    // store of class 2
    output logic we_o,
    output logic [BLOCK_BITS-1:0] at_o,
    output logic [7:0] data_o,
    output logic [BLOCK_BITS:0] size_o
);

  localparam logic [6:0] Fastest = 7'd126;

  logic run_q, rates, last_item, ends;
  logic [1:0] item_q, part_q, wait_q;
  logic [2:0] left_q;  // stages of this block
  logic [6:0] stage_q, first, before_q, rest_q, room;
  logic [ 5:0] at_q;
  logic [23:0] word;

  assign rates = item_q == 2'd1;
  assign last_item = item_q == (table_i.split ? 2'd3 : 2'd2);
  assign room = rates ? 7'd6 : 7'd4;
  assign addr_o = stage_q;
  assign side_o = item_q[0];
  assign busy_o = run_q;
  assign done_o = run_q && at_q > 6'd2 && left_q == '0;
  assign size_o = at_q;
  assign at_o = at_q[BLOCK_BITS-1:0];

  always_comb begin
    unique case (item_q)
      2'd1:    first = (table_i.first_acc < table_i.first_dec) ? table_i.first_acc : table_i.first_dec;
      2'd2:    first = table_i.first_acc;
      default: first = table_i.first_dec;
    endcase
    word = rates ? {rate_i, 8'd0} : pulses_i;
    we_o = run_q && !done_o && (at_q < 6'd3 || wait_q == '0);
    unique case (at_q)
      6'd0: data_o = 8'(last_item && ends);
      6'd1: begin
        if (rates) data_o = 8'd1 + {4'd0, left_q, 1'b0};
        else data_o = 8'd1 + {4'd0, left_q, 1'b0} + 8'(left_q);
      end
      6'd2: data_o = 8'(item_q);
      default: begin
        unique case (part_q)
          2'd0:    data_o = word[23:16];
          2'd1:    data_o = word[15:8];
          default: data_o = word[7:0];
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
    end else if (block_i) begin
      run_q  <= 1'b1;
      at_q   <= '0;
      part_q <= '0;
      wait_q <= 2'd0;
      left_q <= ends ? rest_q[2:0] : room[2:0];
    end else if (done_o) begin
      run_q <= 1'b0;
      if (stage_q == before_q) begin
        item_q  <= item_q + 1'b1;
        stage_q <= Fastest;
        more_o  <= !last_item;
      end
    end else if (run_q) begin
      if (we_o) at_q <= at_q + 1'b1;
      if (wait_q != '0) wait_q <= wait_q - 1'b1;
      else if (at_q > 6'd2) begin
        part_q <= part_q + 1'b1;
        if (part_q == (rates ? 2'd1 : 2'd2)) begin
          part_q  <= '0;
          stage_q <= stage_q - 1'b1;
          left_q  <= left_q - 1'b1;
          wait_q  <= 2'd3;
        end
      end
    end
  end

  // Looked at long after they have changed.
  always_ff @(posedge clk_i) begin
    before_q <= first - 1'b1;
    rest_q   <= stage_q - before_q;  // stages of this item to come
    ends     <= rest_q <= room;
  end

  logic unused_table;
  assign unused_table = &{1'b0, table_i};

endmodule

`default_nettype wire
