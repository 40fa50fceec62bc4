// SPDX-License-Identifier: Apache-2.0
// ppmc104_smoke: minimal test for a project that imports the PPMC-104: initialise, output 14 pulses CW, read
//         the finish status.
// Timing: prints "ppmc104_smoke: PASS" or "ppmc104_smoke: FAIL …", and ends. Only this line is checked.
`default_nettype none

module ppmc104_smoke;

  localparam int unsigned Pulses = 14;

  logic clk = 1'b0, rst_n = 1'b1, a0 = 1'b0, cs_n = 1'b1, rd_n = 1'b1, wr_n = 1'b1;
  logic [7:0] to_part = '0, from_part, value;
  logic d_oe, int_n, aux_n, hold, pout_n, dir;
  logic [3:0] auxo;
  logic [5:1] s;
  int unsigned count = 0;

  ppmc104 u_part (
      .clk,
      .rst_n,
      .a0,
      .cs_n,
      .rd_n,
      .wr_n,
      .d_i  (to_part),
      .d_o  (from_part),
      .d_oe,
      .int_n,
      .csel (1'b1),
      .vsel (1'b1),
      .clock(1'b0),
      .l1_n (1'b1),
      .l2_n (1'b1),
      .l3_n (1'b1),
      .l4_n (1'b1),
      .cnp_n(1'b1),
      .alm_n(1'b1),
      .auxi (4'b0000),
      .auxo,
      .aux_n,
      .s,
      .hold,
      .pout_n,
      .dir
  );

  always #31250ps clk = !clk;

  always @(negedge pout_n) count <= count + 1;

  task automatic cycle(input logic write, input logic register);
    @(negedge clk);
    a0   = register;
    cs_n = 1'b0;
    wr_n = !write;
    rd_n = write;
    repeat (5) @(negedge clk);
    value = from_part;
    cs_n  = 1'b1;
    wr_n  = 1'b1;
    rd_n  = 1'b1;
    repeat (3) @(negedge clk);
  endtask

  task automatic until_status(input logic [7:0] mask, input logic [7:0] wanted);
    do cycle(1'b0, 1'b1); while ((value & mask) != wanted);
  endtask

  task automatic put(input logic register, input logic [7:0] data);
    until_status(8'h02, 8'h00);
    to_part = data;
    cycle(1'b1, register);
  endtask

  task automatic judge(input logic good, input string what);
    if (!good) begin
      $display("ppmc104_smoke: FAIL %s, %0d pulses, value %h", what, count, value);
      $finish;
    end
  endtask

  initial begin
    repeat (2) @(negedge clk);
    rst_n = 1'b0;
    repeat (4) @(negedge clk);
    rst_n = 1'b1;
    repeat (4) @(negedge clk);
    count = 0;
    // 4 phases, full step, positive logic (high = energised); RL = 9, RH = 4, ramp of 4 pulses.
    put(1'b1, 8'h0A);
    put(1'b0, 8'd9);
    put(1'b0, 8'd4);
    put(1'b0, 8'd4);
    put(1'b0, 8'd0);
    put(1'b1, 8'h43);
    put(1'b0, 8'(Pulses - 1));
    put(1'b0, 8'd0);
    put(1'b0, 8'd0);
    until_status(8'h02, 8'h00);
    judge(value == 8'h04, "start refused");
    @(negedge int_n);
    judge(count == Pulses && !dir, "wrong pulses");
    put(1'b1, 8'h80);
    until_status(8'h01, 8'h01);
    cycle(1'b0, 1'b0);
    judge(value == 8'h83 && int_n, "wrong finish status");
    $display("ppmc104_smoke: PASS");
    $finish;
  end

  initial begin
    #20ms;
    judge(1'b0, "no end within 20 ms");
  end

endmodule

`default_nettype wire
