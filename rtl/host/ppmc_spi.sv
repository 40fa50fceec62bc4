// SPDX-License-Identifier: Apache-2.0
// ppmc_spi: SPI slave for the strobe bus of a device; mode 0 or 3, most significant bit first.
// Rules:  docs/bank/spi.md; strobes: UB-BUS-01.
// Timing: clk_i samples sck, mosi and cs_n. miso follows a falling edge of sck by 2 to 3 cycles. A write
//         begins 2 to 3 cycles after the last bit of its byte. A read begins 2 to 3 cycles after the first
//         bit of the byte that requests it. At any frequency of sck, an access ends long before the next
//         access can begin.
// Assumes: the low time of sck is longer than 3 cycles plus the delay of the pads (if clk is at least 8 times
//         as fast as sck, this leaves 1 cycle for the pads). The high time of sck is longer than 1 cycle.
`include "ppmc_assert.svh"
`default_nettype none

module ppmc_spi #(
    parameter int unsigned AddrBits = 10  // address lines of the device, 1 .. 10
) (
    input  wire logic                clk_i,
    input  wire logic                rst_ni,
    // SPI
    input  wire logic                sck_i,      // clock, asynchronous
    input  wire logic                mosi_i,     // data from the host, asynchronous
    input  wire logic                cs_ni,      // frame, asynchronous, active low
    output logic                     miso_o,     // data to the host: status, zeros or read data
    output logic                     miso_oe_o,  // 1: drive miso_o
    output logic                     active_o,   // LED, 1: a frame is being received
    // pins of the device
    output logic                     cs_no,      // chip select
    output logic                     rd_no,      // read strobe
    output logic                     wr_no,      // write strobe
    output logic      [AddrBits-1:0] a_o,        // register
    output logic      [         7:0] d_o,        // write data
    input  wire logic [         7:0] d_i,        // read data
    input  wire logic                int_ni      // interrupt, active low
);

  if (AddrBits < 1 || AddrBits > 10) begin : g_check
    $fatal(1, "ppmc_spi: AddrBits must be 1 .. 10");
  end

  typedef enum logic [1:0] {
    StHigh,  // receives the first byte of the header
    StLow,   // receives the second byte of the header
    StData,
    StWaste  // ignores the frame, because the header was rejected
  } state_e;

  typedef struct packed {
    logic fast;     // sck was low for less than 3 samples
    logic cut;      // cs_n rose within a byte or a header
    logic refused;  // bits 12:10 of a header were not 0
  } flags_t;

  typedef struct packed {
    logic write;
    logic axis;   // the address increases by 16 after each access
    logic next;   // the address increases by 1 after each access
  } mode_t;

  // ---- pins ------------------------------------------------------------------------------------------

  logic sck, mosi, cs_n;
  logic [2:0] meta, sck_q;  // sck_q: previous samples of sck, the newest is bit 0

  ppmc_sync #(
      .Width   (3),
      .ResetVal(3'b001)
  ) u_sync (
      .clk_i,
      .rst_ni,
      .d_i ({sck_i, mosi_i, cs_ni}),
      .q1_o(meta),
      .q2_o({sck, mosi, cs_n})
  );

  logic rise, fall, byte_end, frame_end;
  logic [2:0] count_q;  // number of received bits of this byte
  logic [6:0] bits_q;  // received bits of this byte
  logic [7:0] byte_in;

  assign rise    = !cs_n && sck && !sck_q[0];
  assign fall    = !cs_n && !sck && sck_q[0];
  assign byte_in = {bits_q, mosi};
  assign byte_end   = rise && count_q == 3'd7;
  assign frame_end   = cs_n && active_o;  // high for one cycle: active_o falls one cycle after cs_n rises

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      sck_q    <= '0;
      count_q  <= '0;
      bits_q   <= '0;
      active_o <= 1'b0;
    end else begin
      sck_q    <= {sck_q[1:0], sck};
      active_o <= !cs_n;
      if (cs_n) count_q <= '0;
      else if (rise) count_q <= count_q + 1'b1;
      if (rise) bits_q <= byte_in[6:0];
    end
  end

  // ---- frame -----------------------------------------------------------------------------------------

  state_e state_q;
  mode_t mode_q;
  logic [9:0] addr_q;
  logic reject_q;  // 1: the header is rejected
  logic req, ready, done, unused;

  assign unused = ^{addr_q, meta};

  // A read begins at the first bit of the byte that requests it, so that it ends during the other seven
  // bits.
  assign req    = state_q == StData && (mode_q.write ? byte_end : rise && count_q == '0 && mosi);

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      state_q  <= StHigh;
      mode_q   <= '0;
      addr_q   <= '0;
      reject_q <= 1'b0;
    end else begin
      if (cs_n) state_q <= StHigh;
      else if (byte_end)
        unique case (state_q)
          StHigh:  state_q <= StLow;
          StLow:   state_q <= reject_q ? StWaste : StData;
          default: state_q <= state_q;
        endcase
      if (byte_end && state_q == StHigh) begin
        mode_q      <= byte_in[7:5];
        reject_q    <= byte_in[4:2] != '0;
        addr_q[9:8] <= byte_in[1:0];
      end else if (byte_end && state_q == StLow) begin
        addr_q[7:0] <= byte_in;
      end else if (req) begin
        addr_q <= addr_q + {5'b0, mode_q.axis, 3'b0, mode_q.next};
      end
    end
  end

  // ---- data to the host ------------------------------------------------------------------------------

  flags_t sent_flags_q, flags_q, now;
  logic read_req_q;  // 1: the current byte from the host requests a read
  logic [7:0] out_q, status, rdata;

  always_comb begin
    now         = '0;
    now.fast    = rise && sck_q[2:1] != '0;
    now.cut     = frame_end && (count_q != '0 || state_q == StLow);
    now.refused = byte_end && state_q == StLow && reject_q;
  end

  // A flag remains set until a status byte with this flag has been sent completely.
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      sent_flags_q <= '0;
      flags_q <= '0;
    end else begin
      if (cs_n) sent_flags_q <= flags_q;
      if (byte_end && state_q == StHigh) flags_q <= (flags_q & ~sent_flags_q) | now;
      else flags_q <= flags_q | now;
    end
  end

  assign status = {4'b1000, flags_q, !int_ni};

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      read_req_q <= 1'b0;
      out_q      <= '0;
      miso_oe_o  <= 1'b0;
    end else begin
      miso_oe_o <= !cs_n;
      if (rise && count_q == '0) read_req_q <= req && !mode_q.write;
      if (cs_n) out_q <= status;
      else if (fall && count_q != '0) out_q <= out_q << 1;
      else if (fall && state_q != StHigh) out_q <= read_req_q ? rdata : '0;
    end
  end

  assign miso_o = out_q[7];

  // ---- bus of the device -----------------------------------------------------------------------------

  ppmc_strobe_master #(
      .AddrBits(AddrBits)
  ) u_master (
      .clk_i,
      .rst_ni,
      .req_i  (req),
      .we_i   (mode_q.write),
      .addr_i (addr_q[AddrBits-1:0]),
      .wdata_i(byte_in),
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

`ifndef SYNTHESIS
  logic open_q;  // 1: a read is in progress
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) open_q <= 1'b0;
    else open_q <= req ? !mode_q.write : open_q && !done;
  end

  `PPMC_ASSERT(spi_never_late, !req || ready)
  `PPMC_ASSERT(spi_read_in_time, !(fall && count_q == '0 && read_req_q && state_q == StData) || !open_q)
`endif

endmodule

`default_nettype wire
