// SPDX-License-Identifier: Apache-2.0
// ppmc312_report_queue: stores reports until the host has read them. Each of the eight classes of reports has
//         a separate queue.
// Rules:  P312-RSP-10/11/20/21, P312-SER-21/22/30.
// Timing: an event is stored one cycle later. rd_size_o and the bytes are valid 2 cycles after rd_load_i.
// Note:   parallel mode: the queue of class 2 has two entries. The host reads one entry while the next
//         response is written to the other. A complete response (response_done_i) becomes readable when the
//         previous response has been read.
// Note:   serial mode: the station reads a response to the host from the entry to which it was written. As
//         reports, class 2 contains only the results of triggered instructions; a newer result replaces a
//         pending result. rd_load_i consumes a report.
`include "ppmc_assert.svh"
`default_nettype none

module ppmc312_report_queue
  import ppmc312_pkg::*;
  import ppmc312_link_pkg::*;
  import ppmc312_serial_pkg::*;
(
    input wire logic clk_i,  // clock
    input wire logic rst_ni,  // reset, asynchronous
    input wire logic serial_i,  // 1: the front end is the serial station
    // events
    input wire axis_event_t axis_event_i,  // events of classes 1, 3, 4, 5
    input wire logic [31:0] pos_i,  // position in pulses; valid with axis_event_i.stop
    output alarm_event_t discarded_o,  // multiple occurrence: a report of class 3, 4 or 5 is discarded
    input wire response_write_t response_write_i,  // class 2: byte of a response
    input wire response_done_t response_done_i,  // class 2: a response is complete
    output response_queue_t response_queue_o,  // class 2: status of the queue
    input wire logic aux_clear_i,  // class 6, strobe: discard pending reports
    input wire logic aux_i,  // class 6, strobe: the generalized input has changed
    input wire logic [7:0] aux_data_i,  // class 6: changed bits; valid with aux_i
    input wire monitor_req_t monitor_req_i,  // classes 7 and 8: pending reports of the monitors
    output monitor_ack_t monitor_ack_o,  // classes 7 and 8: a report is being loaded, or has been read
    // front end
    input wire logic hold_i,  // 1: a response follows soon; only classes 1 and 2 are offered
    output logic rd_any_o,  // a report is pending
    input wire logic rd_load_i,  // strobe: load the next report
    output poll_result_t poll_result_o,  // serial mode: report that rd_load_i consumes
    output logic [BLOCK_BITS:0] rd_size_o,  // bytes of the loaded report, 3 .. 32
    input wire logic [BLOCK_BITS-1:0] rd_addr_i,  // byte of the report, 0 = header
    output logic [7:0] rd_data_o,  // byte at rd_addr_i, two cycles later
    input wire logic rd_done_i  // strobe: the report has been read
);

  logic [8:1] pending, offered;
  logic hold, load, done;
  logic [3:0] lowest, class_q, class_done;
  trigger_result_e trigger_result_q;
  logic class2_pending_q;  // serial mode: a report of class 2 is pending
  logic loaded_q, bank_q, value, value_q, aux_busy, shift, host_q;
  logic [1:0] alarm_q;
  logic [5:3] once_q, once, once_done;
  logic alarm_full_q, full_q, pending_q;
  logic [1:0] aux_count_q;
  logic [1:0][7:0] aux_q;
  logic aux_discarded_q, aux_flag_q;
  logic [BLOCK_BITS:0] size_q, pending_size_q;
  end_cause_t cause_q;
  logic [31:0] pos_q;
  logic [7:0] ram_byte, local_byte, local_q, code;
  logic [2:0] local_size, local_at_q;

  // ---- pending reports, next report ---------------------------------------------------------------

  assign pending = {
    monitor_req_i.pending,
    aux_count_q != '0,
    once_q[5],
    once_q[4],
    once_q[3],
    full_q || class2_pending_q,
    alarm_full_q
  };
  // Reports that are caused by an instruction are offered after the response to this instruction.
  assign hold = !serial_i && (hold_i || (pending_q && !full_q));
  assign offered = hold ? {6'd0, pending[2:1]} : pending;
  assign rd_any_o = offered != '0 && !loaded_q;

  always_comb begin
    lowest = 4'd8;
    for (int unsigned n = 8; n >= 1; n--) if (offered[n]) lowest = 4'(n);
  end

  assign load = rd_load_i && !serial_i;
  assign done = serial_i ? rd_load_i && offered != '0 : rd_done_i;
  assign class_done = serial_i ? lowest : class_q;
  assign monitor_ack_o.load = {rd_load_i && lowest == 4'd8, rd_load_i && lowest == 4'd7} &
      monitor_req_i.pending;
  assign monitor_ack_o.read = {done && class_done == 4'd8, done && class_done == 4'd7};
  assign value = monitor_req_i.outside[lowest==4'd8];
  assign poll_result_o = '{
          report_class: (offered == '0) ? 4'd0 : lowest,
          trigger_result: trigger_result_q,
          cause: cause_q,
          discarded: aux_flag_q,
          data: aux_q[0],
          outside: value
      };

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      loaded_q <= 1'b0;
      class_q  <= 4'd1;
      value_q  <= 1'b0;
    end else if (load) begin
      loaded_q <= 1'b1;
      class_q  <= lowest;
      value_q  <= value;
    end else if (done) begin
      loaded_q <= 1'b0;
    end
  end

  // ---- classes 1, 3, 4, 5 -------------------------------------------------------------------------

  assign once = {axis_event_i.stop, axis_event_i.hold_end, axis_event_i.unlock};
  assign once_done = {class_done == 4'd5, class_done == 4'd4, class_done == 4'd3} & {3{done}};
  assign discarded_o = '{
          valid: !serial_i && (once & once_q & ~once_done) != '0,
          code: (axis_event_i.stop && once_q[5] && !once_done[5]) ? 2'd3 : 2'd2
      };

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      alarm_full_q <= 1'b0;
      alarm_q      <= '0;
      once_q       <= '0;
      cause_q      <= '0;
      pos_q        <= '0;
    end else begin
      once_q <= (once_q & ~once_done) | once;
      if (axis_event_i.stop && (serial_i || !once_q[5] || once_done[5])) begin
        cause_q <= axis_event_i.cause;
        pos_q   <= pos_i;
      end
      if (done && class_done == 4'd1 && !(serial_i && axis_event_i.alarm.valid)) alarm_full_q <= 1'b0;
      else if (axis_event_i.alarm.valid && !alarm_full_q) begin
        alarm_full_q <= 1'b1;
        alarm_q      <= axis_event_i.alarm.code;
      end
    end
  end

  // ---- class 2 ------------------------------------------------------------------------------------

  assign response_queue_o = '{full: full_q, full_host: full_q && host_q, pending: pending_q};

  logic pending_host_q, promote;
  assign promote = pending_q && !full_q;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      full_q           <= 1'b0;
      pending_q        <= 1'b0;
      bank_q           <= 1'b0;
      host_q           <= 1'b0;
      pending_host_q   <= 1'b0;
      trigger_result_q <= DoneOverride;
      class2_pending_q <= 1'b0;
      size_q           <= '0;
      pending_size_q   <= '0;
    end else begin
      if (response_done_i.valid && !serial_i) begin
        pending_q      <= 1'b1;
        pending_size_q <= response_done_i.size;
        pending_host_q <= response_done_i.host;
      end else if (promote) pending_q <= 1'b0;
      if (serial_i && response_done_i.valid && !response_done_i.host) begin
        class2_pending_q <= 1'b1;
        trigger_result_q <= response_done_i.trigger_result;
      end else if (done && class_done == 4'd2) class2_pending_q <= 1'b0;
      if (promote) begin
        full_q <= 1'b1;
        bank_q <= !bank_q;
        size_q <= pending_size_q;
        host_q <= pending_host_q;
      end else if (done && class_done == 4'd2) full_q <= 1'b0;
    end
  end

  ppmc_ram #(
      .Width   (8),
      .AddrBits(BLOCK_BITS + 1)
  ) u_answers (
      .clk_i,
      .we_i   (response_write_i.we && (!serial_i || response_done_i.host)),
      .waddr_i({!bank_q, response_write_i.addr}),
      .wdata_i(response_write_i.data),
      .raddr_i({bank_q ^ serial_i, rd_addr_i}),
      .rdata_o(ram_byte)
  );

  // ---- class 6: two entries, the second holds the newest data -------------------------------------

  assign aux_busy = loaded_q && class_q == 4'd6;
  assign shift = done && class_done == 4'd6;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      aux_count_q     <= '0;
      aux_q           <= '0;
      aux_discarded_q <= 1'b0;
    end else if (aux_clear_i) begin
      aux_count_q <= (aux_busy && !shift) ? 2'd1 : 2'd0;
    end else begin
      aux_count_q <= aux_count_q - 2'(shift) + 2'(aux_i && (shift || aux_count_q != 2'd2));
      if (shift) aux_q[0] <= aux_q[1];
      if (aux_i && aux_count_q == 2'(shift)) aux_q[0] <= aux_data_i;
      else if (aux_i) aux_q[1] <= aux_data_i;
      if (aux_i && aux_count_q == 2'd2 && !shift) aux_discarded_q <= 1'b1;
      else if (aux_i && aux_count_q[0] != shift) aux_discarded_q <= 1'b0;
    end
  end

  // aux_discarded_q belongs to the data of the second entry. It moves with these data to the first entry.
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) aux_flag_q <= 1'b0;
    else if (shift) aux_flag_q <= aux_discarded_q && aux_count_q == 2'd2;
    else if (aux_count_q == '0) aux_flag_q <= 1'b0;
  end

  // ---- bytes --------------------------------------------------------------------------------------

  always_comb begin
    local_size = 3'd2;
    unique case (class_q)
      4'd3: {code, local_size} = {A_UNLOCK, 3'd1};
      4'd4: {code, local_size} = {A_HOLD_END, 3'd1};
      4'd5: {code, local_size} = {A_STOP, 3'd6};
      4'd6: {code, local_size} = {A_AUX, 3'd3};
      4'd7: code = A_INPOS;
      4'd8: code = A_ENCODE;
      default: code = A_ALARM;
    endcase
  end

  always_comb begin
    unique case (local_at_q)
      3'd0:    local_byte = 8'h23;
      3'd1:    local_byte = 8'(local_size);
      3'd2:    local_byte = code;
      3'd3: begin
        unique case (class_q)
          4'd5:       local_byte = cause_q;
          4'd6:       local_byte = 8'(aux_flag_q);
          4'd7, 4'd8: local_byte = 8'(value_q);
          default:    local_byte = 8'(alarm_q);
        endcase
      end
      3'd4:    local_byte = (class_q == 4'd6) ? aux_q[0] : pos_q[31:24];
      3'd5:    local_byte = pos_q[23:16];
      3'd6:    local_byte = pos_q[15:8];
      default: local_byte = pos_q[7:0];
    endcase
  end

  // Two registers delay these bytes, so that they have the same latency as the bytes of the RAM.
  always_ff @(posedge clk_i) begin
    local_at_q <= rd_addr_i[2:0];
    local_q <= local_byte;
  end

  assign rd_size_o = (class_q == 4'd2) ? size_q : (BLOCK_BITS + 1)'(local_size) + (BLOCK_BITS + 1)'(2);
  assign rd_data_o = (serial_i || class_q == 4'd2) ? ram_byte : local_q;

`ifndef SYNTHESIS
  `PPMC_ASSERT(p312_rsp_10_order, !load || offered != '0)
  `PPMC_ASSERT(p312_rsp_20_bank, !(response_write_i.we && pending_q))
`endif

endmodule

`default_nettype wire
