// SPDX-License-Identifier: Apache-2.0
// ppmc312_response_writer: writes a response byte by byte into the queue of class 2.
// Rules:  docs/ppmc312/README.md, 6.1; docs/ppmc312/instructions.md (data of the results); P312-GEN-04
//         (logical order), P312-RSP-10, P312-CMD-25/27/40/41/42/47/4D.
// Timing: done_o follows start_i by 3 cycles plus one cycle per byte after the length byte. Data that change
//         while a response is written are those of the last cycle in which hold_i was 0.
// Assumes: the other inputs are stable from start_i to done_o.
`default_nettype none

module ppmc312_response_writer
  import ppmc312_pkg::*;
  import ppmc312_link_pkg::*;
  import ppmc312_instr_pkg::*;
  import ppmc312_stage_pkg::*;
#(
    parameter logic [7:0] Version = 8'h12  // value that the version instruction returns
) (
    input wire logic clk_i,  // clock
    input wire logic rst_ni,  // reset, asynchronous
    input wire logic start_i,  // strobe: write response_i
    input wire response_t response_i,  // the response
    output logic done_o,  // strobe: the response is written
    // data
    input wire logic hold_i,  // 1: the data that change keep their values
    input wire block_t block_i,  // the instruction
    input wire inputs_t inputs_i,  // input pins, synchronised
    input wire axis_state_t state_i,  // state of the motor side
    input wire table_t table_i,  // active table
    input wire logic [6:0] first_i,  // first used stage of the table
    input wire logic [6:0] left_i,  // remaining stages of a list of a free curve
    input wire queue_status_t queue_status_i,  // contents of the instruction queue
    output logic [BLOCK_BITS-1:0] echo_addr_o,  // byte of the instruction, 0 = header
    input wire logic [7:0] echo_i,  // byte at echo_addr_o, two cycles later
    output logic peek_o,  // 1: the code of an entry of an event buffer is requested
    output logic [1:0] peek_at_o,  // this entry
    input wire logic [7:0] entry_i,  // code of the entry, two cycles later
    // response
    output response_write_t response_write_o,  // byte of the response, for the queue of class 2
    output logic [BLOCK_BITS:0] size_o,  // bytes of the response, 3 .. 32; with done_o
    output logic [7:0] code_o,  // code of the response; with done_o
    output logic [2:0] first_o  // bits 2:0 of the first byte after the code, if any; with done_o
);

  logic n, run_q, peek_valid_q, peek_valid_s2_q, flag_q;
  logic [BLOCK_BITS:0] at_q;
  logic [BLOCK_BITS:0] len_q;  // length byte: bytes of the response minus two
  logic [3:0] next_q;  // byte whose source is being read from the ROM
  logic [12:0] source;
  logic [31:0][7:0] bytes;
  logic [7:0] auxi_q, echo_len;
  logic [15:0] pins_q;
  logic [23:0] state_q;
  logic [31:0] pos_q;
  logic [ 2:0] count_q;
  logic [ 1:0] next_entry_q;

  assign n = block_i.par[0][0];

  // ---- data ---------------------------------------------------------------------------------------

  // No reset: these data are used after an instruction only.
  always_ff @(posedge clk_i) begin
    if (!hold_i) begin
      auxi_q <= inputs_i.auxi;
      pins_q <= {inputs_i.unfiltered, inputs_i.evt_n, inputs_i.run, 5'd0};
      pos_q <= n ? state_i.enc : state_i.pos;
      flag_q <= (block_i.code == I_LOCK) ? !state_i.lock : !state_i.settings.run_ignored;
      count_q <= queue_status_i.event_count[n];
      next_entry_q <= queue_status_i.event_next[n];
      state_q <= {
        state_i.settings.run_ignored,
        state_i.lock,
        1'b0,
        state_i.window_on,
        state_i.settings.end_monitored,
        state_i.outside,
        2'b00,
        state_i.status,
        queue_status_i.event_count[1] != '0,
        queue_status_i.event_count[0] != '0,
        queue_status_i.fifo_uses_event,
        queue_status_i.fifo_count
      };
    end
  end

  // An echo contains the instruction without header and length, at most 28 bytes. The code of the response and
  // an error number precede the echo.
  always_comb begin
    echo_len = 8'(block_i.size);
    if (block_i.size[5:1] == '0) echo_len = 8'd2;
    if (block_i.size[5] || block_i.size[4:0] == '1) echo_len = 8'd30;
  end

  // Entry n is the byte with number n in byte_source_e. Inverting all 7 bits of a stage number computes 127
  // minus this number.
  assign bytes = {<<8{
    source[12:5], block_i.code, block_i.par[0], block_i.len, echo_i, echo_len, response_i.number,
    8'(response_i.status), 8'(flag_q), auxi_q, pins_q, state_q, 8'(count_q), 8'(next_entry_q),
    entry_i & {8{peek_valid_s2_q}}, 8'(left_i),
    1'b0, ~first_i, 1'b0, ~table_i.first_acc, {1'b0, ~table_i.first_dec} & {8{table_i.split}},
    pos_q, table_i.acc, table_i.dec
  }};

  // ---- bytes of the response ----------------------------------------------------------------------

  ppmc312_response_rom #(
      .Version(Version)
  ) u_rom (
      .clk_i,
      .kind_i  (response_i.kind),
      .at_i    (next_q),
      .source_o(source)
  );

  assign size_o = {5'(ppmc_pkg::inc(32'(len_q[5:1]))), len_q[0]};
  assign done_o = run_q && at_q == size_o;
  assign response_write_o.we = run_q && at_q != size_o;
  assign response_write_o.addr = at_q[BLOCK_BITS-1:0];
  always_comb begin
    response_write_o.data = bytes[source[4:0]];
    if (at_q == '0) response_write_o.data = {3'd0, block_i.source, 2'b01, response_i.kind != KindTable};
  end

  // An address precedes its byte by two cycles. The echo begins at byte 4 of the response, with byte 2 of the
  // instruction, which is its code. The codes of entries begin at byte 5.
  assign echo_addr_o = at_q[BLOCK_BITS-1:0];
  assign peek_o = run_q && response_i.kind == KindEntries;
  assign peek_at_o = at_q[1:0] + 2'd1;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      run_q <= 1'b0;
      at_q  <= '0;
      len_q <= '0;
    end else begin
      if (at_q == 6'd1) len_q <= response_write_o.data[BLOCK_BITS:0];
      if (start_i) begin
        run_q <= 1'b1;
        at_q  <= '0;
      end else if (run_q) begin
        if (at_q == size_o) run_q <= 1'b0;
        else at_q <= 6'(ppmc_pkg::inc(32'(at_q)));
      end
    end
  end

  always_ff @(posedge clk_i) begin
    if (!start_i && !run_q) next_q <= 4'd1;
    else if (next_q != '1) next_q <= 4'(ppmc_pkg::inc(32'(next_q)));
    peek_valid_q <= {1'b0, peek_at_o} < queue_status_i.event_count[n];
    peek_valid_s2_q <= peek_valid_q;
    if (at_q == 6'd2) code_o <= response_write_o.data;
    if (at_q == 6'd3) first_o <= response_write_o.data[2:0];
  end

  logic unused_bits;
  assign unused_bits = &{1'b0, source, block_i, inputs_i, state_i, table_i, queue_status_i, response_i};

endmodule

`default_nettype wire
