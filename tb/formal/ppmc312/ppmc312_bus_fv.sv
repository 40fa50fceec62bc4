// SPDX-License-Identifier: Apache-2.0
// ppmc312_bus_fv: proves that each write strobe of the host causes one write of its last sample, that the bus
// is driven only during reads and with one value, and the length of the wait request. T_WRQ is 6 cycles.
`include "ppmc_fv.svh"
`default_nettype none

module ppmc312_bus_fv (
    input wire logic       clk_i,
    input wire logic       off_i,
    input wire logic [2:0] rs_i,
    input wire logic       cs_ni,
    input wire logic       we_ni,
    input wire logic       oe_ni,
    input wire logic [7:0] d_i,
    input wire logic       wait_i,
    input wire logic [7:0] rd_data_i
);

  localparam logic [3:0] WaitCycles = 4'd6;

  logic [7:0] d_o, wr_data_o;
  logic d_oe_o, wrq_no, wr_o, rd_show_o, rd_done_o;
  logic [2:0] wr_rs_o, rd_rs_o;

  `FV_RESET

  ppmc312_bus #(
      .WaitCycles(32'(WaitCycles))
  ) dut (
      .rst_wait_ni(rst_ni),
      .*
  );

  // xN_q: level or access N cycles ago
  logic read, write, data_access;
  logic w1_q, w2_q, w3_q, r1_q, r2_q, r3_q, r4_q, a1_q, a2_q, a3_q;
  logic [10:0] byte1_q, byte2_q, byte3_q;  // register and byte of the writes
  logic [2:0] rs1_q, rs2_q, shown_rs_q;
  logic [7:0] shown_q;  // value of the read that is in progress

  assign read = !cs_ni && !off_i && we_ni && !oe_ni;
  assign write = !cs_ni && !off_i && !we_ni && oe_ni;
  assign data_access = (write && rs_i == 3'd5) || (read && rs_i == 3'd7);  // DWR, DRR

  always_ff @(posedge clk_i) begin
    if (!rst_ni) {w3_q, w2_q, w1_q, r4_q, r3_q, r2_q, r1_q, a3_q, a2_q, a1_q, byte3_q} <= '0;
    else begin
      {w3_q, w2_q, w1_q}       <= {w2_q, w1_q, write};
      {r4_q, r3_q, r2_q, r1_q} <= {r3_q, r2_q, r1_q, read};
      {a3_q, a2_q, a1_q}       <= {a2_q, a1_q, data_access};
      if (w2_q) byte3_q <= byte2_q;
    end
    {byte2_q, byte1_q} <= {byte1_q, rs_i, d_i};
    {rs2_q, rs1_q}     <= rst_ni ? {rs1_q, rs_i} : '1;
    if (rd_show_o) {shown_rs_q, shown_q} <= {rs2_q, rd_data_i};
  end

  `FV_ASSERT(p312_par_10_each_write_once, wr_o == (w3_q && !w2_q && !off_i))
  `FV_ASSERT(p312_par_10_last_sample, !wr_o || {wr_rs_o, wr_data_o} == byte3_q)
  `FV_ASSERT(p312_par_11_drives_only_in_reads, d_oe_o == (r3_q && r4_q))
  `FV_ASSERT(p312_par_11_latched_once, rd_show_o == (r2_q && r3_q && !r4_q))
  `FV_ASSERT(p312_par_11_its_register, rd_rs_o == (d_oe_o ? shown_rs_q : rs2_q))
  `FV_ASSERT(p312_par_11_its_value, !d_oe_o || d_o == shown_q)
  `FV_ASSERT(p312_par_11_ends_once, rd_done_o == (r3_q && r4_q && !r2_q))

  // ---- wait request ---------------------------------------------------------------------------------

  logic [3:0] age_q;  // cycles from the end of the last data access to the present sample, at most WaitCycles
  logic waits, begins;  // waits: the access that begins now is stretched
  logic [3:0] low_q;  // remaining cycles of the request

  assign begins = a2_q && !a3_q;
  assign waits  = begins && wait_i && age_q < WaitCycles;

  always_ff @(posedge clk_i)
    if (!rst_ni) {age_q, low_q} <= {WaitCycles, 4'd0};
    else begin
      if (a3_q && !a2_q) age_q <= 4'd1;
      else if (age_q < WaitCycles) age_q <= age_q + 4'd1;
      if (waits) low_q <= WaitCycles - age_q;
      else if (low_q != '0) low_q <= low_q - 4'd1;
    end

  `FV_ASSERT(p312_par_12_request, wrq_no == (low_q == '0))
  `FV_COVER(seen_read_and_write, rd_done_o && byte3_q != '0 && shown_q != '0)
  `FV_COVER(seen_longest_request, low_q == 4'd4)

endmodule

`default_nettype wire
