// SPDX-License-Identifier: Apache-2.0
// ppmc312_reply: what an executed instruction answers: the bytes behind its code.
// Rules:  section 3.1 (answers), P312-CMD-25/27/40..4D.
// Timing: registered: the values of one clk, so that a position of four bytes is a snapshot.
`default_nettype none

module ppmc312_reply
  import ppmc312_pkg::*;
  import ppmc312_link_pkg::*;
  import ppmc312_instr_pkg::*;
  import ppmc312_stage_pkg::*;
#(
    parameter logic [7:0] Version = 8'h12
) (
    input  wire logic        clk_i,     // clock
    input  wire block_t      block_i,   // the instruction
    input  wire inputs_t     inputs_i,  // pins, synchronous
    input  wire axis_state_t state_i,   // of the motor side
    input  wire table_t      table_i,   // in force
    input  wire stored_t     stored_i,  // instructions that wait
    output told_t            told_o     // one clk later
);

  logic n;
  logic [6:0] first;
  logic [31:0] pos;
  logic [7:0] counts[3];
  logic [3:0] extra;
  logic [8:0][7:0] data;

  assign n = block_i.par[0][0];
  assign pos = n ? state_i.enc : state_i.pos;
  assign first = (table_i.first_acc < table_i.first_dec) ? table_i.first_acc : table_i.first_dec;
  assign counts[0] = 8'd127 - 8'(first);
  assign counts[1] = 8'd127 - 8'(table_i.first_acc);
  assign counts[2] = table_i.split ? 8'd127 - 8'(table_i.first_dec) : 8'd0;

  always_comb begin
    extra = 4'd1;
    data  = '0;
    unique case (block_i.code)
      I_END:     data[0] = block_i.par[0];
      I_AUX_IN:  data[0] = inputs_i.auxi;
      I_VERSION: data[0] = Version;
      I_LOCK:    data[0] = 8'(!state_i.lock);  // as it will be
      I_SYNC:    data[0] = 8'(!state_i.settings.ungated);
      I_PINS: begin
        extra     = 4'd2;
        data[1:0] = {inputs_i.evt_n, inputs_i.run, 5'd0, inputs_i.plain};
      end
      I_POS: begin
        extra     = 4'd5;
        data[4:0] = {pos[7:0], pos[15:8], pos[23:16], pos[31:24], 7'd0, n};
      end
      I_EVT_READ: begin
        extra     = 4'd6;
        data[0]   = 8'(stored_i.event_count[n]);
        data[1]   = 8'(stored_i.event_next[n]);
        data[5:2] = stored_i.event_codes[n];
      end
      I_STATUS: begin
        extra = 4'd3;
        data[0] = {
          state_i.settings.ungated,
          state_i.lock,
          1'b0,
          state_i.window_on,
          state_i.settings.end_watch,
          state_i.outside
        };
        data[1] = {2'b00, state_i.status};
        data[2] = {
          stored_i.event_count[1] != '0,
          stored_i.event_count[0] != '0,
          stored_i.fifo_events,
          stored_i.fifo_count
        };
      end
      I_TABLE: begin
        extra     = 4'd9;
        data[2:0] = {counts[2], counts[1], counts[0]};
        data[5:3] = {table_i.acc[7:0], table_i.acc[15:8], table_i.acc[23:16]};
        data[8:6] = {table_i.dec[7:0], table_i.dec[15:8], table_i.dec[23:16]};
      end
      default:   extra = 4'd0;
    endcase
  end

  always_ff @(posedge clk_i) begin
    told_o <= '{extra: extra, data: data};
  end

  logic unused_bits;
  assign unused_bits = &{1'b0, block_i, inputs_i, state_i, table_i, stored_i};

endmodule

`default_nettype wire
