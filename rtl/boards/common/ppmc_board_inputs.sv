// SPDX-License-Identifier: Apache-2.0
// ppmc_board_inputs: connects the input pins to the device. With a recorder, this block synchronises the
//         pins, so that the recorder and the device sample the same levels in the same cycle. Without a
//         recorder, it passes the pins unchanged.
// Rules:  UB-REC-05.
// Timing: latency 2 cycles with Sync = 1, otherwise combinational.
`default_nettype none

module ppmc_board_inputs #(
    parameter int unsigned Width = 1,
    parameter bit          Sync  = 1'b0
) (
    input  wire logic             clk_i,
    input  wire logic             rst_ni,  // reset, asynchronous
    input  wire logic [Width-1:0] d_i,     // pins, asynchronous
    output logic      [Width-1:0] q_o      // pins of the device
);

  if (Sync) begin : g_sync
    logic [Width-1:0] unused_meta;

    ppmc_sync #(
        .Width(Width)
    ) u_sync (
        .clk_i,
        .rst_ni,
        .d_i,
        .q1_o(unused_meta),
        .q2_o(q_o)
    );
  end else begin : g_wires
    assign q_o = d_i;

    logic unused;
    assign unused = clk_i && rst_ni;
  end

endmodule

`default_nettype wire
