// SPDX-License-Identifier: Apache-2.0
// ppmc312_mailbox: parallel front end with CSR, write window (WCR, WAR, DWR), read window (RCR, RAR, DRR)
//         and interrupt.
// Rules:  P312-PAR-01..08, P312-PRT-01/02, P312-BAD-01..03/07/08.
// Timing: host_block_o is valid one cycle after the write of the header. irq_no follows CSR by one cycle. A
//         report can be read 6 cycles after rd_load_o. rd_load_o is asserted at least 8 cycles after the
//         read of the last byte of the previous report.
// Note:   the core uses blocks and reports in logical order (header first). The bus transfers them in
//         reverse order.
`include "ppmc_assert.svh"
`default_nettype none

module ppmc312_mailbox
  import ppmc312_pkg::*;
  import ppmc312_link_pkg::*;
  import ppmc312_serial_pkg::*;
#(
    parameter int unsigned WaitCycles = 6  // T_WRQ (minimum time between data accesses) in cycles
) (
    input wire logic clk_i,  // clock
    input wire logic rst_ni,  // reset, asynchronous
    input wire logic rst_bus_ni,  // asynchronous reset of the bus strobes
    input wire logic ready_i,  // 0: instructions cannot be written yet
    input wire logic off_i,  // 1: serial mode, the bus is off
    // pins
    input wire logic [2:0] rs_i,  // register
    input wire logic cs_ni,  // chip select
    input wire logic we_ni,  // write strobe
    input wire logic oe_ni,  // read strobe
    input wire logic [7:0] d_i,  // bus, from the host
    output logic [7:0] d_o,  // bus, to the host
    output logic d_oe_o,  // 1: drive the bus with d_o
    output logic wrq_no,  // wait request
    output logic irq_no,  // interrupt
    // blocks from the host
    output host_block_t host_block_o,  // block for the core
    input wire logic [BLOCK_BITS-1:0] blk_addr_i,  // byte of the block, 0 = header
    output logic [7:0] blk_data_o,  // byte at blk_addr_i, two cycles later
    input wire logic blk_done_i,  // strobe: the block is processed and its response is stored
    input wire block_write_t block_write_i,  // byte of a block from the serial station
    // reports to the host
    input wire logic rd_any_i,  // a report is pending
    output logic rd_load_o,  // strobe: load the next report
    input wire logic [BLOCK_BITS:0] rd_size_i,  // bytes of the report; valid 2 cycles after rd_load_o
    output logic [BLOCK_BITS-1:0] rd_addr_o,  // byte of the report, 0 = header
    input wire logic [7:0] rd_data_i,  // byte at rd_addr_o, at most three cycles later
    output logic rd_done_o  // strobe: the report has been read
);

  localparam logic [2:0] RegCsr = 3'b000;
  localparam logic [2:0] RegCr = 3'b010;  // WCR, RCR
  localparam logic [2:0] RegAr = 3'b011;  // WAR, RAR
  localparam logic [2:0] RegDwr = 3'b101;
  localparam logic [2:0] RegDrr = 3'b111;
  localparam logic [7:0] ArmCode = 8'h20;
  localparam logic [BLOCK_BITS:0] WindowBytes = (BLOCK_BITS + 1)'(32);

  logic wr, rd_show, rd_done, mwef, mref, write_byte, enable_wrq_q, enable_write_q, enable_read_q, armed_q;
  logic [2:0] wr_rs, rd_rs;
  logic [7:0] wr_data, rd_data;
  logic [BLOCK_BITS:0] at_q;  // write pointer; 0x20: writes are ignored
  logic [BLOCK_BITS:0] left_q;  // unread bytes of the report; 0: no report

  ppmc312_bus #(
      .WaitCycles(WaitCycles)
  ) u_bus (
      .clk_i,
      .rst_ni     (rst_bus_ni),
      .rst_wait_ni(rst_ni),
      .off_i,
      .rs_i,
      .cs_ni,
      .we_ni,
      .oe_ni,
      .d_i,
      .d_o,
      .d_oe_o,
      .wrq_no,
      .wait_i     (enable_wrq_q),
      .wr_o       (wr),
      .wr_rs_o    (wr_rs),
      .wr_data_o  (wr_data),
      .rd_rs_o    (rd_rs),
      .rd_data_i  (rd_data),
      .rd_show_o  (rd_show),
      .rd_done_o  (rd_done)
  );

  assign mwef = host_block_o.valid || !ready_i;
  assign mref = left_q == '0;

  // ---- write window -------------------------------------------------------------------------------

  assign write_byte = wr && wr_rs == RegDwr && !mwef && armed_q && at_q != WindowBytes;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {enable_wrq_q, enable_write_q, enable_read_q} <= '0;
      armed_q                                       <= 1'b0;
      at_q                                          <= WindowBytes;
      host_block_o.size                             <= '0;
      host_block_o.valid                            <= 1'b0;
    end else begin
      if (wr && wr_rs == RegCsr) {enable_wrq_q, enable_write_q, enable_read_q} <= wr_data[6:4];
      if (wr && wr_rs == RegCr && !mwef) armed_q <= wr_data == ArmCode;
      if (wr && wr_rs == RegAr && !mwef) begin
        at_q <= (wr_data < 8'(WindowBytes)) ? wr_data[BLOCK_BITS:0] : WindowBytes;
        host_block_o.size <= 6'(ppmc_pkg::inc(
            {26'd0, ~wr_data[BLOCK_BITS:0]}
        )) ^ WindowBytes;  // WindowBytes - wr_data
      end
      if (write_byte) at_q <= 6'(ppmc_pkg::inc(32'(at_q)));
      if (write_byte && at_q == WindowBytes - 1'b1) host_block_o.valid <= 1'b1;
      else if (blk_done_i) host_block_o.valid <= 1'b0;
    end
  end

  ppmc_ram #(
      .Width   (8),
      .AddrBits(BLOCK_BITS)
  ) u_window (
      .clk_i,
      .we_i   (write_byte || block_write_i.we),
      .waddr_i(block_write_i.we ? ~BLOCK_BITS'(block_write_i.addr) : at_q[BLOCK_BITS-1:0]),
      .wdata_i(block_write_i.we ? block_write_i.data : wr_data),
      .raddr_i(~blk_addr_i),
      .rdata_o(blk_data_o)
  );

  // ---- read window --------------------------------------------------------------------------------

  logic [3:0] pause_q;  // cycles until the next action of the read window
  logic loaded_q, shown_q, last;

  // A read that began before the report was available (shown_q = 0) has returned no byte of the report.
  assign last = rd_done && shown_q && rd_rs == RegDrr && left_q == (BLOCK_BITS + 1)'(1);
  assign rd_load_o = rd_any_i && mref && !loaded_q && pause_q == '0;
  assign rd_done_o = last;
  assign rd_addr_o = BLOCK_BITS'(ppmc_pkg::dec(mref ? 32'(rd_size_i) : 32'(left_q)));

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      loaded_q <= 1'b0;
      shown_q  <= 1'b0;
      pause_q  <= '0;
      left_q   <= '0;
    end else begin
      if (rd_show) shown_q <= !mref;
      if (pause_q != '0) pause_q <= pause_q - 1'b1;
      if (rd_load_o) begin
        loaded_q <= 1'b1;
        pause_q  <= 4'd5;
      end else if (last) begin
        loaded_q <= 1'b0;
        pause_q  <= 4'd9;
        left_q   <= '0;
      end else if (loaded_q && mref && pause_q == '0) begin
        left_q <= rd_size_i;
      end else if (rd_done && shown_q) begin
        if (rd_rs == RegDrr) left_q <= {1'b0, rd_addr_o};  // left_q - 1; shown_q implies left_q > 0
        if (rd_rs == RegCr) left_q <= rd_size_i;
      end
    end
  end

  always_comb begin
    unique case (rd_rs)
      RegCsr:  rd_data = {1'b0, enable_wrq_q, enable_write_q, enable_read_q, mwef, mref, 2'b00};
      RegAr:   rd_data = 8'(ppmc_pkg::inc({26'd0, ~left_q}));  // 0x40 - left_q
      RegDrr:  rd_data = mref ? 8'h00 : rd_data_i;
      default: rd_data = 8'h00;
    endcase
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) irq_no <= 1'b1;
    else irq_no <= !((enable_write_q && !mwef) || (enable_read_q && !mref));
  end

`ifndef SYNTHESIS
  `PPMC_ASSERT(p312_par_07, mref || left_q <= rd_size_i)
  `PPMC_ASSERT(p312_par_06, !(write_byte && mwef))
`endif

endmodule

`default_nettype wire
