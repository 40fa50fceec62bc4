// SPDX-License-Identifier: Apache-2.0
// ppmc312_instr_queue_fv: proves order, trigger and storage of an arbitrary entry of the command FIFO, and
// that the event buffers are executed cyclically.
`include "ppmc_fv.svh"
`default_nettype none

module ppmc312_instr_queue_fv
  import ppmc312_pkg::*;
  import ppmc312_link_pkg::*;
  import ppmc312_instr_pkg::*;
(
    input wire logic            clk_i,
    input wire logic     [ 1:0] edge_i,
    input wire logic            counted_i,
    input wire logic     [31:0] pos_i,
    input wire enqueue_t        enqueue_i,
    input wire dequeue_t        dequeue_i,
    input wire logic            fetch_event_i,
    input wire logic     [ 3:0] fetch_addr_i,
    input wire logic            peek_i,
    input wire logic            peek_n_i,
    input wire logic     [ 1:0] peek_at_i,
    input wire logic            track_i         // 1: track the entry that is being added
);

  logic halt_o;
  logic [7:0] fetch_data_o;
  queue_status_t queue_status_o;

  `FV_RESET

  ppmc312_instr_queue dut (.*);

  typedef struct packed {
    logic halt;
    logic [1:0] trig;
    logic [31:0] pos;
  } head_t;

  head_t added;  // head of the entry that is being added
  assign added = '{halt: enqueue_i.code == I_HALT, trig: enqueue_i.trig, pos: enqueue_i.pos};

  // ---- command FIFO -------------------------------------------------------------------------------

  logic push, drop, take, own_fire, condition, has_place;
  logic [1:0] take_event;
  logic [3:0] waiting_q, triggered_q;  // entries that wait for their trigger; triggered entries
  // Tracked entry: stored, triggered, armed; most recently taken.
  logic tracked_q, fired_q, armed_q, current_q;
  logic [3:0] older_q;  // older entries in the FIFO, waiting or triggered
  logic [3:0] older_waiting_q;  // older entries that wait
  logic [3:0] slot_q;  // place of the tracked entry in the RAM
  logic [1:0] age_q;  // cycles since the last entry was taken or tracked, at most 2
  head_t head_q;

  assign push = enqueue_i.entry_done && !enqueue_i.to_event;
  assign has_place = waiting_q < 4'd8 && 5'(waiting_q) + 5'(triggered_q) < 5'd15;
  assign drop = dequeue_i.all || dequeue_i.fifo;
  assign take = dequeue_i.take && !dequeue_i.from_event;
  assign own_fire = dut.fire && tracked_q && !fired_q && older_waiting_q == '0;

  always_comb begin
    condition = counted_i && pos_i == head_q.pos;
    if (head_q.trig[0])
      condition = edge_i[head_q.trig[1]] && queue_status_o.event_count[head_q.trig[1]] == '0;
  end

  always_ff @(posedge clk_i) begin
    if (!rst_ni || drop) {waiting_q, triggered_q} <= '0;
    else begin
      waiting_q   <= waiting_q + 4'(push) - 4'(dut.fire);
      triggered_q <= triggered_q + 4'(dut.fire) - 4'(take);
    end
    if (!rst_ni || drop) current_q <= 1'b0;
    else if (take) current_q <= tracked_q && older_q == '0;
    armed_q <= tracked_q && !fired_q && older_waiting_q == '0 && !dut.fire && !drop;
    age_q   <= (take || !tracked_q) ? '0 : age_q + 2'(age_q != 2'd2);
    if (!rst_ni || drop) tracked_q <= 1'b0;
    else if (tracked_q) begin
      if (take && older_q == '0) tracked_q <= 1'b0;
      older_q <= older_q - 4'(take);
      fired_q <= fired_q || own_fire;
      older_waiting_q <= older_waiting_q - 4'(dut.fire && older_waiting_q != '0);
    end else if (push && track_i && !current_q) begin
      {tracked_q, fired_q, slot_q, head_q} <= {2'b10, dut.written_q, added};
      older_q <= waiting_q + triggered_q - 4'(take);
      older_waiting_q <= waiting_q - 4'(dut.fire);
    end
  end

  `FV_ASSUME(entry_is_written, !enqueue_i.entry_done || (!enqueue_i.we && $past(rst_ni && enqueue_i.we)
             && {enqueue_i.to_event, enqueue_i.n, added} == $past({enqueue_i.to_event, enqueue_i.n, added})))
  `FV_ASSUME(place_in_fifo, !(enqueue_i.we || enqueue_i.entry_done) || enqueue_i.to_event || has_place)
  `FV_ASSUME(takes_triggered, !take || queue_status_o.fifo_triggered)
  `FV_ASSUME(takes_triggered_event, (take_event & ~queue_status_o.events_triggered) == '0)

  head_t [15:0] heads;
  logic [15:0][1:0] trigs;
  for (genvar s = 0; s < 16; s++) begin : g_word
    assign heads[s] = dut.heads[s];
    assign trigs[s] = dut.trigs[s];
  end

  head_t next_head;  // head that is armed or will be armed next, as read from the memory
  assign next_head = dut.head_valid_q ? {dut.head_q, dut.head_pos_q} : dut.ahead_q;

  logic [1:0][4:0] users;  // FIFO entries that wait for event pin [n]
  always_comb begin
    users = '0;
    for (int unsigned n = 0; n < 2; n++) begin
      for (int unsigned s = 0; s < 16; s++) begin
        if (4'(s) - dut.armed_q < waiting_q && heads[s].trig == {1'(n), 1'b1}) users[n] = users[n] + 1'b1;
      end
    end
  end

  `FV_ASSERT(lemma_counts,
             dut.written_q - dut.armed_q == waiting_q && dut.armed_q - dut.done_q == triggered_q)
  `FV_ASSERT(lemma_places, waiting_q <= 4'd8 && 5'(waiting_q) + 5'(triggered_q) <= 5'd15)
  `FV_ASSERT(lemma_older, !(tracked_q && fired_q) || older_q < triggered_q)
  `FV_ASSERT(lemma_older_waiting, !tracked_q || fired_q || older_q == older_waiting_q + triggered_q)
  `FV_ASSERT(lemma_waiting, !tracked_q || fired_q || older_waiting_q < waiting_q)
  `FV_ASSERT(lemma_slot, !tracked_q || slot_q == dut.done_q + older_q)
  `FV_ASSERT(lemma_slot_taken, !current_q || (slot_q == dut.taken_q && slot_q + 4'd1 == dut.done_q))
  `FV_ASSERT(lemma_exclusive, !(tracked_q && current_q))
  `FV_ASSERT(lemma_stored, !tracked_q || (heads[slot_q] == head_q && trigs[slot_q] == head_q.trig))
  `FV_ASSERT(lemma_armed, !tracked_q || fired_q || older_waiting_q != '0 || dut.head_valid_q == armed_q)
  `FV_ASSERT(lemma_head, waiting_q == '0 || next_head == heads[dut.armed_q])
  `FV_ASSERT(lemma_valid, !dut.head_valid_q || waiting_q != '0)
  `FV_ASSERT(lemma_trig, !tracked_q || older_q != '0 || age_q < 1 || dut.done_word_q == head_q.trig)
  for (genvar n = 0; n < 2; n++) begin : g_users
    `FV_ASSERT(lemma_users, 5'(dut.waits_q[n]) == users[n])
    `FV_ASSERT(uses_event, queue_status_o.fifo_uses_event[n] == (users[n] != '0))
  end

  `FV_ASSERT(fifo_status,
             queue_status_o.fifo_count == waiting_q && queue_status_o.fifo_triggered == (triggered_q != '0))
  `FV_ASSERT(trigger_of_the_oldest, own_fire == (tracked_q && armed_q && condition))
  `FV_ASSERT(no_other_trigger, !dut.fire || waiting_q != '0)
  `FV_ASSERT(halt_at_the_position, !$past(rst_ni && own_fire) || halt_o == (head_q.halt && !head_q.trig[0]))
  `FV_ASSERT(no_other_halt, !halt_o || $past(dut.fire))
  `FV_ASSERT(taken_in_order, !(take && tracked_q && older_q == '0) || fired_q)
  `FV_ASSERT(
      trigger_reported,
      !(tracked_q && fired_q && older_q == '0 && age_q == 2'd2) || queue_status_o.fifo_trig == head_q.trig)
  `FV_ASSERT(not_overwritten,
             !((tracked_q || current_q) && enqueue_i.we && !enqueue_i.to_event) || dut.waddr[7:4] != slot_q)
  `FV_ASSERT(fetches_taken_entry,
             !(current_q && !fetch_event_i && !peek_i) || dut.raddr == {1'b0, slot_q, fetch_addr_i})
  `FV_COVER(seen_third_entry, tracked_q && $past(own_fire && triggered_q == 4'd2) && head_q.trig == 2'b11)
  `FV_COVER(seen_halt, halt_o)

  // ---- event buffers ------------------------------------------------------------------------------

  logic [1:0] add;
  logic [1:0][2:0] count_q;  // entries
  logic [1:0][1:0] next_q;  // entry that the next edge executes
  logic [1:0] remembered_q;  // an edge has not been processed yet
  logic taken_event_q, taken_n_q;  // the last entry was taken from event buffer taken_n_q
  logic [1:0] taken_at_q;
  logic [8:0] taken_address, free_address;

  assign taken_address = {2'b10, taken_n_q, taken_at_q, fetch_addr_i};
  assign free_address  = {2'b10, enqueue_i.n, count_q[enqueue_i.n][1:0], enqueue_i.addr};

  for (genvar n = 0; n < 2; n++) begin : g_event
    assign add[n] = enqueue_i.entry_done && enqueue_i.to_event && enqueue_i.n == 1'(n);
    assign take_event[n] = dequeue_i.take && dequeue_i.from_event && dequeue_i.n == 1'(n);
    `FV_ASSUME(place_in_buffer,
               !((enqueue_i.we || enqueue_i.entry_done) && enqueue_i.to_event &&
               enqueue_i.n == 1'(n)) || count_q[n] < 3'd4)
    `FV_ASSUME(deletes_an_entry, !dequeue_i.highest[n] || (count_q[n] != '0 && !add[n]))

    always_ff @(posedge clk_i) begin
      if (!rst_ni || dequeue_i.all || dequeue_i.events[n]) {count_q[n], next_q[n], remembered_q[n]} <= '0;
      else begin
        count_q[n] <= count_q[n] + 3'(add[n]) - 3'(dequeue_i.highest[n]);
        if (add[n] || dequeue_i.highest[n]) next_q[n] <= '0;
        else if (take_event[n]) next_q[n] <= (3'(next_q[n]) == count_q[n] - 3'd1) ? '0 : next_q[n] + 1'b1;
        remembered_q[n] <= (remembered_q[n] && !take_event[n]) || (edge_i[n] && count_q[n] != '0);
        if (dequeue_i.highest[n] && count_q[n] == 3'd1) remembered_q[n] <= 1'b0;
      end
    end

    `FV_ASSERT(event_status,
               {queue_status_o.event_count[n], queue_status_o.event_next[n],
               queue_status_o.events_triggered[n]} == {count_q[n], next_q[n], remembered_q[n]})
    `FV_ASSERT(event_entry_exists, !remembered_q[n] || 3'(next_q[n]) < count_q[n])
    `FV_ASSERT(event_next_exists, next_q[n] == '0 || 3'(next_q[n]) < count_q[n])
  end

  always_ff @(posedge clk_i) begin
    if (!rst_ni) taken_event_q <= 1'b0;
    else if (dequeue_i.take) begin
      {taken_event_q, taken_n_q} <= {
        dequeue_i.from_event && !dequeue_i.all && !dequeue_i.events[dequeue_i.n], dequeue_i.n
      };
      taken_at_q <= next_q[dequeue_i.n];
    end
  end

  `FV_ASSERT(lemma_taken,
             !taken_event_q || (dut.taken_n_q == taken_n_q && dut.taken_entry_q[taken_n_q] == taken_at_q))
  `FV_ASSERT(fetches_taken_event, !(taken_event_q && fetch_event_i && !peek_i) || dut.raddr == taken_address)
  `FV_ASSERT(writes_free_place, !(enqueue_i.we && enqueue_i.to_event) || dut.waddr == free_address)
  `FV_ASSERT(peeks, !peek_i || dut.raddr == {2'b10, peek_n_i, peek_at_i, 4'd2})
  `FV_COVER(seen_cycle, take_event[1] && count_q[1] == 3'd2 && next_q[1] == '0 && $past(next_q[1]) == 2'd1)

endmodule

`default_nettype wire
