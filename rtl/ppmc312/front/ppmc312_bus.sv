// SPDX-License-Identifier: Apache-2.0
// ppmc312_bus: converts the strobes of the 8-bit parallel bus to register writes and reads, and drives the
//         wait request.
// Rules:  P312-PAR-09..12, P312-GEN-01.
// Timing: when the end of a write is first sampled at edge 0, wr_o is high in the cycle before edge 2. When
//         the start of a read is first sampled at edge 0, the bus is driven from edge 3 until 2 edges after
//         the first sample of the end of the read. rd_done_o is high in the cycle before edge 2 after this
//         sample. d_o does not change during a strobe.
`include "ppmc_assert.svh"
`default_nettype none

module ppmc312_bus #(
    parameter int unsigned WaitCycles = 6  // T_WRQ (minimum time between data accesses) in cycles
) (
    input  wire logic       clk_i,        // clock
    input  wire logic       rst_ni,       // reset, asynchronous
    input  wire logic       rst_wait_ni,  // asynchronous reset of the wait request only
    input  wire logic       off_i,        // 1: accesses are ignored
    // pins
    input  wire logic [2:0] rs_i,         // register
    input  wire logic       cs_ni,        // chip select
    input  wire logic       we_ni,        // write strobe
    input  wire logic       oe_ni,        // read strobe
    input  wire logic [7:0] d_i,          // bus, from the host
    output logic      [7:0] d_o,          // bus, to the host
    output logic            d_oe_o,       // 1: drive the bus with d_o
    output logic            wrq_no,       // wait request
    // registers
    input  wire logic       wait_i,       // EWRQ, 1: the wait request is enabled
    output logic            wr_o,         // strobe: a write is complete
    output logic      [2:0] wr_rs_o,      // register; valid with wr_o
    output logic      [7:0] wr_data_o,    // written byte; valid with wr_o
    output logic      [2:0] rd_rs_o,      // register that is being read
    input  wire logic [7:0] rd_data_i,    // value of register rd_rs_o
    output logic            rd_show_o,    // strobe: rd_data_i is latched
    output logic            rd_done_o     // strobe: the read has ended
);

  localparam logic [2:0] RegDwr = 3'b101;
  localparam logic [2:0] RegDrr = 3'b111;
  localparam int unsigned Width = ppmc_pkg::cnt_width(WaitCycles);

  logic cs_n, we_n, oe_n, wr_s2, rd_s2, wr_s3_q, rd_s3_q, busy_s2, busy_s3_q;
  logic [2:0] rs_s2, rs_q;
  logic [ 7:0] d_s2;
  logic [13:0] unused_meta;

  ppmc_sync #(
      .Width(14)
  ) u_sync (
      .clk_i,
      .rst_ni,
      .d_i ({cs_ni || off_i, we_ni, oe_ni, rs_i, d_i}),
      .q1_o(unused_meta),
      .q2_o({cs_n, we_n, oe_n, rs_s2, d_s2})
  );

  assign wr_s2 = !cs_n && !we_n && oe_n;
  assign rd_s2 = !cs_n && we_n && !oe_n;
  assign wr_o = wr_s3_q && !wr_s2 && !off_i;
  assign rd_show_o = rd_s2 && rd_s3_q && !d_oe_o;
  assign rd_done_o = d_oe_o && !rd_s2;
  assign rd_rs_o = d_oe_o ? rs_q : rs_s2;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      wr_s3_q   <= 1'b0;
      rd_s3_q   <= 1'b0;
      wr_rs_o   <= '0;
      wr_data_o <= '0;
      rs_q      <= '0;
      d_oe_o    <= 1'b0;
      d_o       <= '0;
    end else begin
      wr_s3_q <= wr_s2;
      rd_s3_q <= rd_s2;
      if (wr_s2) begin
        wr_rs_o   <= rs_s2;
        wr_data_o <= d_s2;
      end
      // The address lines may still change at the first sample, so the address is taken from the second
      // sample.
      d_oe_o <= rd_s2 && rd_s3_q;
      if (rd_show_o) begin
        rs_q <= rs_s2;
        d_o  <= rd_data_i;
      end
    end
  end

  // If a data access begins less than T_WRQ after the end of the previous data access, the wait request
  // stretches the new access for the rest of T_WRQ.
  logic [Width-1:0] age_q;  // cycles since the end of the last data access
  logic [Width-1:0] wait_q;  // remaining cycles of the wait
  logic early;

  assign busy_s2 = (wr_s2 && rs_s2 == RegDwr) || (rd_s2 && rs_s2 == RegDrr);
  assign early   = busy_s2 && !busy_s3_q && wait_i && age_q != Width'(WaitCycles);

  always_ff @(posedge clk_i or negedge rst_wait_ni) begin
    if (!rst_wait_ni) begin
      busy_s3_q <= 1'b0;
      age_q <= Width'(WaitCycles);
      wait_q <= '0;
      wrq_no <= 1'b1;
    end else begin
      busy_s3_q <= busy_s2;
      if (busy_s3_q && !busy_s2) age_q <= Width'(1);
      else if (age_q != Width'(WaitCycles)) age_q <= age_q + 1'b1;
      if (early) wait_q <= Width'(WaitCycles) - age_q;
      else if (wait_q != '0) wait_q <= wait_q - 1'b1;
      wrq_no <= !early && wait_q <= Width'(1);
    end
  end

`ifndef SYNTHESIS
  `PPMC_ASSERT(p312_par_09, !(wr_s2 && rd_s2))
  `PPMC_ASSERT(p312_par_11_still, !(d_oe_o && $past(d_oe_o)) || d_o == $past(d_o))
`endif

endmodule

`default_nettype wire
