// SPDX-License-Identifier: Apache-2.0
// ppmc312_result_data: selects the data that an executed instruction returns. These are the bytes after the
//         code in its response.
// Rules:  docs/ppmc312/instructions.md, P312-CMD-25/27/40..4D.
// Timing: outputs are registered. All bytes are sampled in the same cycle, so a position of four bytes is a
//         snapshot.
`default_nettype none

module ppmc312_result_data
  import ppmc312_pkg::*;
  import ppmc312_link_pkg::*;
  import ppmc312_instr_pkg::*;
  import ppmc312_stage_pkg::*;
#(
    parameter logic [7:0] Version = 8'h12
) (
    input  wire logic                 clk_i,           // clock
    input  wire block_t               block_i,         // the instruction
    input  wire inputs_t              inputs_i,        // input pins, synchronised
    input  wire axis_state_t          state_i,         // state of the motor side
    input  wire table_t               table_i,         // active table
    input  wire logic          [ 6:0] first_i,         // first used stage of the table
    input  wire queue_status_t        queue_status_i,  // contents of the instruction queue
    input  wire logic                 hold_i,          // 1: value_o keeps its value
    output result_data_t              result_data_o,   // data of block_i, delayed by one cycle
    output logic               [31:0] value_o          // position for TailPos, one cycle after block_i
);

  logic n;
  logic [7:0] counts[3];
  logic [3:0] extra;
  logic [2:0][7:0] data;
  response_tail_e tail;

  assign n = block_i.par[0][0];
  // Inverting all 7 bits of a stage number computes 127 minus this number.
  assign counts[0] = {1'b0, ~first_i};
  assign counts[1] = {1'b0, ~table_i.first_acc};
  assign counts[2] = table_i.split ? {1'b0, ~table_i.first_dec} : 8'd0;

  always_comb begin
    extra = 4'd1;
    data  = '0;
    tail  = TailNone;
    unique case (block_i.code)
      I_END:     data[0] = block_i.par[0];
      I_AUX_IN:  data[0] = inputs_i.auxi;
      I_VERSION: data[0] = Version;
      I_LOCK:    data[0] = 8'(!state_i.lock);  // state after the execution
      I_SYNC:    data[0] = 8'(!state_i.settings.run_ignored);
      I_PINS: begin
        extra     = 4'd2;
        data[1:0] = {inputs_i.evt_n, inputs_i.run, 5'd0, inputs_i.unfiltered};
      end
      I_POS: begin
        extra   = 4'd5;
        data[0] = 8'(n);
        tail    = TailPos;
      end
      I_EVT_READ: begin
        extra   = 4'd6;
        data[0] = 8'(queue_status_i.event_count[n]);
        data[1] = 8'(queue_status_i.event_next[n]);
        tail    = TailCodes;
      end
      I_STATUS: begin
        extra = 4'd3;
        data[0] = {
          state_i.settings.run_ignored,
          state_i.lock,
          1'b0,
          state_i.window_on,
          state_i.settings.end_monitored,
          state_i.outside
        };
        data[1] = {2'b00, state_i.status};
        data[2] = {
          queue_status_i.event_count[1] != '0,
          queue_status_i.event_count[0] != '0,
          queue_status_i.fifo_uses_event,
          queue_status_i.fifo_count
        };
      end
      I_TABLE: begin
        extra = 4'd9;
        data  = {counts[2], counts[1], counts[0]};
        tail  = TailSums;
      end
      default:   extra = 4'd0;
    endcase
  end

  always_ff @(posedge clk_i) begin
    result_data_o <= '{extra: extra, data: data, tail: tail};
    if (!hold_i) value_o <= n ? state_i.enc : state_i.pos;
  end

  logic unused_bits;
  assign unused_bits = &{1'b0, block_i, inputs_i, state_i, table_i, queue_status_i};

endmodule

`default_nettype wire
