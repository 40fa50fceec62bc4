// SPDX-License-Identifier: Apache-2.0
// ppmc_axil: AXI4-Lite subordinate (32 bits) for the strobe bus of a device.
// Rules:  register map and responses: docs/integration.md; strobes: UB-BUS-01.
// Timing: all outputs except the data multiplexer are registered. The block stores at most one write and
//         one read, and executes one access at a time. If both wait, writes and reads alternate. The B
//         response is valid 8 cycles after both AW and W were accepted, the R response 10 cycles after AR
//         was accepted. For the bridge register, both times are 2 cycles. A response is later if another
//         access is in progress.
`default_nettype none
`include "ppmc_assert.svh"

module ppmc_axil #(
    parameter int unsigned AddrBits = 1  // address lines of the device
) (
    input  wire logic                clk_i,
    input  wire logic                rst_ni,
    // AXI4-Lite
    input  wire logic                awvalid_i,  // write address is valid
    output logic                     awready_o,  // write address is accepted
    input  wire logic [AddrBits+2:0] awaddr_i,   // byte address
    input  wire logic                wvalid_i,   // write data are valid
    output logic                     wready_o,   // write data are accepted
    input  wire logic [        31:0] wdata_i,    // write data; bits 7:0 are used
    input  wire logic [         3:0] wstrb_i,    // byte enables; bit 0: write bits 7:0
    output logic                     bvalid_o,   // write response is valid
    input  wire logic                bready_i,   // write response is accepted
    output logic      [         1:0] bresp_o,    // result of the write
    input  wire logic                arvalid_i,  // read address is valid
    output logic                     arready_o,  // read address is accepted
    input  wire logic [AddrBits+2:0] araddr_i,   // byte address
    output logic                     rvalid_o,   // read data are valid
    input  wire logic                rready_i,   // read data are accepted
    output logic      [        31:0] rdata_o,    // read data; bits 7:0 are used
    output logic      [         1:0] rresp_o,    // result of the read
    output logic                     irq_o,      // interrupt of the device, active high
    // pins of the device
    output logic                     cs_no,      // chip select
    output logic                     rd_no,      // read strobe
    output logic                     wr_no,      // write strobe
    output logic      [AddrBits-1:0] a_o,        // register
    output logic      [         7:0] d_o,        // write data
    input  wire logic [         7:0] d_i,        // read data
    input  wire logic                int_ni      // interrupt, active low
);

  typedef logic [AddrBits:0] word_addr_t;  // address of a 32-bit word

  word_addr_t aw_q, ar_q;
  logic [7:0] w_q;
  logic strobe_q;  // byte lane 0 of W is enabled
  logic busy_q, write_q;  // busy_q: a strobe access is in progress; write_q: this access is a write
  logic write_next_q;  // 1: if a write and a read wait, the write is executed next
  logic bridge_reg_q;  // 1: R returns the bridge register or 0, not data of the device
  logic flag_q, unused;
  assign unused = &{1'b0, awaddr_i[1:0], araddr_i[1:0], wdata_i[31:8], wstrb_i[3:1]};

  // ---- next access ---------------------------------------------------------------------------------

  logic write_pending, read_pending, write_first, strobe, take, ready, done;
  word_addr_t word;
  logic [7:0] rdata;

  // awready_o, wready_o and arready_o are low only while the register of the channel is full.
  assign write_pending = !busy_q && !awready_o && !wready_o && !bvalid_o;
  assign read_pending  = !busy_q && !arready_o && !rvalid_o;
  assign write_first   = write_pending && (write_next_q || !read_pending);
  assign word          = write_first ? aw_q : ar_q;
  assign strobe        = (write_pending || read_pending) && !word[AddrBits] && (strobe_q || !write_first);
  assign take          = (write_pending || read_pending) && (ready || !strobe);

  ppmc_strobe_master #(
      .AddrBits(AddrBits)
  ) u_master (
      .clk_i,
      .rst_ni,
      .req_i  (strobe),
      .we_i   (write_first),
      .addr_i (word[AddrBits-1:0]),
      .wdata_i(w_q),
      .ready_o(ready),
      .done_o (done),
      .rdata_o(rdata),
      .cs_no,
      .rd_no,
      .wr_no,
      .a_o,
      .d_o,
      .d_i
  );

  // ---- requests ------------------------------------------------------------------------------------

  always_ff @(posedge clk_i) begin
    if (awready_o) aw_q <= awaddr_i[AddrBits+2:2];
    if (arready_o) ar_q <= araddr_i[AddrBits+2:2];
    if (wready_o) {strobe_q, w_q} <= {wstrb_i[0], wdata_i[7:0]};
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      awready_o <= 1'b1;
      wready_o  <= 1'b1;
      arready_o <= 1'b1;
      busy_q    <= 1'b0;
      write_q   <= 1'b0;
      write_next_q    <= 1'b0;
    end else begin
      if (awready_o) awready_o <= !awvalid_i;
      else if (take && write_first) awready_o <= 1'b1;
      if (wready_o) wready_o <= !wvalid_i;
      else if (take && write_first) wready_o <= 1'b1;
      if (arready_o) arready_o <= !arvalid_i;
      else if (take && !write_first) arready_o <= 1'b1;
      if (take) begin
        busy_q <= strobe;
        write_q <= write_first;
        write_next_q <= !write_first;
      end else if (done) busy_q <= 1'b0;
    end
  end

  // ---- responses -----------------------------------------------------------------------------------

  logic end_write, end_read;
  assign end_write = (take && write_first && !strobe) || (done && write_q);
  assign end_read  = (take && !write_first && !strobe) || (done && !write_q);

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      bvalid_o <= 1'b0;
      rvalid_o <= 1'b0;
      bresp_o  <= 2'b00;
      rresp_o  <= 2'b00;
      bridge_reg_q    <= 1'b0;
      flag_q   <= 1'b0;
      irq_o    <= 1'b0;
    end else begin
      irq_o    <= !int_ni;
      bvalid_o <= end_write || (bvalid_o && !bready_i);
      rvalid_o <= end_read || (rvalid_o && !rready_i);
      if (take && write_first) bresp_o <= {word[AddrBits], 1'b0};
      if (take && !write_first) begin
        bridge_reg_q <= word[AddrBits];
        flag_q <= irq_o && word[AddrBits-1:0] == '0;
        rresp_o <= {word[AddrBits] && word[AddrBits-1:0] != '0, 1'b0};
      end
    end
  end

  assign rdata_o = {24'd0, bridge_reg_q ? {7'b0, flag_q} : rdata};

`ifndef SYNTHESIS
  // verilog_format: off
  `PPMC_ASSERT(axil_b_stable, !$past(bvalid_o && !bready_i) || (bvalid_o && bresp_o == $past(bresp_o)))
  `PPMC_ASSERT(axil_r_stable, !$past(rvalid_o && !rready_i)
               || (rvalid_o && {rdata_o, rresp_o} == $past({rdata_o, rresp_o})))
  `PPMC_ASSERT(axil_b_after_write, !(bvalid_o && !$past(bvalid_o)) || $past(end_write))
  `PPMC_ASSERT(axil_r_after_read, !(rvalid_o && !$past(rvalid_o)) || $past(end_read))
  `PPMC_ASSERT(axil_b_room, !(end_write && bvalid_o))
  `PPMC_ASSERT(axil_r_room, !(end_read && rvalid_o))
  `PPMC_ASSERT(axil_answer_per_strobe, !done || busy_q)
  // Obligation of the manager: a request does not change until it is accepted.
  `PPMC_ASSERT(axil_aw_held, !$past(rst_ni && awvalid_i && !awready_o)
               || (awvalid_i && awaddr_i == $past(awaddr_i)))
  `PPMC_ASSERT(axil_w_held, !$past(rst_ni && wvalid_i && !wready_o)
               || (wvalid_i && {wdata_i, wstrb_i} == $past({wdata_i, wstrb_i})))
  `PPMC_ASSERT(axil_ar_held, !$past(rst_ni && arvalid_i && !arready_o)
               || (arvalid_i && araddr_i == $past(araddr_i)))
  // verilog_format: on
`endif

endmodule

`default_nettype wire
