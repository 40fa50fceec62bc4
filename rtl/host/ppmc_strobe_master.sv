// SPDX-License-Identifier: Apache-2.0
// ppmc_strobe_master: read and write cycles on a part's strobe bus, for bridges that sit on the same chip.
// Rules:  UB-BUS-01; keeps P104-BUS-03/04, P2104 table 2.1, STMC-BUS-11/20, P312-PAR-10/11 at every CLK_HZ.
// Timing: req_i is taken in a clk with ready_o = 1, with we_i, addr_i and wdata_i. done_o is 1 for one clk when the
//         strobe has ended; rdata_o stands from then to the end of the next read. One write every 8 clk, one
//         read every 10 clk.
`default_nettype none

module ppmc_strobe_master #(
    parameter int unsigned AddrBits = 1,
    parameter int unsigned WriteClk = 4,  // length of a write strobe, at least 2
    parameter int unsigned ReadClk  = 6,  // length of a read strobe, at least 5
    parameter int unsigned GapClk   = 4   // clk with no strobe between two cycles, at least 3
) (
    input  wire logic                clk_i,
    input  wire logic                rst_ni,
    // master
    input  wire logic                req_i,    // a cycle is wanted
    input  wire logic                we_i,     // a write
    input  wire logic [AddrBits-1:0] addr_i,   // register
    input  wire logic [         7:0] wdata_i,  // what to write
    output logic                     ready_o,  // a cycle begins with req_i
    output logic                     done_o,   // it is over, one clk
    output logic      [         7:0] rdata_o,  // what was read, with done_o
    // the part's pins; cs_n falls and rises with the strobes
    output logic                     cs_no,    // the part is addressed
    output logic                     rd_no,    // read strobe
    output logic                     wr_no,    // write strobe
    output logic      [AddrBits-1:0] a_o,      // register
    output logic      [         7:0] d_o,      // to be written
    input  wire logic [         7:0] d_i       // what the part shows
);

  if (WriteClk < 2 || ReadClk < 5 || GapClk < 3) begin : g_check
    $fatal(1, "ppmc_strobe_master: WriteClk >= 2, ReadClk >= 5, GapClk >= 3");
  end

  localparam int unsigned Longest = ReadClk > WriteClk ? ReadClk : WriteClk;
  localparam int unsigned CntBits = $clog2((Longest > GapClk ? Longest : GapClk) + 1);

  typedef enum logic [1:0] {
    StIdle,
    StSetup,
    StStrobe,
    StGap
  } state_e;

  state_e state_q;
  logic [CntBits-1:0] left_q;  // clk left in this state, minus one
  logic write_q;

  assign ready_o = state_q == StIdle;
  assign rd_no   = cs_no || write_q;
  assign wr_no   = cs_no || !write_q;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      state_q <= StIdle;
      cs_no   <= 1'b1;
      write_q <= 1'b0;
      left_q  <= '0;
      done_o  <= 1'b0;
      a_o     <= '0;
      d_o     <= '0;
      rdata_o <= '0;
    end else begin
      done_o <= 1'b0;
      left_q <= left_q - 1'b1;
      unique case (state_q)
        StIdle:
        if (req_i) begin
          state_q <= StSetup;
          write_q <= we_i;
          a_o     <= addr_i;
          d_o     <= wdata_i;
        end
        StSetup: begin
          state_q <= StStrobe;
          cs_no   <= 1'b0;
          left_q  <= write_q ? CntBits'(WriteClk - 1) : CntBits'(ReadClk - 1);
        end
        StStrobe:
        if (left_q == '0) begin
          state_q <= StGap;
          cs_no   <= 1'b1;
          done_o  <= 1'b1;
          left_q  <= CntBits'(GapClk - 3);
          if (!write_q) rdata_o <= d_i;
        end
        default: if (left_q == '0) state_q <= StIdle;  // StGap
      endcase
    end
  end

endmodule

`default_nettype wire
