// SPDX-License-Identifier: Apache-2.0
// ppmc312_serial_errors_fv: compares each error count of the block with the number of its errors since the
// last read, limited to 255.
`include "ppmc_fv.svh"
`default_nettype none

module ppmc312_serial_errors_fv (
    input wire logic       clk_i,
    input wire logic [2:0] error_i,
    input wire logic       read_i
);

  logic [2:0][7:0] count_o, count_q;

  `FV_RESET

  ppmc312_serial_errors dut (.*);

  always_ff @(posedge clk_i)
    if (!rst_ni || read_i) count_q <= '0;
    else
      for (int unsigned n = 0; n < 3; n++)
        if (error_i[n] && count_q[n] != '1) count_q[n] <= count_q[n] + 8'd1;

  `FV_ASSUME(one_error, error_i inside {3'd0, 3'd1, 3'd2, 3'd4} && !(read_i && error_i != '0))

  `FV_ASSERT(p312_ser_45_counts, count_o == count_q)
  `FV_COVER(seen_counts, count_o[0] == 8'd2 && count_o[2] == 8'd1)

endmodule

`default_nettype wire
