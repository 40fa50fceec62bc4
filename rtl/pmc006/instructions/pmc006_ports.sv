// SPDX-License-Identifier: Apache-2.0
// pmc006_ports: contains the register of the general outputs, and drives their pins.
// Rules:  P006-CMD-46, P006-IO-02/03, P006-STL-03; instruction OUT: docs/pmc006/README.md, 13.
// Timing: gpo_reg_o changes at the edge that ends the cycle of write_i. gpo_o follows gpo_reg_o by one
//         cycle.
`default_nettype none

module pmc006_ports
  import pmc006_pkg::*;
(
    input  wire logic            clk_i,
    input  wire logic            rst_ni,
    input  wire exec_cmd_t       cmd_i,        // instruction in progress
    input  wire logic            write_i,      // strobe: execute cmd_i; its data are accepted
    input  wire logic            stall_pin_i,  // 1: drive GPO5 high (stall)
    output logic           [4:0] gpo_reg_o,    // register GPO
    output logic           [4:0] gpo_o         // pins of the general outputs
);

  logic unused_bits;

  assign unused_bits = &{1'b0, cmd_i};

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      gpo_reg_o <= '0;
      gpo_o <= '0;
    end else begin
      gpo_o <= {gpo_reg_o[4] || stall_pin_i, gpo_reg_o[3:0]};
      if (write_i && cmd_i.op == I_OUT) gpo_reg_o <= cmd_i.data[7:3];
      for (int unsigned i = 0; i < 5; i++) begin
        if (write_i && cmd_i.op == P_OUT && cmd_i.option == 4'(i + 1)) gpo_reg_o[i] <= cmd_i.data[0];
      end
    end
  end

endmodule

`default_nettype wire
