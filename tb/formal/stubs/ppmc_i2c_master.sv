// SPDX-License-Identifier: Apache-2.0
// ppmc_i2c_master, stub for the proofs of the blocks that use it: a command lasts for any number of ticks, at
// least one, and ends with done_o or fail_o, any byte and any acknowledgement, regardless of the lines. Ticks
// are at least two cycles apart. ppmc_i2c_master_fv proves that each command of the real master ends.
`default_nettype none

module ppmc_i2c_master
  import ppmc_i2c_pkg::*;
#(
    parameter int unsigned ClkHz = 16_000_000,
    parameter int unsigned SclHz = 400_000
) (
    input  wire logic           clk_i,
    input  wire logic           rst_ni,
    output logic                tick_o,
    input  wire i2c_cmd_e       cmd_i,
    input  wire logic     [7:0] byte_i,
    input  wire logic           ack_i,
    output logic                first_o,
    output logic                done_o,
    output logic                fail_o,
    output logic          [7:0] byte_o,
    output logic                nack_o,
    input  wire logic           scl_i,
    input  wire logic           sda_i,
    output logic                scl_oe_o,
    output logic                sda_oe_o
);

  logic [11:0] any;  // not driven; the registers ensure that all blocks read the same value
  logic comes_q, ends_q, fails_q, begun_q;  // begun_q: a tick of the command has passed

  assign first_o  = tick_o && cmd_i == CmdByte && !begun_q;
  assign scl_oe_o = 1'b0;
  assign sda_oe_o = 1'b0;

  always_ff @(posedge clk_i or negedge rst_ni)
    if (!rst_ni) {comes_q, ends_q, fails_q, byte_o, nack_o, tick_o, done_o, fail_o, begun_q} <= '0;
    else begin
      {comes_q, ends_q, fails_q, nack_o, byte_o} <= any;
      tick_o <= comes_q && !tick_o;
      {done_o, fail_o} <= '0;
      if (done_o || fail_o) begun_q <= 1'b0;
      else if (tick_o && cmd_i != CmdNone)
        {begun_q, done_o, fail_o} <= {1'b1, ends_q && !fails_q, ends_q && fails_q};
    end

endmodule

`default_nettype wire
