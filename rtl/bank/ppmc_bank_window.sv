// SPDX-License-Identifier: Apache-2.0
// ppmc_bank_window: host interface of a bank: strobes, registers, one input buffer and one output queue for
//         each axis.
// Rules:  BANK-WIN-01..08, BANK-HSK-01/03/04, BANK-GEN-04/05, BANK-GRP-01..04.
// Timing: a write acts at the first edge after the end of its strobe has left the synchronisers. d_o is valid
//         from the third edge after the start of a read strobe has left them. mail_o, progress_o and
//         config_no are valid one cycle after axis_i.
// How:    the RAM words of the addressed axis are read in every cycle. If a visit writes these words in the
//         cycle in which they are read, the words read before are kept. The registers of the bank (other1_q,
//         other2_q) are updated in every cycle.
`default_nettype none

module ppmc_bank_window
  import ppmc_bank_pkg::*;
#(
    parameter int unsigned Axes      = 32,
    parameter int unsigned RoundBits = 5    // a round is 2^RoundBits cycles; at least Axes and 8
) (
    input  wire logic                    clk_i,
    input  wire logic                    rst_ni,
    // bus
    input  wire logic    [          9:0] a_i,          // axis and register
    input  wire logic                    cs_ni,        // chip select
    input  wire logic                    rd_ni,        // read strobe
    input  wire logic                    wr_ni,        // write strobe
    input  wire logic    [          7:0] d_i,          // data written by the host
    output logic         [          7:0] d_o,          // data read by the host
    output logic                         d_oe_o,       // the host is reading: drive d_o
    // visits
    input  wire logic                    ready_i,      // 0: the axes are being reset
    input  wire logic    [RoundBits-1:0] axis_i,       // axis of the next visit
    output mail_t                        mail_o,       // input buffer of axis_i
    output progress_t                    progress_o,   // bytes of the answer of axis_i that were read
    output logic         [          1:0] config_no,    // vsel and csel of axis_i, inverted
    input  wire logic    [RoundBits-1:0] done_axis_i,  // axis of the visit that ends
    input  wire status_t                 status_i,     // status of done_axis_i
    input  wire logic    [         31:0] position_i,   // position of done_axis_i
    input  wire logic                    answer_we_i,  // write answer_i
    input  wire answer_t                 answer_i,     // answer to a read command
    // bank
    input  wire logic    [     Axes-1:0] map_i,        // pending interrupts
    output logic         [     Axes-1:0] mask_o,       // members of the group
    output logic                         go_o,         // GO is written at the next edge
    output logic                         stop_o        // STOP is written at the next edge
);

  localparam int unsigned Slots = 1 << RoundBits;
  // With few axes, only the positions use block RAM, because small FPGAs have few of them. For the few bits
  // of a status the synthesis tool decides. Only attributes use these parameters, and simulation ignores
  // attributes.
  // verilator lint_off UNUSEDPARAM
  localparam string AnswerStyle = (Slots > 8) ? "block" : "logic";
  localparam string StatusStyle = (Slots > 8) ? "block" : "auto";
  // verilator lint_on UNUSEDPARAM

  // ---- bus -----------------------------------------------------------------------------------------

  logic cs1, rd1, wr1, cs2, rd2, wr2, read2, write2;
  logic [9:0] a1, a2;
  logic [7:0] d1, d2;
  logic unused_meta;

  assign unused_meta = ^{cs1, rd1, wr1, a1, d1};

  ppmc_sync #(
      .Width(21)
  ) u_sync (
      .clk_i,
      .rst_ni,
      .d_i ({cs_ni, rd_ni, wr_ni, a_i, d_i}),
      .q1_o({cs1, rd1, wr1, a1, d1}),
      .q2_o({cs2, rd2, wr2, a2, d2})
  );

  assign read2  = !cs2 && !rd2 && wr2;
  assign write2 = !cs2 && !wr2 && rd2;

  logic write3_q, read3_q, read4_q, read5_q, write, read_done, load;
  logic [9:0] wa_q;
  logic [7:0] wd_q;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {write3_q, read3_q, read4_q, read5_q, d_oe_o} <= '0;
      wa_q <= '0;
      wd_q <= '0;
    end else begin
      write3_q <= write2;
      if (write2) {wa_q, wd_q} <= {a2, d2};
      {read5_q, read4_q, read3_q} <= {read4_q, read3_q, read2};
      d_oe_o <= read2;
    end
  end

  assign write     = write3_q && !write2 && ready_i && 32'(wa_q[9:4]) < Axes;
  assign read_done = read3_q && !read2;
  assign load      = read4_q && !read5_q && read2;

  // ---- data written by the host --------------------------------------------------------------------

  mail_t mails[Slots];
  progress_t progresses[Slots];
  logic [1:0] configs_n[Slots];
  mail_t mail_w;
  progress_t progress_w, taken_q;
  logic [RoundBits-1:0] mail_at, config_at, progress_at, seen_q;
  logic mail_we, config_we, progress_we, shown_q;

  initial
    for (int unsigned i = 0; i < Slots; i++) begin
      mails[i]      = '0;
      progresses[i] = '0;
      configs_n[i]  = '0;
    end

  // All words are cleared while the bank is not ready.
  assign mail_we     = !ready_i || (write && wa_q[3:1] == 3'd0);
  assign config_we   = !ready_i || (write && wa_q[3:0] == REG_CONFIG);
  assign progress_we = !ready_i || (read_done && shown_q);
  assign mail_at     = ready_i ? RoundBits'(wa_q[9:4]) : axis_i;
  assign config_at   = mail_at;
  assign progress_at = ready_i ? seen_q : axis_i;
  assign progress_w  = ready_i ? taken_q : '0;

  always_ff @(posedge clk_i) begin
    if (mail_we) mails[mail_at] <= mail_w;
    if (config_we) configs_n[config_at] <= ready_i ? ~wd_q[1:0] : '0;
    if (progress_we) progresses[progress_at] <= progress_w;
    mail_o     <= mails[axis_i];
    progress_o <= progresses[axis_i];
    config_no  <= configs_n[axis_i];
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) mask_o <= '0;
    else if (write && wa_q[3:0] == REG_MASK) begin
      for (int unsigned i = 0; i < Axes; i++) if (wa_q[6:4] == 3'(i / 8)) mask_o[i] <= wd_q[i%8];
    end
  end

  assign go_o   = write && wa_q[3:0] == REG_GO;
  assign stop_o = write && wa_q[3:0] == REG_STOP;

  // ---- data read by the host -----------------------------------------------------------------------

  (* ram_style = StatusStyle, no_rw_check *) status_t statuses[Slots];
  (* ram_style = "block", no_rw_check *) logic [31:0] positions[Slots];
  (* ram_style = AnswerStyle, no_rw_check *) answer_t answers[Slots];

  typedef struct packed {
    logic [1:0]  mail_seq;
    progress_t   progress;
    logic [1:0]  config_n;
    status_t     status;
    logic [31:0] position;
    answer_t     answer;
  } view_t;

  view_t view1_q, view2_q;
  logic [7:0] other1_q, other2_q;  // MASK, map or INFO, one and two cycles after the address
  logic clash_q;
  logic [RoundBits-1:0] axis2;
  logic [63:0] masks, maps;

  assign axis2 = RoundBits'(a2[9:4]);
  assign masks = 64'(mask_o);
  assign maps  = 64'(map_i);

  initial
    for (int unsigned i = 0; i < Slots; i++) begin
      statuses[i]  = '0;
      positions[i] = '0;
      answers[i]   = '0;
    end

  always_ff @(posedge clk_i) begin
    statuses[done_axis_i]  <= status_i;
    positions[done_axis_i] <= position_i;
    if (answer_we_i) answers[done_axis_i] <= answer_i;
    view1_q.mail_seq <= mails[axis2].seq;
    view1_q.progress <= progresses[axis2];
    view1_q.config_n <= configs_n[axis2];
    view1_q.status   <= statuses[axis2];
    view1_q.position <= positions[axis2];
    view1_q.answer   <= answers[axis2];
    unique case (a2[3:0])
      REG_MASK: other1_q <= masks[{a2[6:4], 3'd0}+:8];
      REG_MAP:  other1_q <= maps[{a2[6:4], 3'd0}+:8];
      default: begin
        unique case (a2[6:4])
          3'd0:    other1_q <= INFO_MARK;
          3'd1:    other1_q <= INFO_VERSION;
          3'd2:    other1_q <= 8'(Axes);
          default: other1_q <= '0;
        endcase
      end
    endcase
    clash_q <= done_axis_i == axis2;
    if (!clash_q) view2_q <= view1_q;
    other2_q <= other1_q;  // even if clash_q: any visit may change the map
  end

  // The new seq differs from the seq of the previous byte and from that of the byte accepted last.
  always_comb begin
    mail_w.command = wa_q[0];
    mail_w.data    = wd_q;
    mail_w.seq     = view2_q.mail_seq + 2'd1;
    if (mail_w.seq == view2_q.status.taken) mail_w.seq = view2_q.mail_seq + 2'd2;
    if (!ready_i) mail_w = '0;
  end

  logic [1:0] done, number;
  logic [7:0] data, status, value;
  logic ibf, obf, exists;
  logic [23:0] kept_q;  // bytes 1..3 of the position, loaded with byte 0
  logic ready_q;  // ready_i at the time of the read data

  assign exists = 32'(a2[9:4]) < Axes;

  always_comb begin
    done   = (view2_q.progress.seq == view2_q.answer.seq) ? view2_q.progress.done : 2'd0;
    obf    = done < view2_q.answer.bytes;
    ibf    = view2_q.mail_seq != view2_q.status.taken;
    number = (view2_q.answer.bytes != 2'd3) ? 2'd0 : (done == 2'd3) ? 2'd2 : done;
    data   = view2_q.answer.data[{number, 3'd0}+:8];
    status = {view2_q.status.error, view2_q.status.number, 1'b0, view2_q.status.busy, ibf, obf};
    unique case (a2[3:0])
      REG_DATA: value = data;
      REG_STATUS: value = status;
      REG_CONFIG: value = {6'd0, ~view2_q.config_n};
      REG_POSITION: value = view2_q.position[7:0];
      REG_POSITION + 4'd1: value = kept_q[7:0];
      REG_POSITION + 4'd2: value = kept_q[15:8];
      REG_POSITION + 4'd3: value = kept_q[23:16];
      REG_MASK, REG_MAP, REG_INFO: value = other2_q;
      REG_GO, REG_STOP: value = '0;
      default: value = '1;
    endcase
    if (!ready_q) value = {6'd0, a2[3:0] == REG_STATUS, 1'b0};
    if (!exists) value = '1;
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) ready_q <= 1'b0;
    else ready_q <= ready_i;
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      d_o     <= '0;
      kept_q  <= '0;
      shown_q <= 1'b0;
      seen_q  <= '0;
      taken_q <= '0;
    end else if (load) begin
      d_o     <= value;
      shown_q <= a2[3:0] == REG_DATA && obf && ready_q && exists;
      seen_q  <= axis2;
      taken_q <= '{seq: view2_q.answer.seq, done: done + 2'd1};
      if (a2[3:0] == REG_POSITION && exists) kept_q <= view2_q.position[31:8];
    end else if (read_done) begin
      shown_q <= 1'b0;
    end
  end

endmodule

`default_nettype wire
