// SPDX-License-Identifier: Apache-2.0
// ppmc_i2c_master: master of an I2C bus that has no other master. Sends START, STOP and bytes, receives
//         bytes, and frees a bus whose data line is stuck.
// Rules:  docs/pmc006/README.md, 14 (EEPROM); P006-BAD-13 (clock held low).
// Timing: the lines change at tick_o. A bit takes four ticks: SDA changes, SCL rises, SDA is sampled, SCL
//         falls. START and STOP take six ticks. done_o or fail_o is high one cycle after the last tick of the
//         command. If the next command is valid before the next tick, it follows without a gap. While a
//         device holds SCL low, the sample is repeated at each tick for up to 1 ms. SCL rises SclRiseCycles
//         cycles after its tick, so that SCL is low for 55 % of its period, rounded up to a whole cycle.
// Assumes: cmd_i is stable until done_o or fail_o.
`include "ppmc_assert.svh"
`default_nettype none

module ppmc_i2c_master
  import ppmc_i2c_pkg::*;
#(
    parameter int unsigned ClkHz = 16_000_000,
    parameter int unsigned SclHz = 400_000      // frequency of SCL, at most ClkHz / 20
) (
    input  wire logic           clk_i,
    input  wire logic           rst_ni,
    output logic                tick_o,    // strobe: a tick, four per bit
    input  wire i2c_cmd_e       cmd_i,     // command
    input  wire logic     [7:0] byte_i,    // byte to send; 8'hff to receive
    input  wire logic           ack_i,     // ninth bit; 0: drive SDA low, 1: release SDA
    output logic                first_o,   // strobe: byte_i and ack_i are loaded at the next edge
    output logic                done_o,    // strobe: the command is complete
    output logic                fail_o,    // strobe: SCL or SDA is stuck; both are released
    output logic          [7:0] byte_o,    // received byte
    output logic                nack_o,    // ninth bit; for CmdFree: the last sampled bit
    input  wire logic           scl_i,     // SCL of the bus, synchronised
    input  wire logic           sda_i,     // SDA of the bus, synchronised
    output logic                scl_oe_o,  // 1: drive SCL low
    output logic                sda_oe_o   // 1: drive SDA low
);

  localparam int unsigned StretchTicks = 4 * SclHz / 1000 + 1;
  // SclLowCycles: 0.55 bit times in cycles (a 24C32 at 400 kHz needs SCL low for 1.3 us). SclRiseCycles:
  // SclLowCycles minus the shortest duration of two ticks.
  localparam longint unsigned Scl20 = 64'd20 * 64'(SclHz);
  localparam int unsigned SclLowCycles = 32'((64'd11 * 64'(ClkHz) + Scl20 - 64'd1) / Scl20);
  localparam int unsigned SclRiseCycles = SclLowCycles - ClkHz / (2 * SclHz);
  localparam int unsigned RiseBits = ppmc_pkg::cnt_width(SclRiseCycles - 1);
  localparam int unsigned StretchBits = ppmc_pkg::cnt_width(StretchTicks - 1);

  logic [2:0] step_q;
  logic [3:0] bit_q;
  logic [8:0] shift_q;
  logic [StretchBits-1:0] stretch_q;
  logic [RiseBits-1:0] rise_q;
  logic tick, frame, byte_ends, last, stretched, stuck, first, low;

  ppmc_tick_gen #(
      .ClkHz   (ClkHz),
      .XtalHz  (4 * SclHz),
      .TickXtal(1)
  ) u_tick (
      .clk_i,
      .rst_ni,
      .restart_i(1'b0),
      .tick_o   (tick)
  );

  assign tick_o = tick;
  assign frame = cmd_i == CmdStart || cmd_i == CmdStop;
  assign first = step_q == 3'd0 && bit_q == 4'd0 && !frame;
  assign low = first ? !byte_i[7] : !shift_q[8];
  assign stretched = step_q == 3'd2 && !scl_i;
  assign stuck = cmd_i == CmdFree && bit_q == 4'd8 && !shift_q[0];
  assign byte_ends = bit_q == 4'd8 || (cmd_i == CmdFree && shift_q[0]);
  assign last = frame ? step_q == 3'd5 : step_q == 3'd3 && byte_ends;

  assign first_o = tick && cmd_i == CmdByte && first;
  assign byte_o = shift_q[8:1];
  assign nack_o = shift_q[0];

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      step_q   <= '0;
      bit_q    <= '0;
      done_o   <= 1'b0;
      fail_o   <= 1'b0;
      scl_oe_o <= 1'b0;
      sda_oe_o <= 1'b0;
    end else begin
      done_o <= 1'b0;
      fail_o <= 1'b0;
      if (step_q == 3'd2 && rise_q == '0) scl_oe_o <= 1'b0;
      if (tick && cmd_i != CmdNone) begin
        if (!stretched) step_q <= last ? 3'd0 : step_q + 1'b1;
        unique case (step_q)
          3'd0: begin
            if (cmd_i != CmdStart) scl_oe_o <= 1'b1;
            sda_oe_o <= (cmd_i == CmdStop) || (cmd_i == CmdByte && low);
          end
          3'd3: begin
            if (frame) sda_oe_o <= cmd_i == CmdStart;
            else begin
              scl_oe_o <= !stuck;
              step_q   <= 3'd0;
              bit_q    <= last ? 4'd0 : bit_q + 1'b1;
              fail_o   <= stuck;
              done_o   <= last && !stuck;
            end
          end
          3'd5: begin
            scl_oe_o <= cmd_i == CmdStart;
            done_o   <= 1'b1;
          end
          default: ;
        endcase
        if (stretched && stretch_q == StretchBits'(StretchTicks - 1)) begin
          step_q   <= '0;
          bit_q    <= '0;
          fail_o   <= 1'b1;
          scl_oe_o <= 1'b0;
          sda_oe_o <= 1'b0;
        end
      end
    end
  end

  always_ff @(posedge clk_i) begin
    if (step_q != 3'd2) rise_q <= RiseBits'(SclRiseCycles - 1);
    else if (rise_q != '0) rise_q <= rise_q - 1'b1;
    if (step_q != 3'd2) stretch_q <= '0;
    else if (tick && stretched) stretch_q <= stretch_q + 1'b1;
    if (tick && first) shift_q <= {byte_i, ack_i};
    else if (tick && step_q == 3'd2 && scl_i) shift_q <= {shift_q[7:0], sda_i};
  end

`ifndef SYNTHESIS
  `PPMC_ASSERT(i2c_master_one_end, !(done_o && fail_o))
`endif

endmodule

`default_nettype wire
