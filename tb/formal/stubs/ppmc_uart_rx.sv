// SPDX-License-Identifier: Apache-2.0
// ppmc_uart_rx, stub for the proofs of the blocks that read from it: outputs any valid and faulty
// characters at least six cycles apart, regardless of the line. ppmc_uart_rx_fv proves that the
// real receiver has one outcome per character.
`default_nettype none

module ppmc_uart_rx #(
    parameter int unsigned     Width   = 20,
    parameter longint unsigned Modulus = 0
) (
    input  wire logic             clk_i,
    input  wire logic             rst_ni,
    input  wire logic [Width-1:0] step_i,
    input  wire logic [Width-1:0] wrap_i,
    input  wire logic             rxd_i,
    output logic      [      7:0] byte_o,
    output logic                  valid_o,
    output logic                  error_o,
    output logic                  break_o
);

  logic [7:0] any;  // not driven; the register ensures that all blocks read the same value
  logic [7:0] any_q;
  logic good, good_q, comes, comes_q;
  logic [2:0] gap_q;

  always_ff @(posedge clk_i or negedge rst_ni)
    if (!rst_ni) {byte_o, valid_o, error_o, break_o, any_q, good_q, comes_q, gap_q} <= '0;
    else begin
      {any_q, good_q, comes_q} <= {any, good, comes};
      {valid_o, error_o} <= '0;
      if (gap_q != '0) gap_q <= gap_q - 1'b1;
      else if (comes_q)
        {byte_o, valid_o, error_o, break_o, gap_q} <= {any_q, good_q, !good_q, any_q == '0, 3'd5};
    end

endmodule

`default_nettype wire
