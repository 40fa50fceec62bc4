// SPDX-License-Identifier: Apache-2.0
// ppmc_axil_fv: proves the handshake rules of an AXI4-Lite subordinate for any manager that follows the
// rules for managers. Each request gets one response in time, even if reads and writes wait at the same
// time.
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
  `FV_COVER(seen_both, bvalid_o && rvalid_o && bresp_o == '0 && rdata_o == 32'hA5)

endmodule

`default_nettype wire
