// SPDX-License-Identifier: Apache-2.0
// ppmc312_instr_queue: stores instructions that wait for a trigger: a command FIFO of eight entries and two event
//         buffers of four.
// Rules:  P312-OVR-01/02/05/10/12, P312-EVT-01/04, P312-BAD-13.
// Timing: a new head of the FIFO is armed 2 cycles after the trigger of the previous one. halt_o follows the
//         count by one cycle. Bytes of an entry are valid two cycles after fetch_addr_i.
// How:    entries are whole blocks in one RAM: 16 places for the FIFO, because triggered entries stay until
//         they are processed, and 2 * 4 for the events. The FIFO has three pointers: written, armed,
//         processed.
`include "ppmc_assert.svh"
`default_nettype none

module ppmc312_instr_queue
  import ppmc312_pkg::*;
  import ppmc312_link_pkg::*;
  import ppmc312_instr_pkg::*;
(
    input  wire logic           clk_i,          // clock
    input  wire logic           rst_ni,         // reset, asynchronous
    // triggers
    input  wire logic    [ 1:0] edge_i,         // strobes: falling edges of the event pins
    input  wire logic           counted_i,      // strobe: a pulse has been counted in pos_i
    input  wire logic    [31:0] pos_i,          // position in pulses
    output logic                halt_o,         // strobe: the position of an immediate stop is reached
    output stored_t             stored_o,       // contents of the store
    input  wire put_t           put_i,          // entry to be added
    input  wire remove_t        remove_i,       // entries to be removed
    // bytes of the entry that was taken last
    input  wire logic           fetch_event_i,  // 1: the entry is from an event buffer
    input  wire logic    [ 3:0] fetch_addr_i,   // byte number, 0 = header
    input  wire logic           peek_i,         // 1: read the code of an entry instead
    input  wire logic           peek_n_i,       // with peek_i: event buffer
    input  wire logic    [ 1:0] peek_at_i,      // with peek_i: entry
    output logic         [ 7:0] fetch_data_o    // requested byte, two cycles later
);

  typedef struct packed {
    logic       halt;
    logic [1:0] trig;
  } tag_t;

  // put_i.code, trig and pos are stable while the bytes of an entry are written, so the head is written with
  // each byte. No block uses data that are read from the place that is being written.
  (* ram_style = "block", no_rw_check *)
  logic [34:0] heads[16];
  logic [34:0] ahead_q;  // head of the entry that is armed next
  (* ram_style = "block", no_rw_check *)
  logic [1:0] trigs[16];
  logic [31:0] head_pos_q;
  tag_t head_q;
  logic [1:0] done_word_q, done_trig_q, event_q;
  logic [1:0][2:0] count_q;
  logic [1:0][1:0] next_q;
  logic [3:0] written_q, armed_q, done_q, done_next, taken_q;
  logic head_valid_q, fire, taken_n_q;
  logic [1:0] use_edge, fifo_edge;
  logic [1:0][1:0] taken_entry_q;
  logic [1:0][3:0] waits_q;  // FIFO entries that wait for event pin [n]
  logic [1:0] waits_more, waits_less;
  logic push, drop, take_fifo, due_q;

  // ---- command FIFO -------------------------------------------------------------------------------

  assign push = put_i.put && !put_i.to_event;
  assign drop = remove_i.all || remove_i.fifo;
  assign take_fifo = remove_i.take && !remove_i.from_event;
  assign use_edge = edge_i & {count_q[1] != '0, count_q[0] != '0};
  assign fifo_edge = edge_i & ~use_edge;

  always_comb begin
    fire = 1'b0;
    if (head_valid_q) begin
      unique case (head_q.trig)
        2'b01:   fire = fifo_edge[0];
        2'b11:   fire = fifo_edge[1];
        default: fire = counted_i && pos_i == head_pos_q;
      endcase
    end
  end

  always_comb begin
    for (int unsigned n = 0; n < 2; n++) begin
      waits_more[n] = push && put_i.trig == {1'(n), 1'b1};
      waits_less[n] = fire && head_q.trig == {1'(n), 1'b1};
    end
  end

  assign done_next = done_q + 1'b1;
  assign stored_o = '{
          due: due_q,
          due_trig: done_trig_q,
          events: event_q,
          fifo_count: written_q - armed_q,
          fifo_events: {waits_q[1] != '0, waits_q[0] != '0},
          event_count: count_q,
          event_next: next_q
      };

  always_ff @(posedge clk_i) begin
    if (put_i.we && !put_i.to_event) begin
      heads[written_q] <= {put_i.code == I_HALT, put_i.trig, put_i.pos};
      trigs[written_q] <= put_i.trig;
    end
    // Block RAMs are slow, so the next head is read in advance.
    ahead_q <= heads[armed_q+4'(head_valid_q)];
    if (!head_valid_q) {head_q, head_pos_q} <= ahead_q;
    // done_trig_q is out of date for two cycles after an entry has been taken, when no block uses it.
    done_word_q <= trigs[done_q];
    done_trig_q <= done_word_q;
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {written_q, armed_q, done_q, taken_q} <= '0;
      head_valid_q                          <= 1'b0;
      due_q                                 <= 1'b0;
      halt_o                                <= 1'b0;
      waits_q                               <= '0;
    end else begin
      head_valid_q <= armed_q != written_q && !fire && !drop;
      halt_o       <= fire && head_q.halt && !head_q.trig[0];
      // armed_q is equal to done_q or ahead of it, because entries are taken only while due_q = 1.
      due_q        <= !drop && (fire || (take_fifo ? done_next != armed_q : done_q != armed_q));
      if (drop) begin
        armed_q <= written_q;
        done_q  <= written_q;
        waits_q <= '0;
      end else begin
        if (push) written_q <= written_q + 1'b1;
        if (fire) armed_q <= armed_q + 1'b1;
        if (take_fifo) begin
          done_q  <= done_next;
          taken_q <= done_q;
        end
        for (int unsigned n = 0; n < 2; n++) begin
          if (waits_more[n] != waits_less[n]) waits_q[n] <= waits_q[n] + {{3{waits_less[n]}}, 1'b1};
        end
      end
    end
  end

  // ---- event buffers ------------------------------------------------------------------------------

  for (genvar n = 0; n < 2; n++) begin : g_event
    logic take, put, empty, one;

    assign take  = remove_i.take && remove_i.from_event && remove_i.n == 1'(n);
    assign put   = put_i.put && put_i.to_event && put_i.n == 1'(n);
    assign empty = remove_i.all || remove_i.events[n];
    assign one   = 3'(next_q[n]) + 3'd1 == count_q[n];

    always_ff @(posedge clk_i or negedge rst_ni) begin
      if (!rst_ni) begin
        event_q[n]       <= 1'b0;
        count_q[n]       <= '0;
        next_q[n]        <= '0;
        taken_entry_q[n] <= '0;
      end else if (empty) begin
        event_q[n] <= 1'b0;
        count_q[n] <= '0;
        next_q[n]  <= '0;
      end else begin
        event_q[n] <= use_edge[n] || (event_q[n] && !take);
        if (take) begin
          taken_entry_q[n] <= next_q[n];
          next_q[n] <= one ? '0 : next_q[n] + 1'b1;
        end
        if (put) begin
          count_q[n] <= count_q[n] + 1'b1;
          next_q[n]  <= '0;
        end else if (remove_i.highest[n]) begin
          count_q[n] <= count_q[n] - 1'b1;
          next_q[n]  <= '0;
          if (count_q[n] == 3'd1) event_q[n] <= 1'b0;  // no entry is left
        end
      end
    end
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) taken_n_q <= 1'b0;
    else if (remove_i.take) taken_n_q <= remove_i.n;
  end

  // ---- bytes: FIFO at 0 .. 255, event buffers at 256 .. 383 ---------------------------------------

  localparam logic [3:0] Code = 4'd2;  // position of the code in a block
  logic [8:0] put_at, fetch_at;

  assign put_at = put_i.to_event ? {2'b10, put_i.n, count_q[put_i.n][1:0], put_i.addr} :
      {1'b0, written_q, put_i.addr};
  always_comb begin
    fetch_at = fetch_event_i ? {2'b10, taken_n_q, taken_entry_q[taken_n_q], fetch_addr_i} :
        {1'b0, taken_q, fetch_addr_i};
    if (peek_i) fetch_at = {2'b10, peek_n_i, peek_at_i, Code};
  end

  ppmc_ram #(
      .Width   (8),
      .AddrBits(9)
  ) u_bytes (
      .clk_i,
      .we_i   (put_i.we),
      .waddr_i(put_at),
      .wdata_i(put_i.data),
      .raddr_i(fetch_at),
      .rdata_o(fetch_data_o)
  );

`ifndef SYNTHESIS
  `PPMC_ASSERT(p312_ovr_10_due, due_q == (done_q != armed_q))
  `PPMC_ASSERT(p312_ovr_01, stored_o.fifo_count <= 4'd8)
  `PPMC_ASSERT(p312_evt_01, count_q[0] <= 3'd4 && count_q[1] <= 3'd4)
  `PPMC_ASSERT(p312_evt_01_take, !(remove_i.take && remove_i.from_event) || event_q[remove_i.n])
`endif

endmodule

`default_nettype wire
