// SPDX-License-Identifier: Apache-2.0
// ppmc_axil_fv: proves the handshake rules of an AXI4-Lite subordinate for any manager that follows the
// rules for managers. Each request gets one access with its address and data, and one response in time;
// waiting reads and writes alternate.
`include "ppmc_fv.svh"
`default_nettype none

module ppmc_axil_fv (
    input wire logic        clk_i,
    input wire logic        awvalid_i,
    input wire logic [ 3:0] awaddr_i,
    input wire logic        wvalid_i,
    input wire logic [31:0] wdata_i,
    input wire logic [ 3:0] wstrb_i,
    input wire logic        bready_i,
    input wire logic        arvalid_i,
    input wire logic [ 3:0] araddr_i,
    input wire logic        rready_i,
    input wire logic [ 7:0] d_i,
    input wire logic        int_ni
);

  logic awready_o, wready_o, bvalid_o, arready_o, rvalid_o, irq_o, cs_no, rd_no, wr_no, a_o;
  logic [1:0] bresp_o, rresp_o;
  logic [31:0] rdata_o;
  logic [ 7:0] d_o;

  `FV_RESET

  ppmc_axil dut (.*);

  // Rules for managers: a request is stable until it is accepted.
  `FV_ASSUME(aw_stands, !$past(rst_ni && awvalid_i && !awready_o) || (awvalid_i && awaddr_i == $past
             (awaddr_i)))
  `FV_ASSUME(w_stands, !$past(rst_ni && wvalid_i && !wready_o) || (wvalid_i && {wdata_i, wstrb_i} == $past
             ({wdata_i, wstrb_i})))
  `FV_ASSUME(ar_stands, !$past(rst_ni && arvalid_i && !arready_o) || (arvalid_i && araddr_i == $past
             (araddr_i)))

  logic [1:0] aw_q, w_q, ar_q;  // number of accepted requests without a response
  logic [5:0] write_q, read_q;  // cycles for which a complete request has waited for its response
  logic aw, w, ar, b, r;

  assign {aw, w, ar} = {awvalid_i && awready_o, wvalid_i && wready_o, arvalid_i && arready_o};
  assign {b, r}      = {bvalid_o && bready_i, rvalid_o && rready_i};

  always_ff @(posedge clk_i)
    if (!rst_ni) {aw_q, w_q, ar_q, write_q, read_q} <= '0;
    else begin
      aw_q    <= aw_q + 2'(aw) - 2'(b);
      w_q     <= w_q + 2'(w) - 2'(b);
      ar_q    <= ar_q + 2'(ar) - 2'(r);
      write_q <= (aw_q != '0 && w_q != '0 && !bvalid_o) ? write_q + 1'b1 : '0;
      read_q  <= (ar_q != '0 && !rvalid_o) ? read_q + 1'b1 : '0;
    end

  `FV_ASSERT(a3_3_b_behind_aw_and_w, !bvalid_o || (aw_q != '0 && w_q != '0))
  `FV_ASSERT(a3_3_r_behind_ar, !rvalid_o || ar_q != '0)
  `FV_ASSERT(a3_2_b_stands, !$past(rst_ni && bvalid_o && !bready_i) || (bvalid_o && bresp_o == $past(bresp_o)
             ))
  `FV_ASSERT(a3_2_r_stands, !$past(rst_ni && rvalid_o && !rready_i)
             || (rvalid_o && {rdata_o, rresp_o} == $past({rdata_o, rresp_o})))
  `FV_ASSERT(two_wait_at_most, aw_q <= 2'd2 && w_q <= 2'd2 && ar_q <= 2'd2)
  `FV_ASSERT(write_answered_in_time, write_q <= 6'd24)
  `FV_ASSERT(read_answered_in_time, read_q <= 6'd24)
  `FV_ASSERT(legal_responses, bresp_o inside {2'b00, 2'b10} && rresp_o inside {2'b00, 2'b10})
  // ---- accesses ------------------------------------------------------------------------------------

  // Requests in the order of their acceptance, [0]: the oldest one without a response.
  logic [1:0][1:0] aw_addr_q, ar_addr_q;  // {1: register of the bridge, register}
  logic [1:0][8:0] w_data_q;  // {byte lane 0 is enabled, data}
  logic [1:0] writes_q, reads_q;  // strobes of the device for the oldest request, at most 3
  logic [7:0] read_data_q;  // data of the device in the last cycle of its last read strobe
  logic write_strobes, read_strobes;  // the oldest request is an access to the device

  assign write_strobes = !aw_addr_q[0][1] && w_data_q[0][8];
  assign read_strobes  = !ar_addr_q[0][1];

  always_ff @(posedge clk_i) begin
    if (b) {aw_addr_q[0], w_data_q[0]} <= {aw_addr_q[1], w_data_q[1]};
    if (r) ar_addr_q[0] <= ar_addr_q[1];
    if (aw) aw_addr_q[(aw_q-2'(b))!='0] <= awaddr_i[3:2];
    if (w) w_data_q[(w_q-2'(b))!='0] <= {wstrb_i[0], wdata_i[7:0]};
    if (ar) ar_addr_q[(ar_q-2'(r))!='0] <= araddr_i[3:2];
    if (!rst_ni || b) writes_q <= '0;
    else if (!wr_no && $past(wr_no) && writes_q != 2'd3) writes_q <= writes_q + 1'b1;
    if (!rst_ni || r) reads_q <= '0;
    else if (!rd_no && $past(rd_no) && reads_q != 2'd3) reads_q <= reads_q + 1'b1;
    if (!rd_no) read_data_q <= d_i;
  end

  `FV_ASSERT(strobes_select, !(!wr_no || !rd_no) || !cs_no)
  `FV_ASSERT(writes_oldest, wr_no || (aw_q != '0 && w_q != '0 && write_strobes))
  `FV_ASSERT(writes_its_data, wr_no || {a_o, d_o} == {aw_addr_q[0][0], w_data_q[0][7:0]})
  `FV_ASSERT(reads_oldest, rd_no || (ar_q != '0 && read_strobes && a_o == ar_addr_q[0][0]))
  `FV_ASSERT(one_write_strobe, !bvalid_o || writes_q == 2'(write_strobes))
  `FV_ASSERT(one_read_strobe, !rvalid_o || reads_q == 2'(read_strobes))
  `FV_ASSERT(write_response, !bvalid_o || bresp_o == {aw_addr_q[0][1], 1'b0})
  `FV_ASSERT(read_response, !rvalid_o || rresp_o == {ar_addr_q[0] == 2'b11, 1'b0})
  `FV_ASSERT(read_data, !(rvalid_o && read_strobes) || rdata_o == 32'(read_data_q))
  `FV_ASSERT(read_of_interrupt, !(rvalid_o && !$past(rvalid_o)
             && ar_addr_q[0] == 2'b10) || rdata_o == 32'($past(irq_o)))

  // ---- order and time ------------------------------------------------------------------------------

  // A request waits from its acceptance to its response, except while the previous response of its channel
  // waits for the manager.
  logic write_waits, read_waits, write_alone_q, read_alone_q;
  logic [1:0] reads_first_q, writes_first_q;  // accesses of the other kind that ended during the wait

  assign write_waits = aw_q != '0 && w_q != '0 && !bvalid_o;
  assign read_waits  = ar_q != '0 && !rvalid_o;

  logic [3:0] quiet_q;  // cycles without a request, at most 15
  always_ff @(posedge clk_i) begin
    if (!rst_ni || !write_waits) reads_first_q <= '0;
    else if (rvalid_o && !$past(rvalid_o) && reads_first_q != 2'd3) reads_first_q <= reads_first_q + 1'b1;
    if (!rst_ni || !read_waits) writes_first_q <= '0;
    else if (bvalid_o && !$past(bvalid_o) && writes_first_q != 2'd3) writes_first_q <= writes_first_q + 1'b1;
    if (!rst_ni || write_waits || read_waits) quiet_q <= '0;
    else if (quiet_q != 4'd15) quiet_q <= quiet_q + 1'b1;
    write_alone_q <= write_waits ? write_alone_q && !read_waits : quiet_q == 4'd15;
    read_alone_q  <= read_waits ? read_alone_q && !write_waits : quiet_q == 4'd15;
  end

  `FV_ASSERT(one_read_before_a_write, reads_first_q <= 2'd1)
  `FV_ASSERT(one_write_before_a_read, writes_first_q <= 2'd1)
  `FV_ASSERT(time_of_write, !(bvalid_o && !$past(bvalid_o) && write_alone_q) || $past(write_q)
             == (write_strobes ? 6'd6 : 6'd0))
  `FV_ASSERT(time_of_read, !(rvalid_o && !$past(rvalid_o) && read_alone_q) || $past(read_q)
             == (read_strobes ? 6'd8 : 6'd0))
  `FV_COVER(seen_wait_for_read, bvalid_o && $past(reads_first_q) == 2'd1)
  `FV_COVER(seen_time_of_write, bvalid_o && $past(write_alone_q && write_q == 6'd6))
  `FV_COVER(seen_time_of_read, rvalid_o && $past(read_alone_q && read_q == 6'd8))
  `FV_COVER(seen_both, bvalid_o && rvalid_o && bresp_o == '0 && rdata_o == 32'hA5)

endmodule

`default_nettype wire
