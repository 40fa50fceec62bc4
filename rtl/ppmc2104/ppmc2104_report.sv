// SPDX-License-Identifier: Apache-2.0
// ppmc2104_report: error registers and interrupt causes of both axes, and the INT output.
// Rules:  P2104-ERR-06, P2104-RD-03/07, P2104-STA-06, P2104-INT-01..05.
// Timing: error_report_i, end_i, read_end_i and read_error_i take effect at the edge that ends their cycle.
//         int_no follows one cycle later. If a cause is cleared at edge e, int_no is high from edge e + 1
//         until at least edge e + 1 + WidthCycles.
`include "ppmc_assert.svh"
`default_nettype none

module ppmc2104_report
  import ppmc2104_pkg::*;
#(
    parameter int unsigned WidthCycles = 80  // minimum release time of int_no in cycles
) (
    input  wire logic                   clk_i,
    input  wire logic                   rst_ni,
    input  wire error_report_t          error_report_i,  // errors to be stored
    input  wire logic                   errint_ni,       // ERRINT, synchronised
    input  wire logic          [AXES:1] end_i,           // strobe: operation with interrupt (I = 0) ends
    input  wire logic          [AXES:1] read_end_i,      // strobe: End status read is executed
    input  wire logic          [AXES:1] read_error_i,    // strobe: Error code read is executed
    output cmd_error_e         [AXES:1] error_o,         // error registers
    output logic                        any_error_o,     // at least one error register is not 0
    output logic                        int_no           // interrupt, low while a cause is set
);

  localparam int unsigned Width = ppmc_pkg::cnt_width(WidthCycles - 1);

  logic [AXES:1] end_q, error_q;
  logic [Width-1:0] age_q;  // cycles since a cause was cleared
  logic release_d, window_q;

  assign any_error_o = error_o != '0;
  assign release_d   = ((read_end_i & end_q) | (read_error_i & error_q)) != '0;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      error_o  <= '0;
      error_q  <= '0;
      end_q    <= '0;
      window_q <= 1'b0;
      int_no   <= 1'b1;
    end else begin
      for (int n = 1; n <= AXES; n++) begin
        if (error_report_i.axis[n]) error_o[n] <= error_report_i.number;
        else if (read_error_i[n]) error_o[n] <= ErrNone;
      end
      error_q  <= (error_q & ~read_error_i) | (errint_ni ? '0 : error_report_i.axis);
      end_q    <= (end_q & ~read_end_i) | end_i;
      window_q <= release_d || (window_q && age_q != Width'(WidthCycles - 1));
      int_no   <= window_q || (end_q == '0 && error_q == '0);
    end
  end

  // No reset: clearing a cause sets age_q to 0.
  always_ff @(posedge clk_i) begin
    if (release_d) age_q <= '0;
    else age_q <= age_q + 1'b1;
  end

`ifndef SYNTHESIS
  `PPMC_ASSERT(p2104_err_once, error_report_i.axis != '1)
  `PPMC_ASSERT(p2104_err_read, (error_report_i.axis & read_error_i) == '0)
  `PPMC_ASSERT(p2104_int_02, (read_end_i & end_i) == '0)
`endif

endmodule

`default_nettype wire
