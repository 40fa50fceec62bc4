// SPDX-License-Identifier: Apache-2.0
// Host program, the same for each bridge. The module that includes it defines the tasks
//   write_reg(register, value) and read_reg(register, value): register 0 is data, 1 is status and command
// and the signals rst_n, irq, pout_n, dir and done.

localparam logic Data = 1'b0, Command = 1'b1, Status = 1'b1;
localparam int Pulses = 100;

int pulses = 0;

always @(negedge pout_n) pulses = pulses + 1;

task automatic check(input logic good, input string what);
  if (!good) $fatal(1, "%m: %s; %0d pulses", what, pulses);
endtask

// Return the status when the input buffer is empty (IBF, bit 1). ERR (bit 7) = 1: the last byte was rejected.
task automatic ready(output logic [7:0] status);
  do read_reg(Status, status); while (status[1]);
  check(!status[7], $sformatf("status %h: byte rejected", status));
endtask

task automatic send(input logic register, input logic [7:0] value);
  logic [7:0] status;
  ready(status);
  write_reg(register, value);
endtask

// Read a byte of an answer. OBF (bit 0) is 1 when the byte can be read.
task automatic receive(output logic [7:0] value);
  logic [7:0] status;
  do read_reg(Status, status); while (!status[0]);
  read_reg(Data, value);
endtask

initial begin
  logic [7:0] value;
  done = 1'b0;
  @(negedge rst_n);
  @(posedge rst_n);
  repeat (8) @(negedge clk);
  read_reg(Status, value);
  check(value == 8'h00, $sformatf("status %h after reset instead of 00", value));

  // 4-phase, full step, high switches a coil on; RL 9 (50 000 pps), RH 4 (100 000 pps), ramp of 8 pulses.
  send(Command, 8'h0A);
  send(Data, 8'd9);
  send(Data, 8'd4);
  send(Data, 8'd8);
  send(Data, 8'd0);

  // Acceleration/deceleration move, CCW, D + 1 pulses.
  pulses = 0;
  send(Command, 8'h4B);
  send(Data, 8'(Pulses - 1));
  send(Data, 8'd0);
  send(Data, 8'd0);
  ready(value);
  check(value[2], $sformatf("status %h: BUSY is 0, the move has not begun", value));
  do read_reg(Status, value); while (value[2]);

  check(pulses == Pulses, $sformatf("expected %0d pulses", Pulses));
  check(dir, "dir is 0, which is CW");
  repeat (2) @(negedge clk);
  check(irq, "no interrupt at the end of the move");

  send(Command, 8'h80);
  receive(value);
  check(value == 8'h83, $sformatf("finish status %h instead of 83", value));
  repeat (2) @(negedge clk);
  check(!irq, "interrupt pending after the finish status was read");
  done = 1'b1;
end
