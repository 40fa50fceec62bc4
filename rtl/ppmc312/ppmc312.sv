// SPDX-License-Identifier: Apache-2.0
// ppmc312: intelligent stepper controller for one axis; replaces the PPMC-312.
// Rules:  P312-GEN-01, P312-PRT-01..03, P312-CMD-FF; the instantiated blocks implement all other rules.
// Timing: an input acts two cycles after its pin changes; with TIMING = "DATASHEET", the filter time is
//         added. Two cycles (DATASHEET: 1.6 ms) after the release of the reset, out_oe is asserted and the
//         core leaves reset.
// Note:   mode = 1 selects the parallel bus, mode = 0 a station on a serial line. The core uses the level
//         of mode at the end of the last reset. The front end that is not selected is idle.
`default_nettype none

module ppmc312
  import ppmc312_pkg::*;
  import ppmc312_link_pkg::*;
  import ppmc312_serial_pkg::*;
#(
    parameter int unsigned CLK_HZ   = 16_000_000,  // clock frequency in Hz, 8e6 .. 200e6, >= XTAL_HZ / 2
    parameter int unsigned XTAL_HZ  = 16_000_000,  // crystal of the old chip in Hz, 1e6 .. 16e6
    parameter              TIMING   = "FAST",      // or "DATASHEET": processing times of the old chip
    parameter int unsigned VERSION  = 'h12,        // value that the version instruction returns, 0 .. 255
    parameter              SUM_MODE = "BINARY",    // checksum of the serial mode; or "CHARS"
    parameter int unsigned SND_LEAD = 1,           // bits from the rise of snd to the start bit, 1 .. 16
    parameter int unsigned SND_WAIT = 0            // snd rises SND_WAIT + 0.5 bits after a stop bit, 0 .. 8
) (
    input  wire logic       clk,
    input  wire logic       rst_n,
    // host, parallel
    input  wire logic       mode,     // 1: parallel, 0: serial; sampled at the end of a reset
    input  wire logic [7:0] d_i,
    output logic      [7:0] d_o,
    output logic            d_oe,
    input  wire logic [2:0] rs,
    input  wire logic       cs_n,
    input  wire logic       we_n,
    input  wire logic       oe_n,
    output logic            wrq_n,
    output logic            irq_n,
    // host, serial
    input  wire logic       rxd,
    output logic            txd,
    output logic            snd,
    input  wire logic       hsp,
    input  wire logic [2:0] mod,
    input  wire logic [3:0] adr,
    // events, generalized input and output
    input  wire logic       evt0_n,
    input  wire logic       evt1_n,
    input  wire logic [7:0] auxi,
    output logic      [5:0] auxo_n,
    // driver
    output logic            exon_n,
    output logic            cclr_n,
    output logic            aclr_n,
    output logic            zclmp_n,
    output logic            cd_n,
    input  wire logic       alm_n,
    input  wire logic       end_n,
    // encoder, switches
    input  wire logic       epin,
    input  wire logic       epdir,
    input  wire logic       index_n,
    input  wire logic       org_n,
    input  wire logic       fl_n,
    input  wire logic       bl_n,
    input  wire logic       fhl_n,
    input  wire logic       bhl_n,
    // pulses
    output logic            pout,
    output logic            dir,      // 0: CW, 1: CCW
    input  wire logic       extck,
    input  wire logic       run,
    output logic            intlk_n,
    output logic            out_oe
);

  if (128'(TIMING) != "FAST" && 128'(TIMING) != "DATASHEET") begin : g_check_timing
    $fatal(1, "ppmc312: TIMING must be FAST or DATASHEET");
  end
  if (128'(SUM_MODE) != "BINARY" && 128'(SUM_MODE) != "CHARS") begin : g_check_sum
    $fatal(1, "ppmc312: SUM_MODE must be BINARY or CHARS");
  end
  if (CLK_HZ < 8_000_000 || CLK_HZ > 200_000_000 || CLK_HZ < XTAL_HZ / 2) begin : g_check_clk
    $fatal(1, "ppmc312: CLK_HZ must be 8e6 .. 200e6 and at least XTAL_HZ / 2");
  end
  if (XTAL_HZ < 1_000_000 || XTAL_HZ > 16_000_000) begin : g_check_xtal
    $fatal(1, "ppmc312: XTAL_HZ must be 1e6 .. 16e6");
  end

  if (VERSION > 255) begin : g_check_version
    $fatal(1, "ppmc312: VERSION must be 0 .. 255");
  end
  if (SND_LEAD < 1 || SND_LEAD > 16) begin : g_check_lead
    $fatal(1, "ppmc312: SND_LEAD must be 1 .. 16");
  end
  if (SND_WAIT > 8) begin : g_check_wait
    $fatal(1, "ppmc312: SND_WAIT must be 0 .. 8");
  end

  localparam bit Datasheet = 128'(TIMING) == "DATASHEET";
  // DATASHEET: T_WRQ is 9.5 crystal periods
  localparam int unsigned WaitCycles = Datasheet ? ppmc_pkg::cyc(19, CLK_HZ, 2 * XTAL_HZ) : 6;
  // ---- reset --------------------------------------------------------------------------------------

  logic rst_core_n, rst_host_n, rst_bus_n, boot, reset, serial, talks, open;
  logic [2:0] speed;
  logic [3:0] number;

  ppmc312_reset #(
      .ClkHz    (CLK_HZ),
      .XtalHz   (XTAL_HZ),
      .Datasheet(Datasheet)
  ) u_reset (
      .clk_i      (clk),
      .rst_ni     (rst_n),
      .reset_i    (reset),
      .mode_i     (mode),
      .mod_i      (mod),
      .adr_i      (adr),
      .rst_core_no(rst_core_n),
      .rst_host_no(rst_host_n),
      .rst_bus_no (rst_bus_n),
      .boot_o     (boot),
      .ready_o    (out_oe),
      .open_o     (open),
      .serial_o   (serial),
      .mod_o      (speed),
      .adr_o      (number)
  );

  logic unused_hsp;
  assign unused_hsp = &{1'b0, hsp};

  // ---- inputs -------------------------------------------------------------------------------------

  inputs_t inputs;

  ppmc312_pins #(
      .ClkHz    (CLK_HZ),
      .XtalHz   (XTAL_HZ),
      .Datasheet(Datasheet)
  ) u_pins (
      .clk_i(clk),
      .rst_ni(rst_core_n),
      .pins_i(
      '{
          alm_n: alm_n,
          end_n: end_n,
          index_n: index_n,
          org_n: org_n,
          fhl_n: fhl_n,
          bhl_n: bhl_n,
          fl_n: fl_n,
          bl_n: bl_n
      }
      ),
      .evt_ni({evt1_n, evt0_n}),
      .run_i(run),
      .epin_i(epin),
      .epdir_i(epdir),
      .auxi_i(auxi),
      .inputs_o(inputs)
  );

  // ---- host ---------------------------------------------------------------------------------------

  host_block_t bus_block, line_block, host_block;
  block_write_t block_write;
  host_result_t host_result;
  status_e status;
  poll_result_t poll_result;
  logic blk_done, rd_any, bus_load, line_load, rd_done;
  logic [BLOCK_BITS:0] rd_size;
  logic [BLOCK_BITS-1:0] blk_addr, bus_addr, line_addr;
  logic [7:0] blk_data, rd_data;

  ppmc312_mailbox #(
      .WaitCycles(WaitCycles)
  ) u_mailbox (
      .clk_i        (clk),
      .rst_ni       (rst_host_n),
      .rst_bus_ni   (rst_bus_n),
      .ready_i      (open),
      .off_i        (serial),
      .rs_i         (rs),
      .cs_ni        (cs_n),
      .we_ni        (we_n),
      .oe_ni        (oe_n),
      .d_i,
      .d_o,
      .d_oe_o       (d_oe),
      .wrq_no       (wrq_n),
      .irq_no       (irq_n),
      .host_block_o (bus_block),
      .blk_addr_i   (blk_addr),
      .blk_data_o   (blk_data),
      .blk_done_i   (blk_done),
      .block_write_i(block_write),
      .rd_any_i     (rd_any && !serial),
      .rd_load_o    (bus_load),
      .rd_size_i    (rd_size),
      .rd_addr_o    (bus_addr),
      .rd_data_i    (rd_data),
      .rd_done_o    (rd_done)
  );

  // The station sends nothing in binary mode (speed[2] = 0), which is not documented, and at speed 0, which
  // does not exist.
  assign talks = serial && speed[2] && speed[1:0] != 2'b00;

  ppmc312_serial #(
      .ClkHz   (CLK_HZ),
      .XtalHz  (XTAL_HZ),
      .CharsSum(128'(SUM_MODE) == "CHARS"),
      .SndLead (SND_LEAD),
      .SndWait (SND_WAIT)
  ) u_serial (
      .clk_i        (clk),
      .rst_ni       (rst_host_n),
      .ready_i      (out_oe),
      .enable_i     (talks),
      .rate_i       (speed[1:0]),
      .adr_i        (number),
      .rxd_i        (rxd),
      .txd_o        (txd),
      .snd_o        (snd),
      .host_block_o (line_block),
      .block_write_o(block_write),
      .host_result_i(host_result),
      .rd_addr_o    (line_addr),
      .rd_data_i    (rd_data),
      .status_i     (status),
      .report_take_o(line_load),
      .poll_result_i(poll_result)
  );

  assign host_block = '{
          valid: line_block.valid || bus_block.valid,
          size: serial ? line_block.size : bus_block.size
      };

  // ---- core ---------------------------------------------------------------------------------------

  outputs_t outputs;

  ppmc312_core #(
      .ClkHz    (CLK_HZ),
      .XtalHz   (XTAL_HZ),
      .Datasheet(Datasheet),
      .Version  (8'(VERSION))
  ) u_core (
      .clk_i        (clk),
      .rst_ni       (rst_core_n),
      .serial_i     (serial),
      .boot_i       (boot && !serial),
      .reset_o      (reset),
      .host_block_i (host_block),
      .blk_addr_o   (blk_addr),
      .blk_data_i   (blk_data),
      .blk_done_o   (blk_done),
      .rd_any_o     (rd_any),
      .rd_load_i    (line_load || bus_load),
      .rd_size_o    (rd_size),
      .rd_addr_i    (serial ? line_addr : bus_addr),
      .rd_data_o    (rd_data),
      .rd_done_i    (rd_done),
      .host_result_o(host_result),
      .status_o     (status),
      .poll_result_o(poll_result),
      .inputs_i     (inputs),
      .extck_i      (extck),
      .outputs_o    (outputs)
  );

  assign pout    = outputs.pout;
  assign dir     = outputs.dir;
  assign intlk_n = outputs.intlk_n;
  assign exon_n  = outputs.exon_n;
  assign cclr_n  = outputs.cclr_n;
  assign aclr_n  = outputs.aclr_n;
  assign zclmp_n = outputs.zclmp_n;
  assign cd_n    = outputs.cd_n;
  assign auxo_n  = outputs.auxo_n;

endmodule

`default_nettype wire
