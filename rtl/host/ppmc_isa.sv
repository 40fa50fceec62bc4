// SPDX-License-Identifier: Apache-2.0
// ppmc_isa: 8-bit ISA or PC/104 slave for devices with two registers each. Contains the address decoder,
//         the bus driver and the common interrupt.
// Rules:  ISA-01..07, ISA-11 (docs/ppmc2104/isa.md); J105-01..03 and J105-05 with Parts = 1.
// Timing: address, strobes and bus release are combinational; the devices sample them (ppmc_strobe_bus).
//         irq_o follows int_ni by one cycle. A write to the source register holds irq_o low, from the first
//         rising edge of clk_i that samples the write active to the first rising edge that samples it
//         inactive.
`include "ppmc_assert.svh"
`default_nettype none

module ppmc_isa #(
    // Number of devices. Device p has its data register at Base + 2p, and its status and command register at
    // Base + 2p + 1.
    parameter int unsigned Parts  = 1,
    // 1: the first address after those of the devices is a source register. Its bit p is the interrupt of
    // device p. If an interrupt is active, a write to this register causes another rising edge of irq_o.
    parameter bit          Source = 1'b0,
    parameter int unsigned Base   = 'h3B0  // base address, a multiple of the window's length
) (
    input  wire logic                  clk_i,
    input  wire logic                  rst_ni,
    // ISA
    input  wire logic [      9:0]      sa_i,     // address
    input  wire logic                  aen_i,    // 1: the address belongs to a DMA transfer
    input  wire logic                  ior_ni,   // read strobe
    input  wire logic                  iow_ni,   // write strobe
    output logic      [      7:0]      sd_o,     // data read by the host
    output logic                       sd_oe_o,  // 1: drive sd_o, because the host reads
    output logic                       irq_o,    // 1: at least one device has an interrupt
    // devices; ior_ni and iow_ni are connected directly to them
    output logic      [Parts-1:0]      cs_no,    // chip selects
    output logic                       a0_o,     // 0: data, 1: status or command
    input  wire logic [Parts-1:0][7:0] d_i,      // read data of the devices
    input  wire logic [Parts-1:0]      d_oe_i,   // 1: the device is being read
    input  wire logic [Parts-1:0]      int_ni    // interrupts of the devices, active low
);

  localparam int unsigned Bits = $clog2(2 * Parts + (Source ? 1 : 0));  // address bits inside the window

  if (Parts < 1 || Parts > 8) begin : g_check_parts
    $fatal(1, "ppmc_isa: Parts must be 1 .. 8");
  end
  if (Base > 'h3FF || Base % (1 << Bits) != 0) begin : g_check_base
    $fatal(1, "ppmc_isa: Base must be 0 .. 3FFh and a multiple of the window's length");
  end

  // ---- address decoder -------------------------------------------------------------------------------

  logic in_window, hit_source, read, write;
  logic [ Bits-1:0] pair;  // index of the addressed register pair
  logic [Parts-1:0] hit;

  assign in_window  = !aen_i && (sa_i >> Bits) == 10'(Base >> Bits);
  assign pair       = Bits'({1'b0, sa_i[Bits-1:0]} >> 1);
  assign read       = !ior_ni && iow_ni;
  assign write      = !iow_ni && ior_ni;
  assign a0_o       = sa_i[0];
  assign cs_no      = ~hit;
  assign hit_source = Source && in_window && sa_i[Bits-1:0] == Bits'(2 * Parts);

  always_comb begin
    for (int unsigned p = 0; p < Parts; p++) hit[p] = in_window && pair == Bits'(p);
  end

  // ---- interrupts ------------------------------------------------------------------------------------

  logic source_oe;
  logic [Parts-1:0] source;  // stable while the host reads the source register

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) irq_o <= 1'b0;
    else irq_o <= |(~int_ni) && !(hit_source && write);
  end

  if (Source) begin : g_source
    always_ff @(posedge clk_i or negedge rst_ni) begin
      if (!rst_ni) begin
        source_oe <= 1'b0;
        source    <= '0;
      end else begin
        source_oe <= hit_source && read;
        if (!source_oe) source <= ~int_ni;
      end
    end
  end else begin : g_no_source
    assign source_oe = 1'b0;
    assign source    = '0;
  end

  // ---- data to the host ------------------------------------------------------------------------------

  assign sd_oe_o = read && (|(hit & d_oe_i) || (hit_source && source_oe));

  always_comb begin
    sd_o = d_i[0];
    for (int unsigned p = 1; p < Parts; p++) if (hit[p]) sd_o = d_i[p];
    if (source_oe) sd_o = 8'(source);
  end

`ifndef SYNTHESIS
  `PPMC_ASSERT(isa_one_part, (d_oe_i & (d_oe_i - 1'b1)) == '0 && !(|d_oe_i && source_oe))
`endif

endmodule

`default_nettype wire
