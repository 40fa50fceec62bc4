// SPDX-License-Identifier: Apache-2.0
// ppmc_bank_window_fv: the window, driven by the strobe master of the bridges, with an engine that accepts
// and answers bytes at any time.
// The proof is for one axis, regardless of accesses to the others. A visit reads the last byte that the host
// has written, unchanged, and the byte is new until it was accepted. The bytes of an answer are read in
// order, each once.
`include "ppmc_fv.svh"
`default_nettype none

module ppmc_bank_window_fv
  import ppmc_bank_pkg::*;
(
    input wire logic        clk_i,
    // host
    input wire logic        req_i,
    input wire logic        we_i,
    input wire logic [ 9:0] addr_i,
    input wire logic [ 7:0] wdata_i,
    // engine
    input wire logic        want_i,         // the engine accepts a byte if one is waiting
    input wire logic        answers_i,      // the engine answers the byte it accepts
    input wire logic        long_i,         // the answer has three bytes
    input wire logic [23:0] answer_data_i,
    input wire logic [ 6:0] others_i,       // status of other axes; of the watched axis, all except taken
    input wire logic [ 1:0] position_i,     // positions
    input wire logic [ 3:0] map_i           // pending interrupts
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

  // ---- visits, as ppmc_bank_scheduler and ppmc_bank_engine make them --------------------------------------

  logic [2:0] axis_q, done_axis;
  logic [3:0] clear_q;  // remaining cycles of the reset of all axes
  logic ready, mine_1, mine_3, mine_5;  // mine_n: the visit of the watched axis is in stage n
  mail_t mail, mail_q;
  progress_t progress, progress_q;
  logic [1:0] config_n, taken_q, answer_seq_q, new_taken_q;
  logic take_q, answer_q, long_q;
  logic    [23:0] data_q;
  status_t        status;
  answer_t        answer;
  logic           answered;

  assign ready     = clear_q == '0;
  assign done_axis = axis_q - 3'd5;
  assign mine_1    = ready && axis_q == Axis + 3'd1;
  assign mine_3    = ready && axis_q == Axis + 3'd3;
  assign mine_5    = ready && done_axis == Axis;

  always_ff @(posedge clk_i)
    if (!rst_ni) begin
      {axis_q, clear_q} <= {3'd0, 4'd15};
      {taken_q, answer_seq_q, new_taken_q, answer_q, mail_q, progress_q} <= '0;
    end else begin
      axis_q <= axis_q + 1'b1;
      if (!ready) clear_q <= clear_q - 1'b1;
      if (mine_1) {mail_q, progress_q} <= {mail, progress};
      if (mine_3) begin
        new_taken_q <= (want_i && mail_q.seq != taken_q) ? mail_q.seq : taken_q;
        {answer_q, long_q, data_q} <= {answers_i && want_i && mail_q.seq != taken_q, long_i, answer_data_i};
      end
      if (mine_5) begin
        taken_q <= new_taken_q;
        if (answer_q) answer_seq_q <= answer.seq;
      end
    end

  assign status = mine_5 ?
      '{taken: new_taken_q, error: others_i[4], number: others_i[3:1], busy: others_i[0]}
      : ready ? others_i : '0;
  assign answered = mine_5 && answer_q;
  // As in ppmc_bank_update.
  always_comb begin
    answer.seq = answer_seq_q + 2'd1;
    if (answer.seq == progress_q.seq) answer.seq = answer_seq_q + 2'd2;
    answer.bytes = long_q ? 2'd3 : 2'd1;
    answer.data  = data_q;
  end

  ppmc_bank_window #(
      .Axes     (4),
      .RoundBits(3)
  ) dut (
      .clk_i,
      .rst_ni,
      .a_i        (a),
      .cs_ni      (cs_n),
      .rd_ni      (rd_n),
      .wr_ni      (wr_n),
      .d_i        (master_d),
      .d_o        (d),
      .d_oe_o     (d_oe),
      .ready_i    (ready),
      .axis_i     (axis_q),
      .mail_o     (mail),
      .progress_o (progress),
      .config_no  (config_n),
      .done_axis_i(done_axis),
      .status_i   (status),
      .position_i (ready ? 32'(position_i) : '0),
      .answer_we_i(answered || !ready),
      .answer_i   (ready ? answer : answer_t'(0)),
      .map_i,
      .mask_o     (mask),
      .go_o       (go),
      .stop_o     (stop)
  );

  // ---- input buffer ----------------------------------------------------------------------------------

  // written: a byte is written; full_q: a byte is waiting; seen_q: the current visit has read a waiting byte
  logic written, full_q, seen_q;
  logic late_q;  // a byte was written after the read of that visit
  logic [8:0] held_q, byte_seen_q;

  assign written = dut.write && dut.wa_q[9:4] == 6'(Axis) && dut.wa_q[3:1] == '0;

  always_ff @(posedge clk_i)
    if (!rst_ni) {full_q, seen_q, held_q, byte_seen_q} <= '0;
    else begin
      // The host may replace a byte after the visit has read it. The new byte is still waiting.
      if (written) {full_q, held_q} <= {1'b1, dut.wa_q[0], dut.wd_q};
      else if (mine_5 && taken_q != new_taken_q && !late_q) full_q <= 1'b0;
      if (axis_q == Axis) {seen_q, byte_seen_q} <= {full_q, held_q};
    end

  always_ff @(posedge clk_i) late_q <= rst_ni && (written || (late_q && axis_q != Axis));

  `FV_ASSERT(bank_hsk_01_new_is_seen, !mine_1 || (mail.seq != taken_q) == seen_q)
  `FV_ASSERT(bank_hsk_03_as_written, !(mine_1 && seen_q) || {mail.command, mail.data} == byte_seen_q)
  `FV_COVER(seen_replaced_while_taken, mine_5 && taken_q != new_taken_q && late_q && full_q)

  // ---- answers ---------------------------------------------------------------------------------------

  typedef struct packed {
    logic        newest;  // no other answer has been written since
    logic [1:0]  bytes;
    logic [1:0]  read;    // bytes already read
    logic [23:0] data;
  } answer_view_t;

  answer_view_t now_q, view1_q, view2_q;  // now_q: current state; view1_q, view2_q: its copies in a read
  // shows: a data byte is loaded; there: an unread byte is left; current_q: the loaded byte is of the last
  // answer
  logic shows, there, current_q;
  logic [7:0] byte_q;
  logic shows_q, there_q;

  assign shows = dut.load && ready && dut.ready_q && dut.a2 == {6'(Axis), REG_DATA};
  assign there = view2_q.read < view2_q.bytes;

  always_ff @(posedge clk_i)
    if (!rst_ni) {now_q, view1_q, view2_q, current_q, byte_q, shows_q, there_q} <= '0;
    else begin
      if (answered) now_q <= '{newest: 1'b1, bytes: answer.bytes, read: '0, data: data_q};
      else if (dut.read_done && dut.shown_q && dut.seen_q == Axis && current_q)
        now_q.read <= now_q.read + 1'b1;
      view1_q <= now_q;
      if (!dut.clash_q) view2_q <= view1_q;
      if (answered) {view1_q.newest, view2_q.newest} <= '0;
      else if (!dut.clash_q) view2_q.newest <= view1_q.newest;
      if (shows) current_q <= view2_q.newest && !answered;
      else if (answered) current_q <= 1'b0;
      {shows_q, there_q} <= {shows, there};
      byte_q <= 8'(view2_q.data >> {view2_q.read, 3'd0});
    end

  `FV_ASSERT(bank_hsk_04_there_until_all_are_read, !shows_q || dut.shown_q == there_q)
  `FV_ASSERT(bank_hsk_04_in_order, !(shows_q && there_q) || d == byte_q)
  `FV_ASSERT(bank_hsk_04_never_more_than_there_are, now_q.read <= now_q.bytes)
  // ---- registers as of edge 2 of the read ------------------------------------------------------------

  // A visit writes its status one cycle before its edge, and pending interrupts change with it. A read that
  // loads d_o two cycles later returns the registers of this cycle.
  typedef struct packed {
    logic [3:0] map, mask;
    logic [4:0] status;
    logic [1:0] config_n, position;
  } bank_view_t;

  bank_view_t bank, bank1_q, bank2_q;
  logic [4:0] status_q;
  logic [1:0] config_q, position_q;
  logic [3:0] register_q;
  logic mine_q, first_q;
  logic [7:0] map_q, mask_q, status2_q, config2_q, position2_q;

  assign bank = '{map: map_i, mask: mask, status: status_q, config_n: config_q, position: position_q};

  always_ff @(posedge clk_i)
    if (!rst_ni) {status_q, config_q, position_q, bank1_q, bank2_q, mine_q, first_q} <= '0;
    else begin
      if (done_axis == Axis) {status_q, position_q} <= {status[4:0], ready ? position_i : 2'd0};
      if (!ready) config_q <= '0;
      else if (dut.write && dut.wa_q == {6'(Axis), REG_CONFIG}) config_q <= ~dut.wd_q[1:0];
      {bank2_q, bank1_q} <= {bank1_q, bank};
      register_q         <= dut.a2[3:0];
      mine_q             <= dut.load && dut.ready_q && dut.a2[9:4] == 6'(Axis);
      first_q            <= dut.load && dut.ready_q && dut.a2[9:4] == '0;
      map_q              <= 8'(bank2_q.map);
      mask_q             <= 8'(bank2_q.mask);
      status2_q          <= {bank2_q.status[4:1], 1'b0, bank2_q.status[0], 2'b00};
      position2_q        <= 8'(bank2_q.position);
      config2_q          <= {6'd0, ~bank2_q.config_n};
    end

  `FV_ASSERT(bank_win_05_map, !(first_q && register_q == REG_MAP) || d == map_q)
  `FV_ASSERT(bank_win_05_mask, !(first_q && register_q == REG_MASK) || d == mask_q)
  `FV_ASSERT(bank_win_05_status, !(mine_q && register_q == REG_STATUS) || {d[7:2], 2'b00} == status2_q)
  `FV_ASSERT(bank_win_05_config, !(mine_q && register_q == REG_CONFIG) || d == config2_q)
  `FV_ASSERT(bank_win_05_position, !(mine_q && register_q == REG_POSITION) || d == position2_q)
  `FV_COVER(seen_map_during_a_clash, first_q && register_q == REG_MAP && $past(dut.clash_q) && d != '0)

  `FV_COVER(seen_answer_while_read, answered && dut.shown_q && current_q && now_q.read == 2'd1)

endmodule

`default_nettype wire
