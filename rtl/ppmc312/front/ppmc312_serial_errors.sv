// SPDX-License-Identifier: Apache-2.0
// ppmc312_serial_errors: counts framing, overrun and checksum errors since the last read (0 to 255,
//         saturating).
// Rules:  P312-SER-14, P312-SER-15, P312-SER-45.
// Timing: count_o follows error_i and read_i by one cycle.
// Assumes: at most one error per cycle, no error in the cycle of read_i.
`include "ppmc_assert.svh"
`default_nettype none

module ppmc312_serial_errors (
    input  wire logic            clk_i,    // clock
    input  wire logic            rst_ni,   // reset, asynchronous
    input  wire logic [2:0]      error_i,  // strobes, [0]: framing, [1]: overrun, [2]: checksum error
    input  wire logic            read_i,   // strobe: the counts are read and set to 0
    output logic      [2:0][7:0] count_o   // counts, indexed as error_i, 0 .. 255
);

  logic [7:0] old, more;

  assign old  = error_i[0] ? count_o[0] : error_i[1] ? count_o[1] : count_o[2];
  assign more = (old == '1) ? old : 8'(ppmc_pkg::inc(32'(old)));

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) count_o <= '0;
    else if (read_i) count_o <= '0;
    else begin
      for (int unsigned n = 0; n < 3; n++) if (error_i[n]) count_o[n] <= more;
    end
  end

`ifndef SYNTHESIS
  `PPMC_ASSERT(p312_ser_45, (error_i & (error_i - 1'b1)) == '0 && !(read_i && error_i != '0))
`endif

endmodule

`default_nettype wire
