// SPDX-License-Identifier: Apache-2.0
// ppmc312_report_queue_fv: proves that no report is lost or invented, the order of the reports, and their
// bytes.
`include "ppmc_fv.svh"
`default_nettype none

module ppmc312_report_queue_fv
  import ppmc312_pkg::*;
  import ppmc312_link_pkg::*;
  import ppmc312_serial_pkg::*;
(
    input wire logic clk_i,
    input wire logic serial_i,
    input wire axis_event_t axis_event_i,
    input wire logic [31:0] pos_i,
    input wire response_write_t response_write_i,
    input wire response_done_t response_done_i,
    input wire logic aux_clear_i,
    input wire logic aux_i,
    input wire logic [7:0] aux_data_i,
    input wire monitor_req_t monitor_req_i,
    input wire logic hold_i,
    input wire logic rd_load_i,
    input wire logic [BLOCK_BITS-1:0] rd_addr_i,
    input wire logic rd_done_i
);

  alarm_event_t discarded_o;
  response_queue_t response_queue_o;
  monitor_ack_t monitor_ack_o;
  poll_result_t poll_result_o;
  logic rd_any_o;
  logic [BLOCK_BITS:0] rd_size_o;
  logic [7:0] rd_data_o;

  `FV_RESET

  ppmc312_report_queue dut (.*);

  logic loaded_q;  // a report is being read
  logic [8:1] stored, offered;  // [n]: a report of class n is stored, is offered to the host
  logic [3:0]
      first, class_q, class_read;  // first offered class; class of the loaded report; class being read
  logic load, done;  // strobes: a report is loaded, has been read

  assign load = rd_load_i && !serial_i;
  assign done = serial_i ? rd_load_i && offered != '0 : rd_done_i;
  assign class_read = serial_i ? first : class_q;

  `FV_ASSUME(mode_kept, serial_i == $past(serial_i))
  `FV_ASSUME(loads_a_report, !load || rd_any_o)
  `FV_ASSUME(reads_a_loaded_report, !rd_done_i || (loaded_q && !serial_i))
  `FV_ASSUME(writes_a_free_entry,
             !(response_write_i.we || response_done_i.valid) || !response_queue_o.pending)

  `FV_ASSUME(clears_before_a_response, !aux_clear_i || serial_i || hold_i)

  always_comb begin
    offered = stored;
    if (!serial_i && (hold_i || (response_queue_o.pending && !response_queue_o.full))) offered[8:3] = '0;
    first = '0;
    for (int unsigned n = 8; n >= 1; n--) if (offered[n]) first = 4'(n);
  end

  always_ff @(posedge clk_i) begin
    if (!rst_ni || done) loaded_q <= 1'b0;
    else if (load) loaded_q <= 1'b1;
    if (load) class_q <= first;
  end

  // ---- classes 1, 3, 4, 5 -------------------------------------------------------------------------

  logic [1:0] alarm_q;
  end_cause_t cause_q;
  logic [31:0] pos_q;
  logic [5:1] event_in, free;  // free: no report of this class is stored, or it is being replaced or read

  assign event_in = {
    axis_event_i.stop, axis_event_i.hold_end, axis_event_i.unlock, 1'b0, axis_event_i.alarm.valid
  };
  for (genvar n = 1; n <= 5; n++) begin : g_class
    assign free[n] = !stored[n] || (done && class_read == 4'(n));
    if (n != 2) begin : g_event
      logic stored_q;
      assign stored[n] = stored_q;
      always_ff @(posedge clk_i)
        stored_q <= rst_ni && ((stored_q && !(done && class_read == 4'(n))) ||
        // An alarm in the cycle in which the host ends reading the previous alarm is part of that alarm.
        (event_in[n] && (n != 1 || serial_i || !(done && class_read == 4'd1))));
    end
  end

  always_ff @(posedge clk_i) begin
    if (event_in[1] && !stored[1]) alarm_q <= axis_event_i.alarm.code;
    if (event_in[5] && (serial_i || free[5])) {cause_q, pos_q} <= {axis_event_i.cause, pos_i};
  end

  `FV_ASSERT(discards_if_in_use, discarded_o.valid == (!serial_i && (event_in[5:3] & ~free[5:3]) != '0))
  `FV_ASSERT(code_of_discarded,
             !discarded_o.valid || discarded_o.code == (event_in[5] && !free[5] ? 2'd3 : 2'd2))

  // ---- class 2: a response that can be read, and one that waits -----------------------------------

  logic full_q, waiting_q, result_q;
  logic [1:0][BLOCK_BITS:0] size_q;  // [0]: response that can be read, [1]: response that waits
  logic [1:0] host_q, bank_q;
  trigger_result_e trigger_result_q;

  assign stored[2] = full_q || result_q;

  always_ff @(posedge clk_i) begin
    if (!rst_ni) {full_q, waiting_q, result_q} <= '0;
    else begin
      full_q <= (waiting_q && !full_q) || (full_q && !(done && class_read == 4'd2));
      waiting_q <= (response_done_i.valid && !serial_i) || (waiting_q && full_q);
      result_q  <= (response_done_i.valid && serial_i && !response_done_i.host) ||
                   (result_q && !(done && class_read == 4'd2));
    end
    if (response_done_i.valid) begin
      {size_q[1], host_q[1], bank_q[1]} <= {
        response_done_i.size, response_done_i.host, dut.u_answers.waddr_i[BLOCK_BITS]
      };
      if (!response_done_i.host) trigger_result_q <= response_done_i.trigger_result;
    end
    if (waiting_q && !full_q) {size_q[0], host_q[0], bank_q[0]} <= {size_q[1], host_q[1], bank_q[1]};
  end

  `FV_ASSERT(response_status, response_queue_o == {full_q, full_q && host_q[0], waiting_q})
  `FV_ASSERT(reads_entry_of_the_response, !full_q || dut.u_answers.raddr_i == {bank_q[0], rd_addr_i})
  `FV_ASSERT(writes_other_entry,
             !(full_q && dut.u_answers.we_i) || dut.u_answers.waddr_i[BLOCK_BITS] != bank_q[0])
  `FV_ASSERT(lemma_entry, serial_i || !waiting_q || bank_q[1] == !dut.bank_q)
  `FV_ASSERT(lemma_size, !waiting_q || dut.pending_size_q == size_q[1] && dut.pending_host_q == host_q[1])

  // ---- class 6: two reports, the second has the newest data ---------------------------------------

  logic [1:0] number_q;  // stored reports
  logic [1:0][8:0] aux_q;  // {an older report was discarded, data}; [0]: first report
  logic read_aux, reading_aux;

  assign stored[6] = number_q != '0;
  assign read_aux = done && class_read == 4'd6;
  assign reading_aux = loaded_q && class_q == 4'd6 && !read_aux;

  always_ff @(posedge clk_i) begin
    if (!rst_ni) number_q <= '0;
    else if (aux_clear_i) number_q <= 2'(reading_aux);
    else begin
      if (read_aux) aux_q[0] <= aux_q[1];
      if (aux_i) aux_q[(number_q-2'(read_aux))!='0] <= {number_q == 2'd2 && !read_aux, aux_data_i};
      number_q <= number_q - 2'(read_aux) + 2'(aux_i && !(number_q == 2'd2 && !read_aux));
    end
  end

  // ---- classes 7 and 8, order ---------------------------------------------------------------------

  logic value_q;  // contents of the loaded report of class 7 or 8
  assign stored[8:7] = monitor_req_i.pending;
  always_ff @(posedge clk_i) if (load) value_q <= monitor_req_i.outside[first==4'd8];

  `FV_ASSERT(acknowledges_load, monitor_ack_o.load == ({2{rd_load_i}} & {first == 4'd8, first == 4'd7}))
  `FV_ASSERT(acknowledges_read, monitor_ack_o.read == ({2{done}} & {class_read == 4'd8, class_read == 4'd7}))
  `FV_ASSERT(lemma_stored,
             {dut.once_q, dut.alarm_full_q, dut.aux_count_q} == {stored[5:3], stored[1], number_q})
  `FV_ASSERT(lemma_loaded, dut.loaded_q == loaded_q && (!loaded_q || dut.class_q == class_q))
  `FV_ASSERT(offers_if_stored, rd_any_o == (offered != '0 && !loaded_q))
  `FV_ASSERT(loaded_stays, !loaded_q || class_q > 4'd6 || stored[class_q])

  // ---- bytes of a report --------------------------------------------------------------------------

  logic [7:0][7:0] report_bytes;  // [0]: header
  logic [2:0] size;  // bytes after the length byte

  always_comb begin
    report_bytes = {pos_q[7:0], pos_q[15:8], pos_q[23:16], pos_q[31:24], 32'h0000_0023};
    size = 3'd2;
    unique case (class_q)
      4'd3: {size, report_bytes[2]} = {3'd1, A_UNLOCK};
      4'd4: {size, report_bytes[2]} = {3'd1, A_HOLD_END};
      4'd5: {size, report_bytes[2], report_bytes[3]} = {3'd6, A_STOP, cause_q};
      4'd6: {size, report_bytes[2], report_bytes[3], report_bytes[4]} = {3'd3, A_AUX, 7'd0, aux_q[0]};
      4'd7: {report_bytes[2], report_bytes[3]} = {A_INPOS, 7'd0, value_q};
      4'd8: {report_bytes[2], report_bytes[3]} = {A_ENCODE, 7'd0, value_q};
      default: {report_bytes[2], report_bytes[3]} = {A_ALARM, 6'd0, alarm_q};
    endcase
    report_bytes[1] = 8'(size);
  end

  logic [1:0][BLOCK_BITS-1:0] addr_q;  // rd_addr_i, delayed by one and two cycles
  logic loaded_dly_q, reads_byte;  // reads_byte: rd_data_o is a byte of a report of another class than 2
  always_ff @(posedge clk_i) {addr_q, loaded_dly_q} <= {addr_q[0], rd_addr_i, rst_ni && loaded_q};
  assign reads_byte = loaded_q && loaded_dly_q && class_q != 4'd2 && 6'(addr_q[1]) < rd_size_o;

  `FV_ASSERT(size_of_report, !loaded_q || class_q == 4'd2 || rd_size_o == 6'(size) + 6'd2)
  `FV_ASSERT(size_of_response, !(loaded_q && class_q == 4'd2) || rd_size_o == size_q[0])
  `FV_ASSERT(bytes_of_report, !reads_byte || rd_data_o == report_bytes[addr_q[1][2:0]])
  `FV_ASSERT(bytes_of_response, !(loaded_q && class_q == 4'd2) || rd_data_o == dut.u_answers.rdata_o)
  `FV_ASSERT(poll_first_class, poll_result_o.report_class == first)
  `FV_ASSERT(poll_trigger, !(serial_i && first == 4'd2) || poll_result_o.trigger_result == trigger_result_q)
  `FV_ASSERT(poll_cause, !(serial_i && first == 4'd5) || poll_result_o.cause == cause_q)
  `FV_ASSERT(poll_data,
             !(serial_i && first == 4'd6) || {poll_result_o.discarded, poll_result_o.data} == aux_q[0])
  `FV_COVER(seen_replaced_data, loaded_q && class_q == 4'd6 && aux_q[0][8])
  `FV_COVER(seen_second_response, done && class_q == 4'd2 && waiting_q && loaded_q && !serial_i)
  `FV_COVER(seen_discarded_stop, discarded_o.valid && discarded_o.code == 2'd3)
  `FV_COVER(seen_poll, serial_i && done && first == 4'd5)

endmodule

`default_nettype wire
