// SPDX-License-Identifier: Apache-2.0
// hosts_tb: a PPMC-104 on each bridge (Wishbone, AXI4-Lite, SPI), and the same move through each of them.
// Timing: prints "hosts_tb: PASS" and ends with exit code 0; a failing check ends the simulation with $fatal.
//         All inputs change on the falling edge: see README.md.
`default_nettype none

module hosts_tb;

  logic clk = 1'b0, rst_n = 1'b1;
  logic [2:0] done;

  always #31250ps clk = !clk;  // 16 MHz, the default CLK_HZ

  wishbone_host u_wishbone (
      .clk,
      .rst_n,
      .done(done[0])
  );

  axil_host u_axil (
      .clk,
      .rst_n,
      .done(done[1])
  );

  spi_host u_spi (
      .clk,
      .rst_n,
      .done(done[2])
  );

  // A simulator without X at time 0 needs a falling edge of rst_n for the asynchronous reset.
  initial begin
    repeat (2) @(negedge clk);
    rst_n = 1'b0;
    repeat (4) @(negedge clk);
    rst_n = 1'b1;
  end

  always @(negedge clk) begin
    if (done == 3'b111) begin
      $display("hosts_tb: PASS");
      $finish;
    end
  end

  initial begin
    #50ms;
    $fatal(1, "hosts_tb: no end after 50 ms; done (spi, axil, wishbone) is %b", done);
  end

endmodule

`default_nettype wire
