// SPDX-License-Identifier: Apache-2.0
// pmc006_eeprom_fv: compares the bus commands of pmc006_eeprom with a model of the EEPROM that survives
// resets of the part. Resets can occur in every cycle.
`include "ppmc_fv.svh"
`include "common/ppmc_lemma.svh"
`default_nettype none

module pmc006_eeprom_fv
  import pmc006_pkg::*;
  import ppmc_i2c_pkg::*;
(
    input wire logic                    clk_i,
    input wire logic                    power_i,
    input wire logic                    fset_ni,
    input wire logic                    restore_i,
    input wire logic                    save_i,
    input wire logic                    burn_i,
    input wire motor_settings_t         settings_i,
    input wire control_settings_t       control_i,
    input wire logic                    legal_i,
    input wire logic                    claim_i,
    input wire logic              [7:0] byte_i,
    input wire logic                    scl_i,
    input wire logic                    sda_i,
    input wire logic              [2:0] content_i    // EEPROM at the first power-up
);

  localparam logic [4:0] PageBlock = 5'd0, TrailerBlock = 5'd26, CopyBlock = 5'd27;  // units of 32 bytes
  localparam logic [9:0] SumAddr = 10'h340, MarkAddr = 10'h342, EndAddr = 10'h343;

  logic idle_o, failed_o, burning_o, boot_o, autostart_o, rst_settings_no, load_o, load_wide_o, store_o, we_o;
  logic scl_oe_o, sda_oe_o;
  logic [7:0] load_op_o, byte_o;
  logic [9:0] byte_addr_o;

  `FV_RESET

  `FV_ANY_START(power_i)

  logic booted_q;  // the run began with a reset
  always_ff @(posedge clk_i) booted_q <= rst_ni && (later_q ? booted_q : !rst_dut_n);

  pmc006_eeprom #(
      .ClkHz(2_000),
      .I2cHz(100)
  ) dut (
      .rst_ni(rst_dut_n),
      .*
  );

  // states of the block
  typedef enum logic [3:0] {
    StReset,
    StFree,
    StStart,
    StDevice,
    StHigh,
    StLow,
    StAgain,
    StSource,
    StData,
    StStop,
    StWipe,
    StLoad,
    StSettle,
    StIdle
  } state_e;
  state_e state;
  assign state = state_e'(dut.state_q);

  // 32 bytes of the settings, except the sum, which is 0 here
  function automatic logic [31:0][7:0] image(motor_settings_t set, control_settings_t ctl);
    return {
      80'd0,
      16'(set.cur),
      16'(set.scomp),
      16'(set.ccomp),
      16'(set.vstop),
      16'(set.vstart),
      8'(ctl.offline),
      8'(ctl.trigm),
      8'(set.att),
      8'(set.autodec),
      8'(set.dec),
      8'(set.acc),
      8'd0,
      set.mstep,
      ctl.addr,
      24'h013650
    };
  endfunction

  // ---- EEPROM ---------------------------------------------------------------------------------------

  // A block is valid after a complete write that was acknowledged by polling, until the first byte of the
  // next write to it. Otherwise it may be valid: the next boot decides.
  logic page_ok_q, copy_ok_q, mark_clear_q;  // mark_clear_q: the mark is 0
  logic listen_q, reads_q, begun_q, written_q;  // written_q: complete write, not yet acknowledged
  logic [1:0] place_q;  // bytes since START: 0: device, 1, 2: address, 3: data
  logic [7:0] sent_q, data;
  logic [9:0] addr_q;
  logic [4:0] block_q, pages_q;  // block of the last write; program pages written since the mark is 0
  logic [15:0] sum_q, sum;
  logic [31:0][7:0] content;
  logic [7:0] high_q;
  logic write_byte, read_byte, stop, acknowledged, whole, head_ok, any_ok, both_ok;
  logic program_ok_q, read_ok_q, copy_read_q, legal_q, checked, source_ok, mark_zero_q;
  logic save_q, burn_q, restore_q, blind_q, had_ok_q;

  assign write_byte = dut.first && listen_q && place_q == 2'd3 && !reads_q;
  assign read_byte = dut.done && dut.cmd == CmdByte && listen_q && place_q == 2'd3 && reads_q;
  assign stop = dut.done && dut.cmd == CmdStop;
  assign acknowledged = stop && listen_q && place_q == 2'd1 && written_q;
  assign whole = addr_q[4:0] == '0 || addr_q == EndAddr;
  assign data = read_byte ? dut.received : dut.out;
  assign sum = (addr_q inside {10'h000, 10'h020, 10'h360}) ? '0 : sum_q;
  assign any_ok = page_ok_q || copy_ok_q;
  assign both_ok = page_ok_q && copy_ok_q;

  always_ff @(posedge clk_i) begin
    if (dut.first) {sent_q, high_q} <= {dut.out, content[addr_q[4:0]|5'd1]};
    if (write_byte || read_byte) begin
      addr_q <= addr_q + 1'b1;
      if (addr_q[9:5] != TrailerBlock) sum_q <= sum + 16'(data);
    end
    if (write_byte) block_q <= addr_q[9:5];
    if (dut.done && dut.cmd == CmdStart) {place_q, reads_q} <= '0;
    if (dut.done && dut.cmd == CmdByte) begin
      if (place_q == 2'd0) reads_q <= sent_q[0];
      if (place_q == 2'd1) addr_q[9:8] <= sent_q[1:0];
      if (place_q == 2'd2) addr_q[7:0] <= sent_q;
      if (place_q != 2'd3) place_q <= (place_q == 2'd0 && sent_q[0]) ? 2'd3 : place_q + 1'b1;
    end
  end

  always_ff @(posedge clk_i or negedge rst_dut_n)
    if (!rst_dut_n) {listen_q, begun_q, written_q} <= '0;
    else if (dut.fail) {listen_q, begun_q, written_q} <= '0;
    else begin
      if (write_byte) {begun_q, written_q} <= 2'b10;
      if (dut.done && dut.cmd == CmdStart) {listen_q, begun_q} <= 2'b10;
      if (dut.done && dut.cmd == CmdByte && dut.nack && !read_byte) listen_q <= 1'b0;
      if (stop) begin
        {listen_q, begun_q} <= '0;
        if (listen_q) written_q <= begun_q && whole;
      end
    end

  always_ff @(posedge clk_i) begin
    if (!rst_ni) {page_ok_q, copy_ok_q, mark_clear_q} <= content_i;
    else begin
      if (acknowledged && block_q == PageBlock) page_ok_q <= 1'b1;
      if (acknowledged && block_q == CopyBlock) copy_ok_q <= 1'b1;
      if (checked) begin
        if (copy_read_q) copy_ok_q <= 1'b1;
        else page_ok_q <= 1'b1;
      end
      if (acknowledged && block_q == TrailerBlock && mark_zero_q) mark_clear_q <= 1'b1;
      if (write_byte && addr_q[9:5] == PageBlock) page_ok_q <= 1'b0;
      if (write_byte && addr_q[9:5] == CopyBlock) copy_ok_q <= 1'b0;
      if (write_byte && addr_q == MarkAddr) mark_clear_q <= 1'b0;
    end
    if (write_byte && addr_q == MarkAddr) mark_zero_q <= dut.out == 8'h00;
    if (acknowledged && block_q == TrailerBlock) pages_q <= '0;
    else if (acknowledged && block_q == pages_q + 1'b1) pages_q <= pages_q + 1'b1;
  end

  // ---- boot -----------------------------------------------------------------------------------------

  // A block is accepted if head and sum are right and all its values are legal. A valid block is accepted.
  // verilog_format: off
  assign head_ok = (addr_q[4:0] > 5'd2 || data == content[addr_q[1:0]]) && (addr_q[4:0] != '1
      || data == sum[7:0]);
  // verilog_format: on
  assign checked = state == StLoad && !store_o && dut.phase_q == '1 &&
      dut.addr_q[4:0] == 5'h15 && read_ok_q && legal_q;
  assign source_ok = copy_read_q ? copy_ok_q : page_ok_q;

  always_ff @(posedge clk_i) begin
    if (read_byte && addr_q[9:5] inside {PageBlock, CopyBlock}) begin
      copy_read_q <= addr_q[9:5] == CopyBlock;
      read_ok_q   <= (addr_q[4:0] == '0 || read_ok_q) && head_ok;
    end
    if (read_byte && addr_q[9:5] inside {[5'd1 : TrailerBlock]})
      program_ok_q <= addr_q == 10'h020 || (program_ok_q &&
        (addr_q < SumAddr || data == ((addr_q == MarkAddr) ? 8'h5a : addr_q[0] ? sum_q[15:8] : sum_q[7:0])));
    legal_q <= state != StLoad || (legal_q && !(dut.phase_q == 3'd5 && load_op_o != I_NONE && !legal_i));
  end

  // verilog_format: off
  `FV_ASSUME(
      valid_block_is_read,
      !read_byte || head_ok || !((page_ok_q && addr_q[9:5] == PageBlock) || (copy_ok_q
          && addr_q[9:5] == CopyBlock)))
  // verilog_format: on
  `FV_ASSUME(valid_block_is_legal, state != StLoad || !source_ok || legal_i)
  `FV_ASSUME(registers_in_reset, rst_settings_no || control_i == CONTROL_RESET)
  `FV_ASSUME(no_job_while_busy, idle_o || !(save_i || burn_i))
  `FV_ASSUME(one_job, !(save_i && burn_i))

  // ---- jobs -----------------------------------------------------------------------------------------

  // blind_q: the boot could not check page and copy, because of a fault of the bus or a restore
  logic [ 4:0] writes_q;  // writes of this job
  logic [10:0] rest_q;  // cycles without a command
  logic [ 2:0] late_q;  // commands since the time-out of a poll

  assign content = save_q ? image(settings_i, control_i) : image(SETTINGS_RESET, CONTROL_RESET);

  always_ff @(posedge clk_i or negedge rst_dut_n)
    if (!rst_dut_n) {save_q, burn_q, restore_q, writes_q, rest_q, late_q} <= '0;
    else begin
      if (state == StSettle) {save_q, burn_q, writes_q} <= '0;
      if (state == StSettle && !dut.restore_q) restore_q <= 1'b0;
      if (restore_i) restore_q <= 1'b1;
      if (save_i) save_q <= 1'b1;
      if (burn_i) burn_q <= 1'b1;
      if (stop && begun_q) writes_q <= writes_q + 1'b1;
      if (dut.cmd != CmdNone || idle_o || state == StReset) rest_q <= '0;
      else rest_q <= rest_q + 1'b1;
      if (!(dut.poll_q && dut.poll_timeout)) late_q <= '0;
      else if (dut.done) late_q <= late_q + 1'b1;
    end

  always_ff @(posedge clk_i) begin
    blind_q  <= rst_dut_n && !both_ok && (blind_q || (boot_o && (dut.abort || restore_i)));
    had_ok_q <= rst_ni && (any_ok || (had_ok_q && !blind_q));
  end

  `FV_LEMMA(p006_eep_10_never_neither, any_ok || !had_ok_q || blind_q)
  // verilog_format: off
  `FV_ASSERT(
      p006_eep_10_bytes,
      !(write_byte && addr_q[9:5] inside {PageBlock, CopyBlock}) || dut.out == ((addr_q[4:0] == '1) ? sum[7:0]
          : (addr_q[0] && addr_q[4:0] >= 5'h0c) ? high_q : content[addr_q[4:0]]))
  // verilog_format: on
  `FV_ASSERT(
      p006_eep_11_pages,
      !(write_byte && addr_q[9:5] inside {[5'd1 : 5'd25]}) || (mark_clear_q && addr_q[9:5] == pages_q + 1'b1))
  // verilog_format: off
  `FV_ASSERT(
      p006_eep_11_mark_last,
      !(write_byte && addr_q == MarkAddr) || dut.out == 8'h00 || (dut.out == 8'h5a && mark_clear_q
          && pages_q == 5'd25 && begun_q))
  // verilog_format: on
  `FV_ASSERT(
      p006_eep_11_sum,
      !(write_byte && addr_q[9:1] == SumAddr[9:1]) || dut.out == (addr_q[0] ? sum_q[15:8] : sum_q[7:0]))
  `FV_ASSERT(p006_eep_11_only_a_burn, !(write_byte && addr_q[9:5] inside {[5'd1 : 5'd26]}) || burn_q)
  `FV_ASSERT(p006_eep_22_blocks,
             !(write_byte && !burn_q) || (addr_q[9:5] inside {PageBlock, CopyBlock} && (save_q || restore_q)))
  `FV_LEMMA(p006_eep_22_one_job, !(save_q && burn_q))
  `FV_ASSERT(p006_bad_15, !autostart_o || (program_ok_q && control_i.offline && !restore_q))
  `FV_ASSERT(p006_bad_14_boot_writes_nothing, !(write_byte && boot_o && !restore_q))
  `FV_ASSERT(p006_eep_10_block_start, !(write_byte && !begun_q) || addr_q[4:0] == '0 || addr_q == MarkAddr)
  `FV_ASSERT(p006_eep_10_within_a_page, !(write_byte && begun_q) || addr_q[4:0] != '0)
  `FV_LEMMA(lemma_burning, burning_o == burn_q)
  `FV_LEMMA(p006_bad_13_writes_of_a_job, writes_q <= (burn_q ? 5'd27 : 5'd2))
  `FV_LEMMA(p006_bad_13_poll_ends, late_q <= 3'd3)
  `FV_LEMMA(p006_bad_13_rest_ends, rest_q <= 11'd1106)
  `FV_ASSERT(command_stable, !$past(rst_dut_n && dut.cmd != CmdNone && !dut.done && !dut.fail)
             || !rst_dut_n || dut.cmd == $past(dut.cmd))

  // ---- lemmas: states of block and EEPROM -----------------------------------------------------------

  logic bus, reading, booting, writing, in_poll, in_write, sure, sum_is_zero;

  assign bus = state inside {[StStart : StStop]};
  assign booting = boot_o && !dut.factory_q;
  assign reading = bus && dut.read_q;
  assign writing = bus && !booting;
  assign in_write = writing && !dut.poll_q;
  assign in_poll = writing && dut.poll_q;
  assign sure = !blind_q && !both_ok;

  // flags of the block
  `FV_LEMMA(lemma_state, state <= StIdle)
  // verilog_format: off
  `FV_LEMMA(
      lemma_reset,
      state != StReset || (booting && dut.addr_q == '0 && !(dut.poll_q || dut.read_q || dut.copy_q
          || dut.page_bad_q || failed_o || dut.u_page.sum_q != '0)))
  `FV_LEMMA(
      lemma_free,
      state != StFree || (booting && dut.addr_q == '0 && !(dut.poll_q || dut.read_q || dut.copy_q
          || dut.page_bad_q || failed_o || dut.u_page.sum_q != '0)))
  `FV_LEMMA(
      lemma_idle,
      state != StIdle || !(save_q || boot_o || burning_o || dut.factory_q || dut.retry_q || dut.poll_q
          || dut.first_q || dut.copy_q || dut.store_q || dut.addr_q != '0))
  // verilog_format: on
  `FV_LEMMA(lemma_load, !(state inside {StWipe, StLoad}) || booting)
  `FV_LEMMA(lemma_read, !dut.read_q || (booting && bus && !dut.poll_q))
  `FV_LEMMA(lemma_booting, !booting || !(burning_o || dut.first_q || written_q || begun_q))
  `FV_LEMMA(lemma_boot_start, !(booting && state inside {StStart, StDevice}) || dut.read_q != dut.poll_q)
  `FV_LEMMA(lemma_boot_read, !(booting && state inside {[StHigh : StData]}) || dut.read_q)
  // verilog_format: off
  `FV_LEMMA(
      lemma_boot_poll,
      !(booting && bus && !dut.read_q) || (dut.addr_q == '0 && dut.u_page.sum_q == '0 && !dut.copy_q
          && !dut.page_bad_q))
  // verilog_format: on
  `FV_LEMMA(lemma_poll_states, !(dut.poll_q && bus) || state inside {StStart, StDevice, StStop})
  `FV_LEMMA(lemma_write_states, !in_write || !(state inside {StAgain, StSource}))
  `FV_LEMMA(lemma_jobs, !writing || save_q + burn_q + dut.factory_q == 2'd1)
  `FV_LEMMA(lemma_factory, !dut.factory_q || writing || state == StSettle)
  `FV_LEMMA(lemma_job_flags, !save_q || !boot_o)
  `FV_LEMMA(
      lemma_restore,
      (booting || restore_q) ? (!booting || restore_q == dut.restore_q) : !(dut.factory_q || dut.restore_q))
  `FV_LEMMA(lemma_burn, !burning_o || !(boot_o || dut.factory_q || dut.copy_q))
  `FV_LEMMA(lemma_retry, !dut.retry_q || (dut.poll_q && !(state inside {[StStart : StData]})))
  // verilog_format: off
  `FV_LEMMA(
      lemma_writes,
      !writing || writes_q == (burn_q ? (dut.first_q ? 5'd0 : pages_q + 1'b1)
          : 5'(!dut.first_q)) + 5'(dut.poll_q))
  // verilog_format: on
  `FV_LEMMA(lemma_no_writes, !(booting || state == StIdle) || writes_q == '0)
  // verilog_format: off
  `FV_LEMMA(
      lemma_late,
      !(bus && dut.poll_q && dut.poll_timeout) || late_q <= ((state == StStart) ? 3'd0 : (state == StDevice)
          ? 3'd1 : 3'd2))
  // verilog_format: on
  `FV_LEMMA(lemma_wipe, state != StWipe || (rest_q == 11'(dut.addr_q) - 11'h020 && dut.addr_q < 10'h340))
  // verilog_format: off
  `FV_LEMMA(
      lemma_loaded,
      state != StLoad || (dut.addr_q inside {[10'h003 : 10'h015]}
          && rest_q <= 11'd800 + 11'd8 * 11'(dut.addr_q - 10'd3) + 11'(dut.phase_q) + 11'd152 * 11'(store_o)))
  // verilog_format: on
  `FV_LEMMA(lemma_settle, state != StSettle || rest_q <= 11'd1104)
  `FV_LEMMA(lemma_idle_rest, state != StIdle || rest_q <= 11'd1105)
  `FV_LEMMA(lemma_factory_values, !(boot_o && dut.factory_q) || !rst_settings_no)
  `FV_LEMMA(lemma_store, !store_o || state inside {StLoad, StSettle})

  // order of page and copy
  `FV_LEMMA(lemma_order, booting || blind_q || !any_ok || (dut.page_first_q ? copy_ok_q : page_ok_q))
  `FV_LEMMA(lemma_page_first, !(writing && !burn_q) || dut.copy_q == !dut.page_first_q)
  `FV_LEMMA(lemma_second, !(writing && !burn_q && !dut.first_q) || (dut.copy_q ? page_ok_q : copy_ok_q))
  `FV_LEMMA(lemma_boot_first, !booting || !dut.page_first_q)
  `FV_LEMMA(lemma_blind, !(booting && dut.restore_q) || !sure)
  `FV_LEMMA(lemma_accept, !(booting && sure) || !(dut.copy_q ? copy_ok_q : page_ok_q) || !dut.page_bad_q)
  `FV_LEMMA(lemma_page_bad, !(booting && sure && dut.copy_q) || !page_ok_q)
  // verilog_format: off
  `FV_LEMMA(
      lemma_program,
      !(booting && (state inside {StWipe, StLoad, StSettle} || (dut.copy_q && bus) || (reading
          && dut.addr_q > 10'h020))) || program_ok_q || dut.program_bad_q)
  // verilog_format: on
  `FV_LEMMA(lemma_not_read, !(reading && dut.addr_q == '0) || !dut.page_bad_q)
  // verilog_format: off
  `FV_LEMMA(
      lemma_read_ok,
      !(booting && sure && (state inside {StWipe, StLoad} || (reading && dut.addr_q != '0))) || dut.page_bad_q
          || (read_ok_q && copy_read_q == dut.copy_q))
  // verilog_format: on
  `FV_LEMMA(lemma_legal, state != StLoad || store_o || dut.page_bad_q == !legal_q)
  // verilog_format: off
  `FV_LEMMA(
      lemma_checked,
      !(booting && sure && (store_o || state == StSettle)) || dut.page_bad_q || (source_ok
          && copy_read_q == dut.copy_q))
  // verilog_format: on

  // bytes
  // verilog_format: off
  assign sum_is_zero = dut.addr_q == '0 || (burn_q && dut.first_q) || (dut.addr_q == 10'h020 && (dut.read_q
      || burn_q));
  // verilog_format: on
  `FV_LEMMA(lemma_sum,
            !(writing || (reading && state != StStop)) || dut.u_page.sum_q == (sum_is_zero ? '0 : sum_q))
  // verilog_format: off
  `FV_LEMMA(
      lemma_high,
      !(state == StData && in_write && !burn_q && dut.addr_q[0] && (dut.addr_q == 10'h005
          || dut.addr_q >= 10'h00c)) || (dut.u_page.high_q == high_q && (dut.addr_q != 10'h005
          || high_q == '0)))
  // verilog_format: on
  `FV_LEMMA(
      lemma_master,
      !(dut.u_master.done_o || dut.u_master.fail_o) || (dut.u_master.begun_q && (bus || state == StFree)))
  `FV_LEMMA(lemma_one_end, !(dut.u_master.done_o && dut.u_master.fail_o))
  `FV_LEMMA(lemma_sent,
            !(dut.u_master.begun_q && state inside {StDevice, StHigh, StLow, StSource}) || sent_q == dut.out)
  `FV_LEMMA(lemma_device,
            !(state inside {StDevice, StSource}) || (listen_q && place_q == 2'd0 && !begun_q && !reads_q))
  `FV_LEMMA(lemma_high_addr, state != StHigh || (listen_q && place_q == 2'd1 && !begun_q && !reads_q))
  // verilog_format: off
  `FV_LEMMA(
      lemma_low_addr,
      state != StLow || (listen_q && place_q == 2'd2 && !begun_q && !reads_q
          && addr_q[9:8] == (dut.addr_q[9:8] | {2{dut.copy_q}})))
  `FV_LEMMA(
      lemma_address,
      !(state inside {StAgain, StSource, StData}) || addr_q == (dut.copy_q ? {CopyBlock, 5'd0}
          : 10'd0) + dut.addr_q)
  // verilog_format: on
  `FV_LEMMA(lemma_data, state != StData || (listen_q && place_q == 2'd3 && reads_q == dut.read_q))
  `FV_LEMMA(lemma_begun,
            !(state == StData && !reads_q && dut.u_master.begun_q) || (begun_q && dut.last_q == whole))
  `FV_LEMMA(lemma_more, !(state == StData && !reads_q && begun_q && !dut.u_master.begun_q) || !whole)
  `FV_LEMMA(lemma_stop,
            !(in_write && state == StStop && !failed_o) || (listen_q && begun_q && whole && place_q == 2'd3))
  `FV_LEMMA(lemma_not_acknowledged, !(bus && failed_o) || !listen_q)
  `FV_LEMMA(lemma_start, !begun_q || state inside {StData, StStop})
  `FV_LEMMA(lemma_failed, !(bus && state != StStop) || !failed_o)
  `FV_LEMMA(lemma_polled,
            !(in_poll && state == StStop) || (dut.retry_q ? !listen_q : (listen_q && place_q == 2'd1)))
  `FV_LEMMA(lemma_poll, !in_poll || (written_q && !failed_o && !begun_q))

  // addresses
  // verilog_format: off
  `FV_LEMMA(
      lemma_block,
      !(in_poll || (in_write && begun_q)) || block_q == (burn_q ? (dut.first_q ? TrailerBlock
          : pages_q + 1'b1) : dut.copy_q ? CopyBlock : PageBlock))
  // verilog_format: on
  `FV_LEMMA(lemma_copy_addr, !(bus && !burn_q && (dut.copy_q || writing)) || dut.addr_q <= 10'd32)
  // verilog_format: off
  `FV_LEMMA(
      lemma_fresh,
      !(in_write && !begun_q && state != StStop) || dut.addr_q == (!burn_q ? 10'd0 : dut.first_q ? MarkAddr
          : {pages_q + 1'b1, 5'd0}))
  `FV_LEMMA(
      lemma_next_page,
      !((in_poll || (in_write && begun_q && whole)) && burn_q && !dut.first_q)
          || dut.addr_q == (pages_q == 5'd25 ? EndAddr : {pages_q + 5'd2, 5'd0}))
  `FV_LEMMA(
      lemma_same_page,
      !(state == StData && in_write && burn_q && !(begun_q && whole)) || (dut.first_q ? dut.addr_q == MarkAddr
          : dut.addr_q[9:5] == pages_q + 1'b1 && dut.addr_q <= MarkAddr))
  // verilog_format: on
  `FV_LEMMA(lemma_first_mark,
            !((in_poll || (in_write && begun_q)) && burn_q && dut.first_q) || dut.addr_q == EndAddr)
  `FV_LEMMA(lemma_pages, !(writing && burn_q && !dut.first_q) || pages_q <= 5'd25)
  `FV_LEMMA(lemma_mark, !(writing && burn_q && !dut.first_q) || mark_clear_q || dut.addr_q == EndAddr)
  `FV_LEMMA(
      lemma_mark_zero,
      !(writing && burn_q && (begun_q || dut.poll_q) && dut.addr_q == EndAddr) || mark_zero_q == dut.first_q)
  // verilog_format: off
  `FV_LEMMA(
      lemma_read_start,
      !(reading && state inside {[StStart : StSource]}) || dut.addr_q == '0 || (dut.addr_q == 10'h020
          && !dut.copy_q))
  `FV_LEMMA(
      lemma_read_last,
      !(reading && state == StData && dut.u_master.begun_q)
          || dut.last_q == (dut.addr_q inside {10'h01f, MarkAddr}))
  // verilog_format: on
  `FV_LEMMA(lemma_read_addr, !(reading && state == StData) || dut.addr_q <= MarkAddr)
  `FV_LEMMA(lemma_read_stop,
            !(reading && state == StStop && !failed_o) || dut.addr_q inside {10'h020, EndAddr})
  `FV_LEMMA(lemma_copy_end, !(reading && dut.copy_q && state == StData) || dut.addr_q <= 10'h01f)

  `FV_COVER(seen_boot, booted_q && $past(rst_dut_n) && read_byte && head_ok && addr_q == 10'h001)
  `FV_COVER(seen_checked, checked && copy_read_q && rst_dut_n && page_ok_q != copy_ok_q)
  `FV_COVER(seen_save, save_q && acknowledged && block_q == PageBlock && $past(rst_dut_n))
  `FV_COVER(seen_burn, acknowledged && block_q == TrailerBlock && !mark_zero_q && $past(rst_dut_n))

endmodule

`default_nettype wire
