// SPDX-License-Identifier: Apache-2.0
// ppmc_uart_bridge_fv: proves that each block fulfils the assumptions in the proofs of the other blocks,
// that only a new request begins a script, and that the request buffer is not written while a
// script runs.
`include "ppmc_fv.svh"
`default_nettype none

module ppmc_uart_bridge_fv (
    input wire logic        clk_i,
    input wire logic        rxd_i,
    input wire logic [ 7:0] d_i,
    input wire logic        int_ni,
    input wire logic [ 7:0] pins_i,
    input wire logic [31:0] count_i
);

  localparam int unsigned MsCycles = 6;

  logic txd_o, cs_no, rd_no, wr_no, part_rst_no, active_o;
  logic [3:0] a_o;
  logic [7:0] d_o, straps_o;
  logic [0:0] count_zero_o;

  `FV_RESET

  ppmc_uart_bridge #(
      .ClkHz (1000 * MsCycles),
      .XtalHz(1_000_000),
      .Baud  (1200)
  ) dut (
      .watch_i(1'b0),
      .*
  );

  logic begun_q;  // 1: a script has begun
  logic [2:0] since_ms_q;  // cycles since the last millisecond, saturates at 7
  logic [6:0] seq_q;  // SEQ of the request that began the last script
  logic own_q;  // 1: the last script has a number (SEQ is not 0)

  always_ff @(posedge clk_i)
    if (!rst_ni) {begun_q, since_ms_q, seq_q, own_q} <= {1'b0, 3'd4, 8'd0};
    else begin
      begun_q    <= begun_q || dut.start;
      since_ms_q <= dut.ms_q ? '0 : (since_ms_q == '1) ? '1 : since_ms_q + 1'b1;
      if (dut.start) {own_q, seq_q} <= {dut.seq != '0, dut.seq};
    end

  // These assertions are assumptions in the proofs of ppmc_bridge_exec, _wait, _rx and _msg.
  `FV_ASSERT(start_in_idle, !((dut.start || dut.resend) && active_o) && !(dut.start && dut.resend))
  `FV_ASSERT(busy_after_request, !active_o || $past(rst_ni && (active_o || dut.request)))
  `FV_ASSERT(answer_of_something, !dut.resend || begun_q)
  `FV_ASSERT(ms_apart, !dut.ms_q || since_ms_q >= 3'(MsCycles - 2))
  `FV_ASSERT(ms_within, since_ms_q < 3'(MsCycles))
  `FV_ASSERT(one_outcome, !(dut.rx_valid && dut.rx_error))

  `FV_ASSERT(ub_seq_02_last_number, !own_q || dut.last_seq_q == seq_q)
  `FV_ASSERT(ub_seq_02_no_script_again, !$past(rst_ni && dut.resend) || (!dut.script && dut.answer))
  `FV_ASSERT(ub_frm_07_script_for_a_request, !dut.script || $past(dut.script || dut.start))
  `FV_ASSERT(ub_frm_07_request_stands, !(dut.script && dut.req_we))
  `FV_ASSERT(one_writes, !(dut.req_we && dut.ans_we))
  `FV_ASSERT(answer_written_by_scripts, !dut.ans_we || dut.script)
  `FV_ASSERT(ub_msg_01_event_when_asked_for, !dut.event_q || dut.enabled_q)
  `FV_COVER(seen_numbered_script, dut.script && own_q)
  `FV_COVER(seen_event, dut.event_q)


endmodule

`default_nettype wire
