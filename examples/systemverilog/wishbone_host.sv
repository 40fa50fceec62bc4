// SPDX-License-Identifier: Apache-2.0
// wishbone_host: a Wishbone master that drives a PPMC-104 through ppmc_wishbone.
`default_nettype none

module wishbone_host (
    input  wire logic clk,
    input  wire logic rst_n,
    output logic      done    // 1: the session has passed
);

  logic cyc = 1'b0, stb = 1'b0, we = 1'b0;
  logic [3:2] adr = '0;
  logic [31:0] to_bridge = '0, from_bridge;
  logic ack, err, irq, hold, pout_n, dir;
  logic [5:1] s;

  ppmc104_example_wishbone u_dut (
      .clk,
      .rst_n,
      .wb_cyc  (cyc),
      .wb_stb  (stb),
      .wb_we   (we),
      .wb_adr  (adr),
      .wb_sel  (4'b0001),
      .wb_dat_w(to_bridge),
      .wb_dat_r(from_bridge),
      .wb_ack  (ack),
      .wb_err  (err),
      .irq,
      .l1_n    (1'b1),
      .l2_n    (1'b1),
      .l3_n    (1'b1),
      .l4_n    (1'b1),
      .cnp_n   (1'b1),
      .alm_n   (1'b1),
      .s,
      .hold,
      .pout_n,
      .dir
  );

  // The task starts and ends just after a falling edge. It samples ack on falling edges, too. The transfer is
  // complete at the rising edge that follows, so the request is stable until the next falling edge.
  task automatic transfer(input logic write, input logic register, input logic [7:0] value);
    cyc       = 1'b1;
    stb       = 1'b1;
    we        = write;
    adr       = {1'b0, register};
    to_bridge = {24'd0, value};
    do @(negedge clk); while (!ack && !err);
    check(ack, "err_o at a register of the device");
  endtask

  task automatic release_bus();
    @(negedge clk);
    cyc = 1'b0;
    stb = 1'b0;
    we  = 1'b0;
  endtask

  task automatic write_reg(input logic register, input logic [7:0] value);
    transfer(1'b1, register, value);
    release_bus();
  endtask

  task automatic read_reg(input logic register, output logic [7:0] value);
    transfer(1'b0, register, 8'h00);
    value = from_bridge[7:0];
    release_bus();
  endtask

  `include "session.svh"

endmodule

`default_nettype wire
