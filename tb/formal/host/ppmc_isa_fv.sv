// SPDX-License-Identifier: Apache-2.0
// ppmc_isa_fv: proves that a bus access selects at most one device, that DMA and the addresses of other
// cards select no device, and that the bus is driven only during reads of this card.
`include "ppmc_fv.svh"
`default_nettype none

module ppmc_isa_fv (
    input wire logic            clk_i,
    input wire logic [9:0]      sa_i,
    input wire logic            aen_i,
    input wire logic            ior_ni,
    input wire logic            iow_ni,
    input wire logic [1:0][7:0] d_i,
    input wire logic [1:0]      int_ni
);

  logic [7:0] sd_o;
  logic sd_oe_o, irq_o, a0_o, ours;
  logic [1:0] cs_no, d_oe_i;

  `FV_RESET

  ppmc_isa #(
      .Parts (2),
      .Source(1'b1),
      .Base  ('h3B0)
  ) dut (
      .*
  );

  // A device drives its data one cycle after the read strobe, as ppmc_strobe_bus does.
  always_ff @(posedge clk_i) d_oe_i <= rst_ni ? ~cs_no & {2{!ior_ni && iow_ni}} : '0;

  assign ours = !aen_i && sa_i >= 10'h3B0 && sa_i <= 10'h3B4;

  `FV_ASSERT(isa_01_one_part_at_most, cs_no != '0)
  `FV_ASSERT(
      isa_01_its_own_addresses,
      (cs_no[0] || (ours && sa_i <= 10'h3B1)) && (cs_no[1] || (ours && sa_i inside {10'h3B2, 10'h3B3})))
  `FV_ASSERT(isa_02_no_dma, !aen_i || (cs_no == '1 && !sd_oe_o))
  `FV_ASSERT(isa_03_drives_in_our_reads_alone, !sd_oe_o || (ours && !ior_ni && iow_ni))
  `FV_ASSERT(isa_03_part_one,
             !(sd_oe_o && !cs_no[1] && d_oe_i[1] && !d_oe_i[0]) || dut.source_oe || sd_o == d_i[1])
  `FV_ASSERT(isa_05_interrupt, !$past(rst_ni) || irq_o == ($past(int_ni != '1) && !$past
             (ours && sa_i == 10'h3B4 && !iow_ni && ior_ni)))
  `FV_ASSERT(source_stands_while_it_is_read, !(dut.source_oe && $past(dut.source_oe)) || dut.source == $past
             (dut.source))
  `FV_COVER(seen_source, sd_oe_o && sa_i == 10'h3B4 && sd_o == 8'h03)

endmodule

`default_nettype wire
