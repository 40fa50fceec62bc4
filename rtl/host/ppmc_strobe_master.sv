// SPDX-License-Identifier: Apache-2.0
// ppmc_strobe_master: executes read and write accesses on the strobe bus of a device, for bridges on the
//         same chip.
// Rules:  UB-BUS-01. At every CLK_HZ, it complies with P104-BUS-03/04, the times of
//         docs/ppmc2104/README.md, 4.2, STMC-BUS-11/20 and P312-PAR-10/11.
// Timing: a request (req_i with we_i, addr_i and wdata_i) is accepted in a cycle in which ready_o is high.
//         done_o is high for one cycle when the strobe has ended. rdata_o is valid from then until the end
//         of the next read. A write takes 8 cycles, a read 10 cycles.
`default_nettype none

module ppmc_strobe_master #(
    parameter int unsigned AddrBits = 1,
    parameter int unsigned WriteCycles = 4,  // length of a write strobe in cycles; at least 2
    parameter int unsigned ReadCycles = 6,  // length of a read strobe in cycles; at least 5
    parameter int unsigned GapCycles = 4  // cycles without a strobe between two accesses; at least 3
) (
    input  wire logic                clk_i,
    input  wire logic                rst_ni,
    // master
    input  wire logic                req_i,    // 1: an access is requested
    input  wire logic                we_i,     // 1: the access is a write, 0: a read
    input  wire logic [AddrBits-1:0] addr_i,   // register
    input  wire logic [         7:0] wdata_i,  // write data
    output logic                     ready_o,  // 1: a request is accepted
    output logic                     done_o,   // strobe: the access has ended
    output logic      [         7:0] rdata_o,  // read data; valid with done_o
    // pins of the device; cs_n has the timing of the strobes
    output logic                     cs_no,    // chip select
    output logic                     rd_no,    // read strobe
    output logic                     wr_no,    // write strobe
    output logic      [AddrBits-1:0] a_o,      // register
    output logic      [         7:0] d_o,      // write data
    input  wire logic [         7:0] d_i       // read data
);

  if (WriteCycles < 2 || ReadCycles < 5 || GapCycles < 3) begin : g_check
    $fatal(1, "ppmc_strobe_master: WriteCycles >= 2, ReadCycles >= 5, GapCycles >= 3");
  end

  localparam int unsigned LongestCycles = ReadCycles > WriteCycles ? ReadCycles : WriteCycles;
  localparam int unsigned CntBits = $clog2((LongestCycles > GapCycles ? LongestCycles : GapCycles) + 1);

  typedef enum logic [1:0] {
    StIdle,
    StSetup,
    StStrobe,
    StGap
  } state_e;

  state_e state_q;
  logic [CntBits-1:0] left_q;  // remaining cycles in the current state, minus 1
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
          left_q  <= write_q ? CntBits'(WriteCycles - 1) : CntBits'(ReadCycles - 1);
        end
        StStrobe:
        if (left_q == '0) begin
          state_q <= StGap;
          cs_no   <= 1'b1;
          done_o  <= 1'b1;
          left_q  <= CntBits'(GapCycles - 3);
          if (!write_q) rdata_o <= d_i;
        end
        default: if (left_q == '0) state_q <= StIdle;  // StGap
      endcase
    end
  end

endmodule

`default_nettype wire
