// SPDX-License-Identifier: Apache-2.0
// ppmc312_mailbox_fv: proves that a block from the host is complete and stays unchanged until the core has
// processed it, and that the bytes of each report are read in order and once, with real bus strobes.
`include "ppmc_fv.svh"
`default_nettype none

module ppmc312_mailbox_fv
  import ppmc312_pkg::*;
  import ppmc312_link_pkg::*;
  import ppmc312_serial_pkg::*;
(
    input wire logic       clk_i,
    input wire logic       ready_i,
    input wire logic [2:0] rs_i,
    input wire logic       cs_ni,
    input wire logic       we_ni,
    input wire logic       oe_ni,
    input wire logic [7:0] d_i,
    input wire logic [4:0] blk_addr_i,
    input wire logic       blk_done_i,
    input wire logic       rd_any_i,
    input wire logic [5:0] rd_size_i,
    input wire logic [7:0] rd_data_i
);

  localparam int unsigned Space = 3;  // samples between two strobes

  logic [7:0] d_o, blk_data_o;
  logic d_oe_o, wrq_no, irq_no, rd_load_o, rd_done_o;
  host_block_t host_block_o;
  logic [4:0] rd_addr_o;

  `FV_RESET

  ppmc312_mailbox dut (
      .rst_bus_ni   (rst_ni),
      .off_i        (1'b0),
      .block_write_i('0),
      .*
  );

  `FV_ASSUME(stays_ready, ready_i || !$past(rst_ni && ready_i))
  `FV_ASSUME(done_while_valid, !blk_done_i || host_block_o.valid)

  // ---- write window -------------------------------------------------------------------------------

  logic wr;  // strobe: a write
  logic [2:0] wr_rs;
  logic [7:0] wr_data;
  logic armed_q, full_q, closed;  // full_q: a block waits for the core
  logic [5:0] at_q, size_q, gone_q;  // pointer, size of the block, bytes of the block that have been written
  logic stores;  // a byte of the block is being written

  assign wr      = dut.wr;
  assign wr_rs   = dut.wr_rs;
  assign wr_data = dut.wr_data;
  assign closed  = full_q || !ready_i;
  assign stores  = wr && wr_rs == 3'd5 && !closed && armed_q && at_q < 6'd32;

  always_ff @(posedge clk_i)
    if (!rst_ni) {armed_q, full_q, at_q, size_q, gone_q} <= {1'b0, 1'b0, 6'd32, 12'd0};
    else begin
      if (wr && wr_rs == 3'd2 && !closed) armed_q <= wr_data == 8'h20;
      if (wr && wr_rs == 3'd3 && !closed) begin
        at_q   <= (wr_data < 8'd32) ? 6'(wr_data) : 6'd32;
        size_q <= 6'd32 - 6'(wr_data);
        gone_q <= '0;
      end
      if (stores) begin
        at_q   <= at_q + 6'd1;
        gone_q <= gone_q + 6'd1;
      end
      full_q <= (stores && at_q == 6'd31) || (full_q && !blk_done_i);
    end

  `FV_ASSERT(p312_par_05_complete, host_block_o.valid == full_q)
  `FV_ASSERT(p312_par_04_size, !full_q || (host_block_o.size == size_q && gone_q == size_q))
  `FV_ASSERT(
      p312_par_05_bytes,
      !stores || (dut.u_window.we_i && dut.u_window.waddr_i == at_q[4:0] && dut.u_window.wdata_i == wr_data))
  `FV_ASSERT(p312_par_06_unchanged, dut.u_window.we_i == stores)
  `FV_ASSERT(p312_par_04_logical_order, dut.u_window.raddr_i == 5'd31 - blk_addr_i)
  `FV_ASSERT(lemma_pointer, at_q == dut.at_q && armed_q == dut.armed_q && at_q <= 6'd32)
  `FV_ASSERT(lemma_gone, at_q == 6'd32 ? gone_q <= size_q : at_q == 6'd32 - size_q + gone_q)

  // ---- read window --------------------------------------------------------------------------------

  logic read, write;
  logic [2:0] free_q;  // samples without a strobe, at most Space
  logic [2:0] load_age_q;  // cycles since the load of a report, at most 7
  logic [4:0] report_size_q;  // size - 1 of the loaded report
  logic loaded_q, open_q;  // open_q: MREF = 0
  logic [5:0] left_q;  // unread bytes
  logic [4:0] pause_q;  // cycles for which a report waits and cannot be read
  logic [3:0] since_q;  // cycles since the last byte of a report was read, at most 8
  logic last, counts_q, rd_show, rd_end;

  assign read = !cs_ni && we_ni && !oe_ni;
  assign write = !cs_ni && !we_ni && oe_ni;
  assign rd_show = dut.rd_show;
  assign rd_end = dut.rd_done;

  // The host leaves a pause between two strobes. Two strobes without a pause are one strobe.
  logic strobe_q;
  always_ff @(posedge clk_i)
    if (!rst_ni) {free_q, strobe_q} <= {3'd3, 1'b0};
    else begin
      strobe_q <= read || write;
      free_q   <= (read || write) ? '0 : (free_q < 3'(Space)) ? free_q + 3'd1 : free_q;
    end
  `FV_ASSUME(pause_between_strobes, !(read && !strobe_q) || free_q == 3'(Space))
  `FV_ASSUME(one_kind_of_strobe, !(read && strobe_q) || $past(read))

  `FV_ASSUME(size_in_time, !loaded_q || load_age_q < 3'd2 || rd_size_i == 6'(report_size_q) + 6'd1)
  `FV_ASSUME(size_of_a_report, rd_size_i >= 6'd3 && rd_size_i <= 6'd32)

  assign last = rd_end && counts_q && dut.rd_rs == 3'd7 && left_q == 6'd1;

  always_ff @(posedge clk_i)
    if (!rst_ni) {loaded_q, open_q, left_q, load_age_q, counts_q, pause_q, since_q} <= {17'd0, 4'd8};
    else begin
      if (load_age_q != '1) load_age_q <= load_age_q + 3'd1;
      if (rd_show) counts_q <= open_q;
      if (rd_load_o) begin
        loaded_q   <= 1'b1;
        load_age_q <= '0;
      end else if (last) {loaded_q, open_q, left_q} <= '0;
      else if (loaded_q && !open_q && load_age_q == 3'd5) {open_q, left_q} <= {1'b1, rd_size_i};
      else if (rd_end && counts_q && dut.rd_rs == 3'd7) left_q <= left_q - 6'd1;
      else if (rd_end && counts_q && dut.rd_rs == 3'd2) left_q <= rd_size_i;
      pause_q <= (!open_q && (rd_any_i || loaded_q)) ? pause_q + 5'd1 : '0;
      since_q <= last ? '0 : (since_q < 4'd8) ? since_q + 4'd1 : since_q;
    end

  logic [4:0] any_size_q;
  always_ff @(posedge clk_i) if (rd_load_o) report_size_q <= 5'(rd_size_i - 6'd1) ^ any_size_q;
  always_ff @(posedge clk_i) any_size_q <= d_i[4:0];

  logic [4:0] addr1_q, addr2_q;  // rd_addr_o, one and two cycles ago
  always_ff @(posedge clk_i) {addr2_q, addr1_q} <= {addr1_q, rd_addr_o};

  `FV_ASSERT(p312_par_07_left, dut.left_q == left_q && open_q == (left_q != '0))
  `FV_ASSERT(p312_par_07_order, !open_q || rd_addr_o == 5'(left_q - 6'd1))
  // verilog_format: off
  `FV_ASSERT(
      p312_par_07_byte_in_time,
      !(rd_show && open_q && dut.rd_rs == 3'd7) || (addr1_q == rd_addr_o && addr2_q == rd_addr_o
          && dut.rd_data == rd_data_i))
  // verilog_format: on
  `FV_ASSERT(p312_par_07_rar, dut.rd_rs != 3'd3 || dut.rd_data == 8'h40 - 8'(left_q))
  `FV_ASSERT(p312_par_08_read_once, rd_done_o == last)
  `FV_ASSERT(loads_one_report, !rd_load_o || (rd_any_i && !loaded_q))
  `FV_ASSERT(p312_par_08_stays_closed, !open_q || since_q == 4'd8)
  `FV_ASSERT(p312_par_08_ready_again, pause_q < 5'd18)
  `FV_ASSERT(p312_par_01_csr, dut.rd_rs != 3'd0 || dut.rd_data[3:2] == {closed, !open_q})
  `FV_ASSERT(p312_par_02_irq, !$past(rst_ni) || irq_no == !$past
             ((dut.enable_write_q && !closed) || (dut.enable_read_q && open_q)))
  `FV_COVER(seen_block, full_q && size_q == 6'd2)
  `FV_COVER(seen_report, rd_done_o)

endmodule

`default_nettype wire
