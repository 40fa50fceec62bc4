// SPDX-License-Identifier: Apache-2.0
// ppmc_bank_window: host interface of a bank. Contains strobe logic and registers, and for each axis one
//         input buffer and one output queue.
// Rules:  BANK-WIN-01..08, BANK-HSK-01/03/04, BANK-GEN-04/05, BANK-GRP-01..04.
// Timing: counted from the strobe at the output of the synchronisers: a write acts at the first edge after
//         the end of its strobe, and d_o is valid from the third edge after the start of a read strobe.
//         in_buf_o, read_progress_o and config_no are valid one cycle after axis_i.
// How:    the RAM words of the addressed axis are read in every cycle. If a visit writes one of these words
//         in the same cycle, the words from the previous cycle are kept. The registers of the bank
//         (bank_reg_q, bank_reg_q2) are always updated.
`default_nettype none

module ppmc_bank_window
  import ppmc_bank_pkg::*;
#(
    parameter int unsigned Axes      = 32,
    parameter int unsigned RoundBits = 5    // a round is 2^RoundBits cycles; at least Axes and 8
) (
    input wire logic clk_i,
    input wire logic rst_ni,
    // bus
    input wire logic [9:0] a_i,  // axis and register
    input wire logic cs_ni,  // chip select
    input wire logic rd_ni,  // read strobe
    input wire logic wr_ni,  // write strobe
    input wire logic [7:0] d_i,  // data written by the host
    output logic [7:0] d_o,  // data read by the host
    output logic d_oe_o,  // 1: drive d_o, because the host reads
    // visits
    input wire logic ready_i,  // 0: the axes are being reset
    input wire logic [RoundBits-1:0] axis_i,  // axis of the next visit
    output in_buf_t in_buf_o,  // input buffer of axis_i
    output read_progress_t read_progress_o,  // response bytes of axis_i that the host has read
    output logic [1:0] config_no,  // vsel and csel of axis_i, inverted
    input wire logic [RoundBits-1:0] done_axis_i,  // axis whose visit ends
    input wire axis_status_t status_i,  // status of done_axis_i
    input wire logic [31:0] position_i,  // position of done_axis_i
    input wire logic read_data_we_i,  // strobe: write read_data_i
    input wire read_data_t read_data_i,  // response to a read command
    // bank
    input wire logic [Axes-1:0] map_i,  // pending interrupts
    output logic [Axes-1:0] mask_o,  // members of the group
    output logic go_o,  // strobe: GO is written at the next edge
    output logic stop_o  // strobe: STOP is written at the next edge
);

  localparam int unsigned Slots = 1 << RoundBits;
  // Small FPGAs have few block RAMs. With up to 8 axes, only the positions use them: the responses use
  // logic, and the synthesis tool selects the memory of the status. Only attributes use these parameters;
  // simulation ignores them.
  // verilator lint_off UNUSEDPARAM
  localparam string ReadDataStyle = (Slots > 8) ? "block" : "logic";
  localparam string StatusStyle = (Slots > 8) ? "block" : "auto";
  // verilator lint_on UNUSEDPARAM

  // ---- bus -----------------------------------------------------------------------------------------

  logic cs_n_s1, rd_n_s1, wr_n_s1, cs_n_s2, rd_n_s2, wr_n_s2, read_s2, write_s2;
  logic [9:0] a_s1, a_s2;
  logic [7:0] d_s1, d_s2;
  logic unused_meta;

  assign unused_meta = ^{cs_n_s1, rd_n_s1, wr_n_s1, a_s1, d_s1};

  ppmc_sync #(
      .Width(21)
  ) u_sync (
      .clk_i,
      .rst_ni,
      .d_i ({cs_ni, rd_ni, wr_ni, a_i, d_i}),
      .q1_o({cs_n_s1, rd_n_s1, wr_n_s1, a_s1, d_s1}),
      .q2_o({cs_n_s2, rd_n_s2, wr_n_s2, a_s2, d_s2})
  );

  assign read_s2  = !cs_n_s2 && !rd_n_s2 && wr_n_s2;
  assign write_s2 = !cs_n_s2 && !wr_n_s2 && rd_n_s2;

  logic write_s3_q, read_s3_q, read_s4_q, read_s5_q, write, read_done, load;
  logic [9:0] waddr_q;
  logic [7:0] wdata_q;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {write_s3_q, read_s3_q, read_s4_q, read_s5_q, d_oe_o} <= '0;
      waddr_q <= '0;
      wdata_q <= '0;
    end else begin
      write_s3_q <= write_s2;
      if (write_s2) {waddr_q, wdata_q} <= {a_s2, d_s2};
      {read_s5_q, read_s4_q, read_s3_q} <= {read_s4_q, read_s3_q, read_s2};
      d_oe_o <= read_s2;
    end
  end

  assign write     = write_s3_q && !write_s2 && ready_i && 32'(waddr_q[9:4]) < Axes;
  assign read_done = read_s3_q && !read_s2;
  assign load      = read_s4_q && !read_s5_q && read_s2;

  // ---- write accesses of the host -------------------------------------------------------------------

  in_buf_t in_buf_mem[Slots];
  read_progress_t read_progress_mem[Slots];
  logic [1:0] config_n_mem[Slots];
  in_buf_t in_buf_wdata;
  read_progress_t read_progress_wdata, next_progress_q;
  logic [RoundBits-1:0] in_buf_waddr, config_waddr, read_progress_waddr, shown_axis_q;
  logic in_buf_we, config_we, read_progress_we, data_shown_q;

  initial
    for (int unsigned i = 0; i < Slots; i++) begin
      in_buf_mem[i]        = '0;
      read_progress_mem[i] = '0;
      config_n_mem[i]      = '0;
    end

  // While the bank is not ready, all words are cleared.
  assign in_buf_we           = !ready_i || (write && waddr_q[3:1] == 3'd0);
  assign config_we           = !ready_i || (write && waddr_q[3:0] == REG_CONFIG);
  assign read_progress_we    = !ready_i || (read_done && data_shown_q);
  assign in_buf_waddr        = ready_i ? RoundBits'(waddr_q[9:4]) : axis_i;
  assign config_waddr        = in_buf_waddr;
  assign read_progress_waddr = ready_i ? shown_axis_q : axis_i;
  assign read_progress_wdata = ready_i ? next_progress_q : '0;

  always_ff @(posedge clk_i) begin
    if (in_buf_we) in_buf_mem[in_buf_waddr] <= in_buf_wdata;
    if (config_we) config_n_mem[config_waddr] <= ready_i ? ~wdata_q[1:0] : '0;
    if (read_progress_we) read_progress_mem[read_progress_waddr] <= read_progress_wdata;
    in_buf_o        <= in_buf_mem[axis_i];
    read_progress_o <= read_progress_mem[axis_i];
    config_no       <= config_n_mem[axis_i];
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) mask_o <= '0;
    else if (write && waddr_q[3:0] == REG_MASK) begin
      for (int unsigned i = 0; i < Axes; i++) if (waddr_q[6:4] == 3'(i / 8)) mask_o[i] <= wdata_q[i%8];
    end
  end

  assign go_o   = write && waddr_q[3:0] == REG_GO;
  assign stop_o = write && waddr_q[3:0] == REG_STOP;

  // ---- read accesses of the host --------------------------------------------------------------------

  (* ram_style = StatusStyle, no_rw_check *) axis_status_t status_mem[Slots];
  (* ram_style = "block", no_rw_check *) logic [31:0] position_mem[Slots];
  (* ram_style = ReadDataStyle, no_rw_check *) read_data_t read_data_mem[Slots];

  typedef struct packed {
    logic [1:0]     in_buf_seq;
    read_progress_t read_progress;
    logic [1:0]     config_n;
    axis_status_t   status;
    logic [31:0]    position;
    read_data_t     read_data;
  } axis_regs_t;

  axis_regs_t axis_regs_q, axis_regs_q2;
  logic [7:0] bank_reg_q, bank_reg_q2;  // MASK, map or INFO, one and two cycles after the address
  logic collision_q;
  logic [RoundBits-1:0] axis_s2;
  logic [63:0] masks, maps;

  assign axis_s2 = RoundBits'(a_s2[9:4]);
  assign masks = 64'(mask_o);
  assign maps = 64'(map_i);

  initial
    for (int unsigned i = 0; i < Slots; i++) begin
      status_mem[i] = '0;
      position_mem[i] = '0;
      read_data_mem[i] = '0;
    end

  always_ff @(posedge clk_i) begin
    status_mem[done_axis_i]   <= status_i;
    position_mem[done_axis_i] <= position_i;
    if (read_data_we_i) read_data_mem[done_axis_i] <= read_data_i;
    axis_regs_q.in_buf_seq <= in_buf_mem[axis_s2].seq;
    axis_regs_q.read_progress <= read_progress_mem[axis_s2];
    axis_regs_q.config_n <= config_n_mem[axis_s2];
    axis_regs_q.status <= status_mem[axis_s2];
    axis_regs_q.position <= position_mem[axis_s2];
    axis_regs_q.read_data <= read_data_mem[axis_s2];
    unique case (a_s2[3:0])
      REG_MASK: bank_reg_q <= masks[{a_s2[6:4], 3'd0}+:8];
      REG_MAP:  bank_reg_q <= maps[{a_s2[6:4], 3'd0}+:8];
      default: begin
        unique case (a_s2[6:4])
          3'd0:    bank_reg_q <= INFO_MARK;
          3'd1:    bank_reg_q <= INFO_VERSION;
          3'd2:    bank_reg_q <= 8'(Axes);
          default: bank_reg_q <= '0;
        endcase
      end
    endcase
    collision_q <= done_axis_i == axis_s2;
    if (!collision_q) axis_regs_q2 <= axis_regs_q;
    bank_reg_q2 <= bank_reg_q;  // loaded even if collision_q = 1, because any visit may change the map
  end

  // The new seq differs from the seq of the previous byte and from the seq of the last accepted byte.
  always_comb begin
    in_buf_wdata.is_command = waddr_q[0];
    in_buf_wdata.data       = wdata_q;
    in_buf_wdata.seq        = axis_regs_q2.in_buf_seq + 2'd1;
    if (in_buf_wdata.seq == axis_regs_q2.status.ack_seq) in_buf_wdata.seq = axis_regs_q2.in_buf_seq + 2'd2;
    if (!ready_i) in_buf_wdata = '0;
  end

  logic [1:0] bytes_read, byte_index;
  logic [7:0] data, status, value;
  logic ibf, obf, axis_exists;
  logic [23:0] position_latch_q;  // bytes 1..3 of the position, latched when byte 0 is read
  logic ready_q;  // ready_i, delayed by one cycle

  assign axis_exists = 32'(a_s2[9:4]) < Axes;

  always_comb begin
    bytes_read = (axis_regs_q2.read_progress.seq == axis_regs_q2.read_data.seq)
        ? axis_regs_q2.read_progress.bytes_read : 2'd0;
    obf = bytes_read < axis_regs_q2.read_data.bytes;
    ibf = axis_regs_q2.in_buf_seq != axis_regs_q2.status.ack_seq;
    byte_index = (axis_regs_q2.read_data.bytes != 2'd3) ? 2'd0 : (bytes_read == 2'd3) ? 2'd2 : bytes_read;
    data = axis_regs_q2.read_data.data[{byte_index, 3'd0}+:8];
    status = {
      axis_regs_q2.status.error, axis_regs_q2.status.number, 1'b0, axis_regs_q2.status.busy, ibf, obf
    };
    unique case (a_s2[3:0])
      REG_DATA: value = data;
      REG_STATUS: value = status;
      REG_CONFIG: value = {6'd0, ~axis_regs_q2.config_n};
      REG_POSITION: value = axis_regs_q2.position[7:0];
      REG_POSITION + 4'd1: value = position_latch_q[7:0];
      REG_POSITION + 4'd2: value = position_latch_q[15:8];
      REG_POSITION + 4'd3: value = position_latch_q[23:16];
      REG_MASK, REG_MAP, REG_INFO: value = bank_reg_q2;
      REG_GO, REG_STOP: value = '0;
      default: value = '1;
    endcase
    if (!ready_q) value = {6'd0, a_s2[3:0] == REG_STATUS, 1'b0};
    if (!axis_exists) value = '1;
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) ready_q <= 1'b0;
    else ready_q <= ready_i;
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      d_o              <= '0;
      position_latch_q <= '0;
      data_shown_q     <= 1'b0;
      shown_axis_q     <= '0;
      next_progress_q  <= '0;
    end else if (load) begin
      d_o             <= value;
      data_shown_q    <= a_s2[3:0] == REG_DATA && obf && ready_q && axis_exists;
      shown_axis_q    <= axis_s2;
      next_progress_q <= '{seq: axis_regs_q2.read_data.seq, bytes_read: bytes_read + 2'd1};
      if (a_s2[3:0] == REG_POSITION && axis_exists) position_latch_q <= axis_regs_q2.position[31:8];
    end else if (read_done) begin
      data_shown_q <= 1'b0;
    end
  end

endmodule

`default_nettype wire
