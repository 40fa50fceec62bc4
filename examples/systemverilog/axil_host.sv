// SPDX-License-Identifier: Apache-2.0
// axil_host: an AXI4-Lite manager that drives a PPMC-104 through ppmc_axil.
`default_nettype none

module axil_host (
    input  wire logic clk,
    input  wire logic rst_n,
    output logic      done    // 1: the session has passed
);

  logic awvalid = 1'b0, wvalid = 1'b0, bready = 1'b0, arvalid = 1'b0, rready = 1'b0;
  logic awready, wready, bvalid, arready, rvalid;
  logic [3:0] awaddr = '0, araddr = '0;
  logic [31:0] wdata = '0, rdata;
  logic [1:0] bresp, rresp;
  logic irq, hold, pout_n, dir;
  logic [5:1] s;

  ppmc104_example_axil u_dut (
      .clk,
      .rst_n,
      .s_axil_awvalid(awvalid),
      .s_axil_awready(awready),
      .s_axil_awaddr (awaddr),
      .s_axil_wvalid (wvalid),
      .s_axil_wready (wready),
      .s_axil_wdata  (wdata),
      .s_axil_wstrb  (4'b0001),
      .s_axil_bvalid (bvalid),
      .s_axil_bready (bready),
      .s_axil_bresp  (bresp),
      .s_axil_arvalid(arvalid),
      .s_axil_arready(arready),
      .s_axil_araddr (araddr),
      .s_axil_rvalid (rvalid),
      .s_axil_rready (rready),
      .s_axil_rdata  (rdata),
      .s_axil_rresp  (rresp),
      .irq,
      .l1_n          (1'b1),
      .l2_n          (1'b1),
      .l3_n          (1'b1),
      .l4_n          (1'b1),
      .cnp_n         (1'b1),
      .alm_n         (1'b1),
      .s,
      .hold,
      .pout_n,
      .dir
  );

  // Both tasks start and end after a falling edge. If ready is high on a falling edge, it is still high at
  // the next rising edge, and the transfer takes place there.
  task automatic write_reg(input logic register, input logic [7:0] value);
    logic aw_taken, w_taken;
    awvalid = 1'b1;
    awaddr  = {1'b0, register, 2'b00};
    wvalid  = 1'b1;
    wdata   = {24'd0, value};
    bready  = 1'b1;
    do begin
      aw_taken = awready;
      w_taken  = wready;
      @(negedge clk);
      if (aw_taken) awvalid = 1'b0;
      if (w_taken) wvalid = 1'b0;
    end while (awvalid || wvalid);
    while (!bvalid) @(negedge clk);
    check(bresp == 2'b00, "SLVERR at a register of the device");
    @(negedge clk);
    bready = 1'b0;
  endtask

  task automatic read_reg(input logic register, output logic [7:0] value);
    logic ar_taken;
    arvalid = 1'b1;
    araddr  = {1'b0, register, 2'b00};
    rready  = 1'b1;
    do begin
      ar_taken = arready;
      @(negedge clk);
    end while (!ar_taken);
    arvalid = 1'b0;
    while (!rvalid) @(negedge clk);
    value = rdata[7:0];
    check(rresp == 2'b00, "SLVERR at a register of the device");
    @(negedge clk);
    rready = 1'b0;
  endtask

  `include "session.svh"

endmodule

`default_nettype wire
