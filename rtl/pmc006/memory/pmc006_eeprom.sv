// SPDX-License-Identifier: Apache-2.0
// pmc006_eeprom: executes boot, save, burn and factory restore over the EEPROM bus; loads the registers.
// Rules:  P006-EEP-01/10/11/20..23, P006-CMD-02/41, P006-BAD-12..15/22/24.
// Timing: the bus uses ticks with the frequency 4 * I2C_HZ, see ppmc_i2c_master. A byte to be written is
//         sampled at the tick at which its first bit begins. During the boot, the parameter page is first
//         checked, then loaded into the registers; each pass takes eight cycles per byte. If the page is
//         invalid, its copy is read and used instead. A save or restore writes the copy first, or the page if
//         page_first_q is 1: the page may be invalid, and the copy is valid. first_q: first write of a job.
`include "ppmc_assert.svh"
`default_nettype none

module pmc006_eeprom
  import pmc006_pkg::*;
  import ppmc_i2c_pkg::*;
#(
    parameter int unsigned       ClkHz  = 16_000_000,
    parameter int unsigned       I2cHz  = 400_000,
    parameter logic        [6:0] Device = 7'h50
) (
    input  wire logic                    clk_i,
    input  wire logic                    rst_ni,
    input  wire logic                    fset_ni,          // pin FSET, synchronised; low: factory settings
    input  wire logic                    restore_i,        // strobe: fset_ni was low for the filter time
    // requests
    input  wire logic                    save_i,           // strobe: write the parameters
    input  wire logic                    burn_i,           // strobe: write the program
    output logic                         idle_o,           // 1: save_i or burn_i is accepted in this cycle
    output logic                         failed_o,         // 1: last operation failed; valid with idle_o
    output logic                         burning_o,        // 1: the program is being written
    output logic                         boot_o,           // 1: boot in progress
    output logic                         autostart_o,      // strobe: start the user program
    output logic                         rst_settings_no,  // low: reset the registers (restore at boot)
    // registers
    input  wire motor_settings_t         settings_i,       // parameter registers
    input  wire control_settings_t       control_i,        // settings used only by the control
    output logic                         load_o,           // strobe: check or execute load_op_o
    output logic                   [7:0] load_op_o,        // instruction that loads a parameter
    output logic                         load_wide_o,      // data of load_op_o, 1: two bytes, 0: one byte
    output logic                         store_o,          // 1: execute load_op_o, 0: check its data
    input  wire logic                    legal_i,          // 1: the data of load_op_o are accepted
    // buffer
    input  wire logic                    claim_i,          // 1: the executor addresses the buffer
    output logic                   [9:0] byte_addr_o,      // address of the byte
    output logic                         we_o,             // strobe: write byte_o to the buffer
    output logic                   [7:0] byte_o,           // byte from the EEPROM
    input  wire logic              [7:0] byte_i,           // byte of the buffer at byte_addr_o
    // bus, synchronised
    input  wire logic                    scl_i,            // SCL
    input  wire logic                    sda_i,            // SDA
    output logic                         scl_oe_o,         // 1: drive SCL low
    output logic                         sda_oe_o          // 1: drive SDA low
);

  localparam int unsigned PollTicks = 4 * I2cHz / 100;
  localparam logic [9:0] ProgramAddr = 10'h020;
  localparam logic [9:0] MarkAddr = 10'h342;
  localparam logic [4:0] FirstFieldAddr = 5'h03;
  localparam logic [4:0] LastFieldAddr = 5'h15;

  typedef enum logic [3:0] {
    StReset,   // waits until FSET is high or a restore is requested
    StFree,
    StStart,
    StDevice,
    StHigh,    // high byte of the address
    StLow,
    StAgain,   // repeated START before a read
    StSource,  // device address of the read
    StData,
    StStop,
    StWipe,    // clears the program if it is invalid
    StLoad,    // loads the registers from the page
    StSettle,
    StIdle
  } state_e;

  (* fsm_encoding = "none" *)
  state_e state_q;
  logic tick, first, done, fail, nack;
  logic boot_q, restore_q, poll_q, read_q, burn_q, first_q, copy_q, factory_q, fail_q, retry_q;
  logic page_first_q, last_q, store_q, page_bad_q, program_bad_q, last, poll_timeout;
  logic byte_sent, byte_received, mismatch, clear_sum, abort, try_copy;
  logic [1:0] prefetch_valid_q;
  logic [2:0] phase_q;
  logic [9:0] addr_q;
  logic [7:0] received, data, prefetch_q, out;
  i2c_cmd_e cmd;

  // ---- bus ------------------------------------------------------------------------------------------------

  always_comb begin
    cmd = CmdByte;
    out = 8'hff;
    unique case (state_q)
      StFree:           cmd = CmdFree;
      StStart, StAgain: cmd = CmdStart;
      StStop:           cmd = CmdStop;
      StDevice:         out = {Device, 1'b0};
      StHigh:           out = {6'd0, addr_q[9:8] | {2{copy_q}}};
      StLow:            out = addr_q[7:0] | {1'b0, {2{copy_q}}, 5'd0};
      StSource:         out = {Device, 1'b1};
      StData:           if (!read_q) out = data;
      default:          cmd = CmdNone;
    endcase
  end

  ppmc_i2c_master #(
      .ClkHz(ClkHz),
      .SclHz(I2cHz)
  ) u_master (
      .clk_i,
      .rst_ni,
      .tick_o (tick),
      .cmd_i  (cmd),
      .byte_i (out),
      .ack_i  (!(state_q == StData && read_q && !last)),
      .first_o(first),
      .done_o (done),
      .fail_o (fail),
      .byte_o (received),
      .nack_o (nack),
      .scl_i,
      .sda_i,
      .scl_oe_o,
      .sda_oe_o
  );

  // ---- bytes ----------------------------------------------------------------------------------------------

  assign byte_sent = first && state_q == StData && !read_q;
  assign byte_received = done && state_q == StData && read_q;
  assign last = addr_q == MarkAddr || (addr_q[4:0] == '1 && !(read_q && addr_q[9:5] != '0));

  pmc006_page u_page (
      .clk_i,
      .rst_ni,
      .addr_i         (addr_q),
      .byte_sent_i    (byte_sent),
      .byte_received_i(byte_received),
      .received_i     (received),
      .clear_i        (clear_sum),
      .burn_i         (burn_q),
      .mark_i         (first_q),
      .prefetch_i     (prefetch_q),
      .factory_i      (factory_q),
      .settings_i,
      .control_i,
      .byte_o         (data),
      .mismatch_o     (mismatch),
      .op_o           (load_op_o),
      .wide_o         (load_wide_o)
  );

  assign clear_sum = state_q == StSettle || state_q == StIdle ||
      (done && state_q == StStop && !retry_q && (read_q || (poll_q && first_q)));

  assign byte_addr_o = addr_q;
  assign we_o = byte_received || (state_q == StWipe && program_bad_q);
  assign byte_o = (state_q == StWipe) ? 8'd0 : received;

  // The executor has priority in accessing the buffer. The time between two bytes is long enough for both
  // accesses, so prefetch_q is valid before it is sent.
  always_ff @(posedge clk_i) begin
    prefetch_valid_q <= {prefetch_valid_q[0], !claim_i};
    if (prefetch_valid_q[1]) prefetch_q <= byte_i;
    if (first) last_q <= last;
  end

  // ---- factory restore ------------------------------------------------------------------------------------

  // A restore at boot holds the parameter registers at the factory values until the end of the boot.
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) rst_settings_no <= 1'b0;
    else rst_settings_no <= !(boot_q && ((restore_i && state_q != StSettle) || restore_q || factory_q));
  end

  // ---- sequence -------------------------------------------------------------------------------------------

  // If the page is invalid during the boot, its copy is read once.
  assign try_copy = boot_q && page_bad_q && !copy_q && !restore_q && !factory_q;
  assign idle_o = state_q == StIdle && !restore_q;
  assign failed_o = fail_q;
  assign burning_o = burn_q;
  assign boot_o = boot_q;
  assign load_o = state_q == StLoad && phase_q == 3'd3;
  assign store_o = store_q;
  assign abort = fail || (done && state_q == StStop && (fail_q || (retry_q && poll_timeout)));
  assign autostart_o = state_q == StSettle && !restore_q && boot_q && control_i.offline && !program_bad_q;

  ppmc_delay #(
      .Ticks(PollTicks)
  ) u_poll (
      .clk_i,
      .restart_i(!poll_q),
      .tick_i   (tick),
      .past_o   (poll_timeout)
  );

  always_ff @(posedge clk_i) phase_q <= (state_q == StLoad) ? phase_q + 1'b1 : 3'd0;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      state_q       <= StReset;
      boot_q        <= 1'b1;
      restore_q     <= 1'b0;
      poll_q        <= 1'b0;
      read_q        <= 1'b0;
      burn_q        <= 1'b0;
      first_q       <= 1'b0;
      copy_q        <= 1'b0;
      page_first_q  <= 1'b0;
      factory_q     <= 1'b0;
      fail_q        <= 1'b0;
      retry_q       <= 1'b0;
      store_q       <= 1'b0;
      page_bad_q    <= 1'b0;
      program_bad_q <= 1'b0;
      addr_q        <= '0;
    end else begin
      if (byte_received || byte_sent || state_q == StWipe) addr_q <= addr_q + 1'b1;
      if (mismatch && addr_q[9:5] != '0) program_bad_q <= 1'b1;
      if (mismatch && addr_q[9:5] == '0) page_bad_q <= 1'b1;

      unique case (state_q)
        StReset:
        if (tick && (fset_ni || restore_q)) begin
          state_q <= sda_i ? StStart : StFree;
          poll_q  <= sda_i;
        end
        StFree:  if (done) state_q <= StStop;
        StStart: if (done) state_q <= StDevice;
        StDevice, StHigh, StLow, StSource:
        if (done) begin
          unique case (state_q)
            StDevice: state_q <= poll_q ? StStop : StHigh;
            StHigh:   state_q <= StLow;
            StLow:    state_q <= read_q ? StAgain : StData;
            default:  state_q <= StData;
          endcase
          if (nack) begin
            state_q <= StStop;
            retry_q <= poll_q;
            fail_q  <= !poll_q;
          end
        end
        StAgain: if (done) state_q <= StSource;
        StData:
        if (done) begin
          if (last_q) state_q <= StStop;
          if (!read_q && nack) begin
            state_q <= StStop;
            fail_q  <= 1'b1;
          end
        end
        StStop:
        if (done) begin
          state_q <= StStart;
          retry_q <= 1'b0;
          if (!retry_q) begin
            poll_q <= !poll_q && !read_q;
            if (poll_q) begin
              if (!burn_q) page_first_q <= first_q && copy_q;
              if (boot_q && !factory_q) read_q <= 1'b1;
              else if (first_q) begin
                first_q <= 1'b0;
                copy_q  <= !burn_q && !copy_q;
                addr_q  <= burn_q ? ProgramAddr : '0;
              end else if (!burn_q || addr_q > MarkAddr) state_q <= StSettle;
            end
            if (read_q && (addr_q > MarkAddr || copy_q)) begin
              state_q <= StWipe;
              read_q  <= 1'b0;
              addr_q  <= ProgramAddr;
            end
          end
        end
        StWipe: begin
          if (!program_bad_q || addr_q == 10'h33f) begin
            state_q <= (page_bad_q || restore_q) ? StSettle : StLoad;
            addr_q  <= 10'(FirstFieldAddr);
          end
        end
        StLoad: begin
          if (phase_q == 3'd5 && load_op_o != I_NONE && !legal_i) page_bad_q <= 1'b1;
          if (phase_q == 3'd7) begin
            addr_q <= addr_q + 1'b1;
            if (addr_q[4:0] == LastFieldAddr) begin
              addr_q  <= 10'(FirstFieldAddr);
              store_q <= 1'b1;
              if (store_q || page_bad_q || restore_q) state_q <= StSettle;
            end
          end
        end
        default: begin  // StSettle, StIdle
          state_q   <= StIdle;
          boot_q    <= 1'b0;
          burn_q    <= 1'b0;
          factory_q <= 1'b0;
          addr_q    <= '0;
          retry_q   <= 1'b0;
          poll_q    <= 1'b0;
          first_q   <= 1'b0;
          copy_q    <= 1'b0;
          store_q   <= 1'b0;
          if (boot_q && !factory_q) fail_q <= 1'b0;
          if (boot_q && !factory_q) page_first_q <= copy_q && !page_bad_q && !restore_q;
          if (try_copy) begin
            state_q    <= StStart;
            boot_q     <= 1'b1;
            read_q     <= 1'b1;
            copy_q     <= 1'b1;
            page_bad_q <= 1'b0;
          end else if (restore_q || (state_q == StIdle && (save_i || burn_i))) begin
            state_q   <= StStart;
            boot_q    <= boot_q;
            restore_q <= 1'b0;
            factory_q <= restore_q;
            burn_q    <= burn_i && !restore_q;
            first_q   <= 1'b1;
            copy_q    <= (!burn_i || restore_q) && !page_first_q;
            fail_q    <= 1'b0;
            if (burn_i && !restore_q) addr_q <= MarkAddr;
          end
        end
      endcase

      if (abort) begin
        state_q <= StSettle;
        fail_q  <= 1'b1;
        if (boot_q && !factory_q) begin
          state_q       <= StWipe;
          addr_q        <= ProgramAddr;
          page_bad_q    <= 1'b1;
          program_bad_q <= 1'b1;
          read_q        <= 1'b0;
          copy_q        <= 1'b1;
        end
      end
      if (restore_i) restore_q <= 1'b1;
    end
  end

`ifndef SYNTHESIS
  `PPMC_ASSERT(p006_eep_22, !(save_i && burn_i))
  `PPMC_ASSERT(p006_bad_12, idle_o || !(save_i || burn_i))
`endif

endmodule

`default_nettype wire
