// SPDX-License-Identifier: Apache-2.0
// ppmc_wishbone: Wishbone B4 slave (classic cycles, 32 bits) for the strobe bus of a device.
// Rules:  register map and responses: docs/integration.md; strobes: UB-BUS-01.
// Timing: latencies from the first cycle of CYC and STB to the response: write to a device register 6 cycles,
//         read of a device register 8 cycles, each one cycle longer directly after another access; bridge
//         register and accesses with sel_i[0] = 0: 1 cycle. A master may abort an access: then there is no
//         response, but a strobe that has begun is completed.
`default_nettype none
`include "ppmc_assert.svh"

module ppmc_wishbone #(
    parameter int unsigned AddrBits = 1  // address lines of the device
) (
    input  wire logic                clk_i,
    input  wire logic                rst_ni,
    // Wishbone; adr_i has the bit numbers of a byte address
    input  wire logic                cyc_i,   // 1: bus cycle of the master
    input  wire logic                stb_i,   // 1: transfer of the bus cycle
    input  wire logic                we_i,    // 1: the transfer is a write, 0: a read
    input  wire logic [AddrBits+2:2] adr_i,   // register
    input  wire logic [         3:0] sel_i,   // byte enables; bit 0: bits 7:0 are used
    input  wire logic [        31:0] dat_i,   // write data in bits 7:0
    output logic      [        31:0] dat_o,   // read data in bits 7:0
    output logic                     ack_o,   // strobe: the transfer is complete
    output logic                     err_o,   // strobe: the transfer is rejected
    output logic                     irq_o,   // interrupt of the device, active high
    // pins of the device
    output logic                     cs_no,   // chip select
    output logic                     rd_no,   // read strobe
    output logic                     wr_no,   // write strobe
    output logic      [AddrBits-1:0] a_o,     // register
    output logic      [         7:0] d_o,     // write data
    input  wire logic [         7:0] d_i,     // read data
    input  wire logic                int_ni   // interrupt, active low
);

  logic call, bridge_reg, bad, done, ready, req, unused;
  logic [7:0] rdata;
  logic busy_q;  // 1: a strobe access of this bridge is in progress
  logic waiting_q;  // 1: the master still waits for the response of the strobe access
  logic no_strobe_q;  // 1: the current response needs no strobe
  logic error_q;  // 1: the current response is ERR, 0: ACK
  logic flag_q;  // data bit 0 of the current response

  assign unused = &{1'b0, sel_i[3:1], dat_i[31:8]};
  assign call = cyc_i && stb_i && !busy_q && !no_strobe_q;
  assign bridge_reg = adr_i[AddrBits+2];
  // bad: access to a reserved register, or write to the bridge register
  assign bad    = bridge_reg && (we_i || adr_i[AddrBits+1:2] != '0);
  assign req = call && !bridge_reg && sel_i[0];

  ppmc_strobe_master #(
      .AddrBits(AddrBits)
  ) u_master (
      .clk_i,
      .rst_ni,
      .req_i  (req),
      .we_i,
      .addr_i (adr_i[AddrBits+1:2]),
      .wdata_i(dat_i[7:0]),
      .ready_o(ready),
      .done_o (done),
      .rdata_o(rdata),
      .cs_no,
      .rd_no,
      .wr_no,
      .a_o,
      .d_o,
      .d_i
  );

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      busy_q <= 1'b0;
      waiting_q <= 1'b0;
      no_strobe_q <= 1'b0;
      error_q <= 1'b0;
      flag_q <= 1'b0;
      irq_o <= 1'b0;
    end else begin
      irq_o <= !int_ni;
      no_strobe_q <= call && (bridge_reg || !sel_i[0]);
      error_q <= bad;
      flag_q <= bridge_reg && !bad && irq_o;
      waiting_q <= cyc_i && stb_i && (waiting_q || !busy_q);
      if (req && ready) busy_q <= 1'b1;
      else if (done) busy_q <= 1'b0;
    end
  end

  // CYC and STB gate the response. Therefore, a master that aborts at the last moment receives no response.
  logic answer;
  assign answer = cyc_i && stb_i && (no_strobe_q || (done && waiting_q));
  assign ack_o  = answer && !(no_strobe_q && error_q);
  assign err_o  = answer && no_strobe_q && error_q;
  assign dat_o  = {24'd0, no_strobe_q ? {7'b0, flag_q} : rdata};

`ifndef SYNTHESIS
  // verilog_format: off
  `PPMC_ASSERT(wb_one_answer, !(ack_o && err_o))
  `PPMC_ASSERT(wb_answer_requested, !(ack_o || err_o) || (cyc_i && stb_i))
  `PPMC_ASSERT(wb_answer_single, !((ack_o || err_o) && $past(ack_o || err_o)))
  `PPMC_ASSERT(wb_ack_per_strobe, no_strobe_q || ack_o == (done && waiting_q && cyc_i && stb_i))
  `PPMC_ASSERT(wb_strobe_owned, !done || busy_q)
  // Obligation of the master: a request that is neither answered nor aborted does not change.
  `PPMC_ASSERT(wb_request_stable, !($past(rst_ni && cyc_i && stb_i && !ack_o && !err_o) && cyc_i && stb_i)
               || $past({we_i, adr_i, sel_i, dat_i[7:0]}) == {we_i, adr_i, sel_i, dat_i[7:0]})
  // verilog_format: on
`endif

endmodule

`default_nettype wire
