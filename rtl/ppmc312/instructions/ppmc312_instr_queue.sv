// SPDX-License-Identifier: Apache-2.0
// ppmc312_instr_queue: stores instructions that wait for a trigger. Contains a command FIFO with eight
//         entries, and two event buffers with four entries each.
// Rules:  P312-OVR-01/02/05/10/12, P312-EVT-01/04, P312-BAD-13.
// Timing: a new head of the FIFO is armed (waits for its trigger) 2 cycles after the trigger of the previous
//         head. halt_o follows counted_i by one cycle. The bytes of an entry are valid two cycles after
//         fetch_addr_i.
// How:    one RAM stores the complete blocks. The FIFO has 16 places, because triggered entries remain
//         stored until they are processed; the event buffers have 2 * 4 places. The FIFO has three
//         pointers: written, armed, processed.
`include "ppmc_assert.svh"
`default_nettype none

module ppmc312_instr_queue
  import ppmc312_pkg::*;
  import ppmc312_link_pkg::*;
  import ppmc312_instr_pkg::*;
(
    input  wire logic            clk_i,           // clock
    input  wire logic            rst_ni,          // reset, asynchronous
    // triggers
    input  wire logic     [ 1:0] edge_i,          // strobes: falling edges of the event pins
    input  wire logic            counted_i,       // strobe: a pulse has been counted in pos_i
    input  wire logic     [31:0] pos_i,           // position in pulses
    output logic                 halt_o,          // strobe: the position of an immediate stop is reached
    output queue_status_t        queue_status_o,  // contents of the queue
    input  wire enqueue_t        enqueue_i,       // entry to be added
    input  wire dequeue_t        dequeue_i,       // entries to be removed
    // bytes of the most recently taken entry
    input  wire logic            fetch_event_i,   // 1: the entry is from an event buffer
    input  wire logic     [ 3:0] fetch_addr_i,    // byte number, 0 = header
    input  wire logic            peek_i,          // 1: read the code of an entry instead
    input  wire logic            peek_n_i,        // with peek_i: event buffer
    input  wire logic     [ 1:0] peek_at_i,       // with peek_i: entry
    output logic          [ 7:0] fetch_data_o     // requested byte, two cycles later
);

  typedef struct packed {
    logic       halt;
    logic [1:0] trig;
  } tag_t;

  // enqueue_i.code, trig and pos are stable while the bytes of an entry are written, so each write of a byte
  // also writes the head. No block uses data that are read from an address while it is written.
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
  logic push, drop, take_fifo, triggered_q;

  // ---- command FIFO -------------------------------------------------------------------------------

  assign push = enqueue_i.entry_done && !enqueue_i.to_event;
  assign drop = dequeue_i.all || dequeue_i.fifo;
  assign take_fifo = dequeue_i.take && !dequeue_i.from_event;
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
      waits_more[n] = push && enqueue_i.trig == {1'(n), 1'b1};
      waits_less[n] = fire && head_q.trig == {1'(n), 1'b1};
    end
  end

  assign done_next = done_q + 1'b1;
  assign queue_status_o = '{
          fifo_triggered: triggered_q,
          fifo_trig: done_trig_q,
          events_triggered: event_q,
          fifo_count: written_q - armed_q,
          fifo_uses_event: {waits_q[1] != '0, waits_q[0] != '0},
          event_count: count_q,
          event_next: next_q
      };

  always_ff @(posedge clk_i) begin
    if (enqueue_i.we && !enqueue_i.to_event) begin
      heads[written_q] <= {enqueue_i.code == I_HALT, enqueue_i.trig, enqueue_i.pos};
      trigs[written_q] <= enqueue_i.trig;
    end
    // Block RAMs are slow, so the next head is read in advance.
    ahead_q <= heads[armed_q+4'(head_valid_q)];
    if (!head_valid_q) {head_q, head_pos_q} <= ahead_q;
    // For two cycles after an entry is taken, done_trig_q is out of date; no block uses it then.
    done_word_q <= trigs[done_q];
    done_trig_q <= done_word_q;
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {written_q, armed_q, done_q, taken_q} <= '0;
      head_valid_q                          <= 1'b0;
      triggered_q                           <= 1'b0;
      halt_o                                <= 1'b0;
      waits_q                               <= '0;
    end else begin
      head_valid_q <= armed_q != written_q && !fire && !drop;
      halt_o       <= fire && head_q.halt && !head_q.trig[0];
      // The entries from done_q up to armed_q are triggered. They are taken only while triggered_q = 1, so
      // done_q never overtakes armed_q. Therefore this comparison for equality is sufficient.
      triggered_q  <= !drop && (fire || (take_fifo ? done_next != armed_q : done_q != armed_q));
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
    logic take, add, empty, one;

    assign take  = dequeue_i.take && dequeue_i.from_event && dequeue_i.n == 1'(n);
    assign add   = enqueue_i.entry_done && enqueue_i.to_event && enqueue_i.n == 1'(n);
    assign empty = dequeue_i.all || dequeue_i.events[n];
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
        if (add) begin
          count_q[n] <= count_q[n] + 1'b1;
          next_q[n]  <= '0;
        end else if (dequeue_i.highest[n]) begin
          count_q[n] <= count_q[n] - 1'b1;
          next_q[n]  <= '0;
          if (count_q[n] == 3'd1) event_q[n] <= 1'b0;  // no entry is left
        end
      end
    end
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) taken_n_q <= 1'b0;
    else if (dequeue_i.take) taken_n_q <= dequeue_i.n;
  end

  // ---- bytes: FIFO at 0 .. 255, event buffers at 256 .. 383 ---------------------------------------

  localparam logic [3:0] Code = 4'd2;  // position of the code in a block
  logic [8:0] waddr, raddr;

  assign waddr = enqueue_i.to_event ? {2'b10, enqueue_i.n, count_q[enqueue_i.n][1:0], enqueue_i.addr} :
      {1'b0, written_q, enqueue_i.addr};
  always_comb begin
    raddr = fetch_event_i ? {2'b10, taken_n_q, taken_entry_q[taken_n_q], fetch_addr_i} :
        {1'b0, taken_q, fetch_addr_i};
    if (peek_i) raddr = {2'b10, peek_n_i, peek_at_i, Code};
  end

  ppmc_ram #(
      .Width   (8),
      .AddrBits(9)
  ) u_bytes (
      .clk_i,
      .we_i   (enqueue_i.we),
      .waddr_i(waddr),
      .wdata_i(enqueue_i.data),
      .raddr_i(raddr),
      .rdata_o(fetch_data_o)
  );

`ifndef SYNTHESIS
  `PPMC_ASSERT(p312_ovr_10_due, triggered_q == (done_q != armed_q))
  `PPMC_ASSERT(p312_ovr_01, queue_status_o.fifo_count <= 4'd8)
  `PPMC_ASSERT(p312_evt_01, count_q[0] <= 3'd4 && count_q[1] <= 3'd4)
  `PPMC_ASSERT(p312_evt_01_take, !(dequeue_i.take && dequeue_i.from_event) || event_q[dequeue_i.n])
`endif

endmodule

`default_nettype wire
