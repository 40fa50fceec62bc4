// SPDX-License-Identifier: Apache-2.0
// eeprom_24c32: model of a serial EEPROM of the 24C32 class: 4096 bytes, pages of 32 bytes, write time,
//         acknowledge polling.
// Rules:  the same device as openppmc/model/carrier/eeprom.py; a test compares both.
// Timing: both lines are sampled at every rising edge of clk_i. The outputs change at the same edge.
// Usage:  a test accesses `memory` by its name, sets the options that are declared below `memory`, and reads
//         the log of page writes. Without power (on_i = 0), the device drives no line. When the power is
//         removed, the memory becomes blank.
`default_nettype none

module eeprom_24c32 #(
    parameter bit [6:0] Device = 7'h50,
    parameter int unsigned WriteCycles = 80_000,  // duration of a write in cycles
    parameter int unsigned StretchCycles = 0,  // cycles for which SCL is held low after each acknowledge
    parameter bit Missing = 1'b0  // 1: the device does not respond
) (
    input  wire logic clk_i,
    input  wire logic on_i,      // 1: power is on
    input  wire logic scl_i,     // level of the clock line, regardless of the driver
    input  wire logic sda_i,     // level of the data line, regardless of the driver
    output logic      scl_oe_o,  // 1: the device pulls the clock line low
    output logic      sda_oe_o   // 1: the device pulls the data line low
);

  localparam int unsigned Log = 256;

  typedef enum logic [2:0] {
    StIdle,
    StDevice,
    StHigh,
    StLow,
    StData,
    StSend,    // acknowledges a device byte that has the read bit
    StRead
  } state_e;

  logic [7:0] memory[4096]  /* verilator public_flat_rw */;

  // Options of this model. The first four begin with the values of the parameters.
  logic [6:0] device  /* verilator public_flat_rw */ = Device;
  int unsigned write_cycles  /* verilator public_flat_rw */ = WriteCycles;
  int unsigned stretch_cycles  /* verilator public_flat_rw */ = StretchCycles;
  logic missing  /* verilator public_flat_rw */ = Missing;
  logic stuck_scl  /* verilator public_flat_rw */ = 1'b0;  // 1: the clock line is held low
  logic stuck_sda  /* verilator public_flat_rw */ = 1'b0;  // 1: the data line is held low
  int unsigned writing  /* verilator public_flat_rw */ = 0;  // remaining cycles of a write

  // Page writes since power-on: first address, number of bytes, and the bytes (32 elements of log_data for
  // each write).
  int unsigned writes  /* verilator public_flat_rw */ = 0;
  logic [11:0] log_address[Log]  /* verilator public_flat_rw */;
  logic [5:0] log_count[Log]  /* verilator public_flat_rw */;
  logic [7:0] log_data[32*Log]  /* verilator public_flat_rw */;

  logic [7:0] page[32];
  logic [31:0] filled;  // [n]: byte n of the page was received
  state_e state;
  logic scl_was, sda_was;
  logic [3:0] bits;
  logic [7:0] shift, sent;
  logic [11:0] address;
  int unsigned count;  // number of bytes received in this write
  int unsigned holding;
  logic scl_pull, sda_pull, was_on;

  initial power_off();

  function automatic void power_off();
    foreach (memory[i]) memory[i] = 8'hFF;
    {scl_was, sda_was} = 2'b11;
    scl_pull = 1'b0;
    sent = '0;
    address = '0;
    writing = 0;
    writes = 0;
    holding = 0;
    was_on = 1'b0;
    rest();
  endfunction

  function automatic void rest();
    state = StIdle;
    bits = '0;
    shift = '0;
    sda_pull = 1'b0;
    count = 0;
    filled = '0;
  endfunction

  // STOP: a write begins only if all received bytes are complete. The rise of SCL before STOP has been
  // counted as a bit.
  function automatic void stop();
    if (state == StData && count != 0 && bits <= 4'd1) begin
      for (int i = 0; i < 32; i++) if (filled[i]) memory[{address[11:5], 5'(i)}] = page[i];
      log_address[writes] = address;
      log_count[writes]   = count > 32 ? 6'd32 : 6'(count);
      for (int i = 0; i < 32; i++) log_data[32*writes+i] = page[5'(32'(address[4:0])+i)];
      if (writes != Log - 1) writes++;
      address = {address[11:5], 5'(32'(address[4:0]) + count)};
      writing = write_cycles;
    end
    rest();
  endfunction

  // Processes a byte after its eighth bit. Drives the acknowledge until the next falling edge of SCL.
  function automatic void take();
    unique case (state)
      StDevice: begin
        if (shift[7:1] != device || writing != 0) begin
          rest();
          return;
        end
        state = shift[0] ? StSend : StHigh;
      end
      StHigh: begin
        address = {shift[3:0], 8'h00};
        state   = StLow;
      end
      StLow: begin
        address = address | 12'(shift);
        state   = StData;
      end
      StData: begin
        page[5'(32'(address[4:0])+count)]   = shift;
        filled[5'(32'(address[4:0])+count)] = 1'b1;
        count++;
      end
      default: begin
        sda_pull = 1'b0;
        return;
      end
    endcase
    sda_pull = 1'b1;
  endfunction

  function automatic void fall();
    if (bits == 4'd8) take();
    else if (bits == 4'd9) begin
      bits = '0;
      sda_pull = 1'b0;
      if (state == StSend) state = StRead;
      if (stretch_cycles != 0) begin
        scl_pull = 1'b1;
        holding  = stretch_cycles;
      end
    end
    if (state == StRead && bits < 4'd8) begin
      if (bits == '0) begin
        sent = memory[address];
        address++;
      end
      sda_pull = !sent[3'(7-32'(bits))];
    end
  endfunction

  // Blocking assignments, because the statements of a cycle depend on their order. No other block reads the
  // internal state.
  /* verilator lint_off BLKSEQ */
  always @(posedge clk_i) begin
    if (was_on && !on_i) power_off();
    was_on = on_i;
    if (on_i) step();
    scl_oe_o <= on_i && (scl_pull || stuck_scl);
    sda_oe_o <= on_i && (sda_pull || stuck_sda);
  end
  /* verilator lint_on BLKSEQ */

  // Executes one cycle.
  function automatic void step();
    if (holding != 0) begin
      holding--;
      if (holding == 0) scl_pull = 1'b0;
    end
    if (!missing) begin
      if (scl_was && scl_i && sda_was != sda_i) begin
        if (sda_i) stop();
        else begin
          rest();
          state = StDevice;
        end
      end else if (scl_i && !scl_was && state != StIdle) begin
        bits++;
        if (bits <= 4'd8) shift = {shift[6:0], sda_i};
        else if (state == StRead && sda_i) rest();
      end else if (scl_was && !scl_i && state != StIdle) fall();
    end
    if (writing != 0) writing--;
    scl_was = scl_i;
    sda_was = sda_i;
  endfunction

endmodule

`default_nettype wire
