// SPDX-License-Identifier: Apache-2.0
// ppmc_i2c_master_fv: proves that the master follows the rules of the I2C bus for SDA, and that every
// command ends, regardless of the other device on the bus.
`include "ppmc_fv.svh"
`default_nettype none

module ppmc_i2c_master_fv
  import ppmc_i2c_pkg::*;
(
    input wire logic       clk_i,
    input wire logic [2:0] command_i,
    input wire logic [7:0] byte_i,
    input wire logic       ack_i,
    input wire logic       scl_i,
    input wire logic       sda_i
);

  localparam int unsigned Bound = 9 * (4 + 1) + 2;  // ticks of 9 bits: 4 ticks and 1 tick of stretching each

  i2c_cmd_e cmd_i;
  logic tick_o, first_o, done_o, fail_o, nack_o, scl_oe_o, sda_oe_o;
  logic [7:0] byte_o;

  assign cmd_i = i2c_cmd_e'(command_i);

  `FV_RESET

  ppmc_i2c_master #(
      .ClkHz(5_000),
      .SclHz(250)
  ) dut (
      .*
  );

  logic [5:0] age_q;  // ticks since the command became valid
  logic ended;

  assign ended = done_o || fail_o;

  always_ff @(posedge clk_i)
    if (!rst_ni || ended || cmd_i == CmdNone) age_q <= '0;
    else if (tick_o) age_q <= age_q + 1'b1;

  `FV_ASSUME(known_command, command_i <= 3'd4)
  `FV_ASSUME(command_stands, $past(!rst_ni || ended || cmd_i == CmdNone) || cmd_i == $past(cmd_i))
  `FV_ASSUME(pulled_low_is_low, !scl_oe_o || !scl_i)

  `FV_ASSERT(never_hangs, age_q < 6'(Bound))
  `FV_ASSERT(one_end, !(done_o && fail_o))
  `FV_ASSERT(ends_what_stood, !ended || $past(cmd_i != CmdNone))
  // While SCL is high, SDA changes only for START and STOP, or when a failure releases both lines.
  `FV_ASSERT(data_steady_while_clock_high, sda_oe_o == $past(sda_oe_o) || $past(scl_oe_o) || $past
             (cmd_i == CmdStart || cmd_i == CmdStop) || (!sda_oe_o && !scl_oe_o) || scl_oe_o)
  `FV_ASSERT(failure_releases_both, !fail_o || (!scl_oe_o && !sda_oe_o))
  `FV_COVER(seen_byte, done_o && $past(cmd_i == CmdByte))
  `FV_COVER(seen_stretched_out, fail_o)

endmodule

`default_nettype wire
