// SPDX-License-Identifier: Apache-2.0
// ppmc_square: square wave with a half period of HalfXtal crystal cycles. A phase accumulator avoids drift.
// Rules:  P2104-PORT-06.
// Timing: toggle t occurs at rising edge number ceil(t * HalfXtal * ClkHz / XtalHz); edge 1 is the first
//         rising edge after reset. A half period is at least one cycle.
`default_nettype none

module ppmc_square #(
    parameter int unsigned ClkHz    = 16_000_000,
    parameter int unsigned XtalHz   = 16_000_000,
    parameter int unsigned HalfXtal = 2            // half period in crystal cycles
) (
    input  wire logic clk_i,
    input  wire logic rst_ni,
    output logic      wave_o   // square wave, registered; 0 in reset
);

  localparam longint unsigned Period = 64'(HalfXtal) * 64'(ClkHz);
  localparam longint unsigned Common = ppmc_pkg::gcd(Period, 64'(XtalHz));
  localparam int unsigned Modulus = 32'(Period / Common);
  localparam int unsigned Step = 32'(64'(XtalHz) / Common);
  localparam int unsigned Width = ppmc_pkg::cnt_width(Modulus - 1);

  if (Modulus < Step) begin : g_check
    $fatal(1, "ppmc_square: half a period must last at least one cycle");
  end

  logic [Width-1:0] phase_q;
  logic [Width:0] sum;
  logic wrap;

  assign sum  = {1'b0, phase_q} + (Width + 1)'(Step);
  assign wrap = sum >= (Width + 1)'(Modulus);

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      phase_q <= '0;
      wave_o  <= 1'b0;
    end else begin
      phase_q <= Width'(wrap ? sum - (Width + 1)'(Modulus) : sum);
      wave_o  <= wave_o ^ wrap;
    end
  end

endmodule

`default_nettype wire
