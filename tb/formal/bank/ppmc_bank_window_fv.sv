// SPDX-License-Identifier: Apache-2.0
// ppmc_bank_window_fv: the window, driven by the strobe master of the bridges. The engine may accept bytes
// and respond to them at any time.
// The proof is for one axis, regardless of accesses to other axes. A visit reads the last byte that the
// host has written, unchanged, and the byte is new until it has been accepted. The bytes of a response are
// read in order, and each byte is read once.
`include "ppmc_fv.svh"
`default_nettype none

module ppmc_bank_window_fv
  import ppmc_bank_pkg::*;
(
    input wire logic clk_i,
    // host
    input wire logic req_i,
    input wire logic we_i,
    input wire logic [9:0] addr_i,
    input wire logic [7:0] wdata_i,
    // engine
    input wire logic accept_i,  // 1: the engine accepts a byte if one is pending
    input wire logic respond_i,  // 1: the engine responds to the byte that it accepts
    input wire logic three_bytes_i,  // 1: the response has three bytes
    input wire logic [23:0] read_data_bytes_i,
    input wire logic [6:0] other_status_i,  // status of every axis; ack_seq of the watched axis is separate
    input wire logic [1:0] position_i,  // position of every axis (the same value)
    input wire logic [3:0] map_i  // pending interrupts
);

  localparam logic [2:0] Axis = 3'd2;  // the watched axis

  logic master_ready, done, cs_n, rd_n, wr_n, d_oe, go, stop;
  logic [9:0] a;
  logic [7:0] master_d, d, rdata;
  logic [3:0] mask;

  `FV_RESET

  ppmc_strobe_master #(
      .AddrBits(10)
  ) u_master (
      .clk_i,
      .rst_ni,
      .req_i,
      .we_i,
      .addr_i,
      .wdata_i,
      .ready_o(master_ready),
      .done_o (done),
      .rdata_o(rdata),
      .cs_no  (cs_n),
      .rd_no  (rd_n),
      .wr_no  (wr_n),
      .a_o    (a),
      .d_o    (master_d),
      .d_i    (d)
  );

  // ---- visits, as in ppmc_bank_scheduler and ppmc_bank_engine ----------------------------------------

  logic [2:0] axis_q, done_axis;
  logic [3:0] clear_q;  // remaining cycles of the reset of all axes
  logic ready, watched_s1, watched_s3, watched_s5;  // watched_sN: the watched axis is in stage N
  in_buf_t in_buf, in_buf_q;
  read_progress_t read_progress, read_progress_q;
  logic [1:0] config_n, ack_seq_q, read_data_seq_q, next_ack_seq_q;
  logic take_q, respond_q, three_bytes_q;
  logic         [23:0] data_q;
  axis_status_t        status;
  read_data_t          read_data;
  logic                read_data_stored;

  assign ready      = clear_q == '0;
  assign done_axis  = axis_q - 3'd5;
  assign watched_s1 = ready && axis_q == Axis + 3'd1;
  assign watched_s3 = ready && axis_q == Axis + 3'd3;
  assign watched_s5 = ready && done_axis == Axis;

  always_ff @(posedge clk_i)
    if (!rst_ni) begin
      {axis_q, clear_q} <= {3'd0, 4'd15};
      {ack_seq_q, read_data_seq_q, next_ack_seq_q, respond_q, in_buf_q, read_progress_q} <= '0;
    end else begin
      axis_q <= axis_q + 1'b1;
      if (!ready) clear_q <= clear_q - 1'b1;
      if (watched_s1) {in_buf_q, read_progress_q} <= {in_buf, read_progress};
      if (watched_s3) begin
        next_ack_seq_q <= (accept_i && in_buf_q.seq != ack_seq_q) ? in_buf_q.seq : ack_seq_q;
        {respond_q, three_bytes_q, data_q} <= {
          respond_i && accept_i && in_buf_q.seq != ack_seq_q, three_bytes_i, read_data_bytes_i
        };
      end
      if (watched_s5) begin
        ack_seq_q <= next_ack_seq_q;
        if (respond_q) read_data_seq_q <= read_data.seq;
      end
    end

  assign status = watched_s5 ?
      '{
          ack_seq: next_ack_seq_q,
          error: other_status_i[4],
          number: other_status_i[3:1],
          busy: other_status_i[0]
      }
      : ready ? other_status_i : '0;
  assign read_data_stored = watched_s5 && respond_q;
  // This is the logic of ppmc_bank_update.
  always_comb begin
    read_data.seq = read_data_seq_q + 2'd1;
    if (read_data.seq == read_progress_q.seq) read_data.seq = read_data_seq_q + 2'd2;
    read_data.bytes = three_bytes_q ? 2'd3 : 2'd1;
    read_data.data  = data_q;
  end

  ppmc_bank_window #(
      .Axes     (4),
      .RoundBits(3)
  ) dut (
      .clk_i,
      .rst_ni,
      .a_i            (a),
      .cs_ni          (cs_n),
      .rd_ni          (rd_n),
      .wr_ni          (wr_n),
      .d_i            (master_d),
      .d_o            (d),
      .d_oe_o         (d_oe),
      .ready_i        (ready),
      .axis_i         (axis_q),
      .in_buf_o       (in_buf),
      .read_progress_o(read_progress),
      .config_no      (config_n),
      .done_axis_i    (done_axis),
      .status_i       (status),
      .position_i     (ready ? 32'(position_i) : '0),
      .read_data_we_i (read_data_stored || !ready),
      .read_data_i    (ready ? read_data : read_data_t'(0)),
      .map_i,
      .mask_o         (mask),
      .go_o           (go),
      .stop_o         (stop)
  );

  // ---- input buffer ----------------------------------------------------------------------------------

  // byte_written: a byte is written; full_q: a byte is pending; visit_full_q: the current visit has read a
  // pending byte
  logic byte_written, full_q, visit_full_q;
  logic written_late_q;  // 1: a byte was written after this visit had read the buffer
  logic [8:0] in_buf_byte_q, visit_byte_q;

  assign byte_written = dut.write && dut.waddr_q[9:4] == 6'(Axis) && dut.waddr_q[3:1] == '0;

  always_ff @(posedge clk_i)
    if (!rst_ni) {full_q, visit_full_q, in_buf_byte_q, visit_byte_q} <= '0;
    else begin
      // The host may replace a byte after the visit has read it. Then the new byte is still pending.
      if (byte_written) {full_q, in_buf_byte_q} <= {1'b1, dut.waddr_q[0], dut.wdata_q};
      else if (watched_s5 && ack_seq_q != next_ack_seq_q && !written_late_q) full_q <= 1'b0;
      if (axis_q == Axis) {visit_full_q, visit_byte_q} <= {full_q, in_buf_byte_q};
    end

  always_ff @(posedge clk_i) written_late_q <= rst_ni && (byte_written || (written_late_q && axis_q != Axis));

  `FV_ASSERT(bank_hsk_01_new_byte_detected, !watched_s1 || (in_buf.seq != ack_seq_q) == visit_full_q)
  `FV_ASSERT(bank_hsk_03_as_written,
             !(watched_s1 && visit_full_q) || {in_buf.is_command, in_buf.data} == visit_byte_q)
  `FV_COVER(seen_replaced_while_accepted,
            watched_s5 && ack_seq_q != next_ack_seq_q && written_late_q && full_q)

  // ---- responses -------------------------------------------------------------------------------------

  typedef struct packed {
    logic        newest;  // 1: no newer response has been stored
    logic [1:0]  bytes;
    logic [1:0]  read;    // number of bytes that have been read
    logic [23:0] data;
  } read_queue_t;

  read_queue_t
      queue_q,
      queue_s1_q,
      queue_s2_q;  // queue_q: current state; queue_s1_q, queue_s2_q: copies of queue_q during a read
  // data_loaded: a data byte is loaded; unread_left: an unread byte is left; current_q: the loaded byte
  // belongs to the last response
  logic data_loaded, unread_left, current_q;
  logic [7:0] byte_q;
  logic data_loaded_q, unread_left_q;

  assign data_loaded = dut.load && ready && dut.ready_q && dut.a_s2 == {6'(Axis), REG_DATA};
  assign unread_left = queue_s2_q.read < queue_s2_q.bytes;

  always_ff @(posedge clk_i)
    if (!rst_ni) {queue_q, queue_s1_q, queue_s2_q, current_q, byte_q, data_loaded_q, unread_left_q} <= '0;
    else begin
      if (read_data_stored) queue_q <= '{newest: 1'b1, bytes: read_data.bytes, read: '0, data: data_q};
      else if (dut.read_done && dut.data_shown_q && dut.shown_axis_q == Axis && current_q)
        queue_q.read <= queue_q.read + 1'b1;
      queue_s1_q <= queue_q;
      if (!dut.collision_q) queue_s2_q <= queue_s1_q;
      if (read_data_stored) {queue_s1_q.newest, queue_s2_q.newest} <= '0;
      else if (!dut.collision_q) queue_s2_q.newest <= queue_s1_q.newest;
      if (data_loaded) current_q <= queue_s2_q.newest && !read_data_stored;
      else if (read_data_stored) current_q <= 1'b0;
      {data_loaded_q, unread_left_q} <= {data_loaded, unread_left};
      byte_q <= 8'(queue_s2_q.data >> {queue_s2_q.read, 3'd0});
    end

  `FV_ASSERT(bank_hsk_04_valid_until_all_read, !data_loaded_q || dut.data_shown_q == unread_left_q)
  `FV_ASSERT(bank_hsk_04_in_order, !(data_loaded_q && unread_left_q) || d == byte_q)
  `FV_ASSERT(bank_hsk_04_no_more_than_stored, queue_q.read <= queue_q.bytes)
  // ---- registers that a read returns -----------------------------------------------------------------

  // A visit writes its status one cycle before the first edge at which its pins can change. Pending
  // interrupts change in the same cycle. A read that loads d_o two cycles later returns the registers of this
  // cycle.
  typedef struct packed {
    logic [3:0] map, mask;
    logic [4:0] status;
    logic [1:0] config_n, position;
  } bank_regs_t;

  bank_regs_t regs, regs_q, regs_q2;
  logic [4:0] status_q;
  logic [1:0] config_n_q, position_q;
  logic [3:0] register_q;
  logic watched_q, first_q;
  logic [7:0] map_rd_q, mask_rd_q, status_rd_q, config_rd_q, position_rd_q;

  assign regs = '{map: map_i, mask: mask, status: status_q, config_n: config_n_q, position: position_q};

  always_ff @(posedge clk_i)
    if (!rst_ni) {status_q, config_n_q, position_q, regs_q, regs_q2, watched_q, first_q} <= '0;
    else begin
      if (done_axis == Axis) {status_q, position_q} <= {status[4:0], ready ? position_i : 2'd0};
      if (!ready) config_n_q <= '0;
      else if (dut.write && dut.waddr_q == {6'(Axis), REG_CONFIG}) config_n_q <= ~dut.wdata_q[1:0];
      {regs_q2, regs_q} <= {regs_q, regs};
      register_q        <= dut.a_s2[3:0];
      watched_q         <= dut.load && dut.ready_q && dut.a_s2[9:4] == 6'(Axis);
      first_q           <= dut.load && dut.ready_q && dut.a_s2[9:4] == '0;
      map_rd_q          <= 8'(regs_q2.map);
      mask_rd_q         <= 8'(regs_q2.mask);
      status_rd_q       <= {regs_q2.status[4:1], 1'b0, regs_q2.status[0], 2'b00};
      position_rd_q     <= 8'(regs_q2.position);
      config_rd_q       <= {6'd0, ~regs_q2.config_n};
    end

  `FV_ASSERT(bank_win_05_map, !(first_q && register_q == REG_MAP) || d == map_rd_q)
  `FV_ASSERT(bank_win_05_mask, !(first_q && register_q == REG_MASK) || d == mask_rd_q)
  `FV_ASSERT(bank_win_05_status, !(watched_q && register_q == REG_STATUS) || {d[7:2], 2'b00} == status_rd_q)
  `FV_ASSERT(bank_win_05_config, !(watched_q && register_q == REG_CONFIG) || d == config_rd_q)
  `FV_ASSERT(bank_win_05_position, !(watched_q && register_q == REG_POSITION) || d == position_rd_q)
  `FV_COVER(seen_map_during_collision, first_q && register_q == REG_MAP && $past(dut.collision_q) && d != '0)

  `FV_COVER(seen_read_data_during_read,
            read_data_stored && dut.data_shown_q && current_q && queue_q.read == 2'd1)

endmodule

`default_nettype wire
