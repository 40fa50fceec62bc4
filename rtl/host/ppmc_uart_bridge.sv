// SPDX-License-Identifier: Apache-2.0
// ppmc_uart_bridge: UART host interface of a device. A request frame contains a script of bus accesses, and
//         an answer frame contains its results.
// Rules:  docs/uart_bridge.md.
// Timing: this block synchronises rxd_i. int_ni, pins_i, watch_i and count_i are synchronous to clk_i.
`default_nettype none

module ppmc_uart_bridge
  import ppmc_bridge_pkg::*;
#(
    parameter int unsigned ClkHz     = 24_000_000,  // at least 5 * Baud
    parameter int unsigned XtalHz    = 16_000_000,  // crystal in Hz; only IDENT uses XtalHz, Part, Datasheet
    parameter int unsigned Baud      = 115_200,     // baud rate after reset
    parameter int unsigned Part      = 104,
    parameter int unsigned Axes      = 1,           // number of pulse counters, 1 or 2
    parameter bit          Counter   = 1'b1,        // 1: the pulses are counted; only IDENT uses this
    parameter bit          Datasheet = 1'b0,
    parameter int unsigned Watch     = 1,           // number of recorded levels
    parameter int unsigned Record    = 0            // 4 .. 16: 2**Record records; 0: no recorder
) (
    input  wire logic               clk_i,
    input  wire logic               rst_ni,
    input  wire logic               rxd_i,         // line from the PC, asynchronous
    output logic                    txd_o,         // line to the PC
    // bus of the device
    output logic                    cs_no,         // chip select
    output logic                    rd_no,         // read strobe
    output logic                    wr_no,         // write strobe
    output logic      [        3:0] a_o,           // register
    output logic      [        7:0] d_o,           // write data
    input  wire logic [        7:0] d_i,           // read data
    input  wire logic               int_ni,        // interrupt, active low
    output logic                    part_rst_no,   // reset of the device, active low
    // board
    output logic      [        7:0] straps_o,      // strap outputs, set by operation STRAPS
    input  wire logic [        7:0] pins_i,        // pins for operation PINS
    input  wire logic [  Watch-1:0] watch_i,       // levels for the recorder
    input  wire logic [Axes*32-1:0] count_i,       // pulse counters; axis 1 is in bits 31:0
    output logic      [   Axes-1:0] count_zero_o,  // strobe: set the counter to 0
    output logic                    active_o       // 1: a script is running, or its answer is being sent
);

  if (!is_available(0, ClkHz, Baud)) begin : g_check
    $fatal(1, "ppmc_uart_bridge: ClkHz must be at least 5 * Baud");
  end
  if (Axes < 1 || Axes > 2) begin : g_check_axes
    $fatal(1, "ppmc_uart_bridge: Axes 1 or 2");
  end

  if (Record != 0 && (Record < 4 || Record > 16)) begin : g_check_record
    $fatal(1, "ppmc_uart_bridge: Record 0 or 4 .. 16");
  end

  localparam int unsigned Width = phase_width(ClkHz, Baud);
  localparam int unsigned TopCode = top_code(ClkHz, Baud);
  localparam logic [7:0] IdentFlags = {4'(TopCode), 2'(Axes - 1), Counter, Datasheet};
  // The leading zeros are necessary: Verilator up to 5.032 assumes that a parameter which is set to a plain
  // number has no width.
  localparam logic [127:0] Ident = {
    32'd0 | ClkHz, 32'd0 | XtalHz, IdentFlags, Part[15:0], PROTOCOL_VERSION, 8'h43, 8'h4D, 8'h50, 8'h50
  };

  // ---------------------------------------------------------------- a millisecond

  localparam int unsigned MsCycles = ClkHz / 1000;
  localparam int unsigned MsBits = $clog2(MsCycles);
  logic [MsBits-1:0] prescale_q;
  logic ms_q;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      prescale_q <= '0;
      ms_q       <= 1'b0;
    end else begin
      ms_q       <= prescale_q == '0;
      prescale_q <= ms_q ? MsBits'(MsCycles - 2) : prescale_q - 1'b1;
    end
  end

  // ---------------------------------------------------------------- line

  logic [Width-1:0] step;
  logic [7:0] rx_byte, tx_byte;
  logic rx_valid, rx_error, rx_break, tx_valid, tx_ready;
  logic good, answered;
  bridge_cmd_t bridge_cmd;

  ppmc_bridge_rate #(
      .ClkHz(ClkHz),
      .Baud (Baud),
      .Width(Width)
  ) u_rate (
      .clk_i,
      .rst_ni,
      .ms_i      (ms_q),
      .set_i     (bridge_cmd.valid && bridge_cmd.op == SysRate),
      .code_i    (bridge_cmd.arg),
      .answered_i(answered),
      .good_i    (good),
      .break_i   (rx_error && rx_break),
      .step_o    (step)
  );

  ppmc_uart_rx #(
      .Width(Width)
  ) u_uart_rx (
      .clk_i,
      .rst_ni,
      .step_i (step),
      .wrap_i ('0),
      .rxd_i,
      .byte_o (rx_byte),
      .valid_o(rx_valid),
      .error_o(rx_error),
      .break_o(rx_break)
  );

  ppmc_uart_tx #(
      .Width(Width)
  ) u_uart_tx (
      .clk_i,
      .rst_ni,
      .step_i (step),
      .byte_i (tx_byte),
      .valid_i(tx_valid),
      .ready_o(tx_ready),
      .txd_o
  );

  // ---------------------------------------------------------------- requests

  logic request, start, resend, dropped, script, answer, nak_taken;
  logic req_we, ans_we;
  logic [7:0] req_waddr, req_wdata, req_raddr, req_length, ans_waddr, ans_wdata, ans_raddr, rdata;
  logic [6:0] seq, last_seq_q;
  nak_e nak;

  ppmc_bridge_rx u_rx (
      .clk_i,
      .rst_ni,
      .ms_i       (ms_q),
      .byte_i     (rx_byte),
      .valid_i    (rx_valid),
      .error_i    (rx_error),
      .we_o       (req_we),
      .waddr_o    (req_waddr),
      .wdata_o    (req_wdata),
      .good_o     (good),
      .request_o  (request),
      .seq_o      (seq),
      .length_o   (req_length),
      .busy_i     (active_o),
      .dropped_o  (dropped),
      .nak_o      (nak),
      .nak_taken_i(nak_taken)
  );

  // A request that has already been answered is answered again from the buffer (UB-SEQ-02).
  assign resend    = request && seq == last_seq_q && seq != '0;
  assign start    = request && !resend;
  assign active_o = script || answer;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) last_seq_q <= '0;
    else if (start) last_seq_q <= seq;
  end

  // The lower half of the RAM stores the request, the upper half the answer. No request is received while a
  // script runs.
  ppmc_ram #(
      .Width   (8),
      .AddrBits(9)
  ) u_ram (
      .clk_i,
      .we_i   (req_we || ans_we),
      .waddr_i(script ? {1'b1, ans_waddr} : {1'b0, req_waddr}),
      .wdata_i(script ? ans_wdata : req_wdata),
      .raddr_i(script ? {1'b0, req_raddr} : {1'b1, ans_raddr}),
      .rdata_o(rdata)
  );

  // ---------------------------------------------------------------- scripts

  script_result_t script_result;
  logic rec_next;
  logic [7:0] rec_data;
  logic [63:0] rec_info;

  ppmc_bridge_exec #(
      .TopCode(TopCode),
      .Axes(Axes),
      .Recorder(Record != 0),
      .Ident(Ident),
      .Build(ppmc_build_pkg::BUILD_ID)
  ) u_exec (
      .clk_i,
      .rst_ni,
      .ms_i        (ms_q),
      .start_i     (start),
      .resend_i    (resend),
      .length_i    (req_length),
      .raddr_o     (req_raddr),
      .rdata_i     (rdata),
      .interrupt_i (dropped),
      .script_o    (script),
      .answer_o    (answer),
      .answered_i  (answered),
      .result_o    (script_result),
      .we_o        (ans_we),
      .waddr_o     (ans_waddr),
      .wdata_o     (ans_wdata),
      .bridge_cmd_o(bridge_cmd),
      .rec_next_o  (rec_next),
      .rec_data_i  (rec_data),
      .rec_info_i  (rec_info),
      .pins_i,
      .count_i,
      .count_zero_o,
      .part_rst_no,
      .cs_no,
      .rd_no,
      .wr_no,
      .a_o,
      .d_o,
      .d_i
  );

  logic record;
  assign record   = bridge_cmd.valid && bridge_cmd.op == SysRecord;
  assign straps_o = bridge_cmd.straps;

  if (Record != 0) begin : g_recorder
    logic begin_q, end_q, rewind_q;

    always_ff @(posedge clk_i or negedge rst_ni) begin
      if (!rst_ni) {begin_q, end_q, rewind_q} <= '0;
      else begin
        begin_q  <= record && bridge_cmd.arg[1:0] == RECORD_BEGIN;
        end_q    <= record && bridge_cmd.arg[1:0] == RECORD_END;
        rewind_q <= record && bridge_cmd.arg[1:0] == RECORD_REWIND;
      end
    end

    ppmc_recorder #(
        .Width   (Watch),
        .AddrBits(Record)
    ) u_recorder (
        .clk_i,
        .rst_ni,
        .watch_i,
        .begin_i (begin_q),
        .end_i   (end_q),
        .rewind_i(rewind_q),
        .next_i  (rec_next),
        .data_o  (rec_data),
        .info_o  (rec_info)
    );
  end else begin : g_no_recorder
    assign rec_data = '0;
    assign rec_info = '0;

    logic unused;
    assign unused = ^{watch_i, rec_next, record};
  end

  // ---------------------------------------------------------------- events

  logic enabled_q, event_q, int_nq, event_taken, events_set;
  assign events_set = bridge_cmd.valid && bridge_cmd.op == SysEvents;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      enabled_q <= 1'b0;
      event_q   <= 1'b0;
      int_nq    <= 1'b1;
    end else begin
      int_nq <= int_ni;
      if (events_set) enabled_q <= bridge_cmd.arg[0];
      if (events_set) event_q <= bridge_cmd.arg[0] && (event_q || (!enabled_q && !int_ni));
      else if (enabled_q && int_nq && !int_ni) event_q <= 1'b1;
      else if (event_taken) event_q <= 1'b0;
    end
  end

  // ---------------------------------------------------------------- messages

  logic msg_start, msg_idle, msg_more, msg_take;
  logic [7:0] msg_byte;

  ppmc_bridge_msg u_msg (
      .clk_i,
      .rst_ni,
      .script_i     (script),
      .answer_i     (answer),
      .seq_i        (seq),
      .result_i     (script_result),
      .raddr_o      (ans_raddr),
      .rdata_i      (rdata),
      .answered_o   (answered),
      .event_i      (event_q),
      .pins_i,
      .event_taken_o(event_taken),
      .nak_i        (nak),
      .nak_taken_o  (nak_taken),
      .start_o      (msg_start),
      .idle_i       (msg_idle),
      .byte_o       (msg_byte),
      .more_o       (msg_more),
      .take_i       (msg_take)
  );

  ppmc_bridge_tx u_tx (
      .clk_i,
      .rst_ni,
      .start_i(msg_start),
      .idle_o (msg_idle),
      .byte_i (msg_byte),
      .more_i (msg_more),
      .take_o (msg_take),
      .byte_o (tx_byte),
      .valid_o(tx_valid),
      .ready_i(tx_ready)
  );

endmodule

`default_nettype wire
