// SPDX-License-Identifier: Apache-2.0
// pmc006_serial_fv: proves the times and the bits of the reply, and that no byte is received during the
// reply.
`include "ppmc_fv.svh"
`include "common/ppmc_lemma.svh"
`default_nettype none

module pmc006_serial_fv
  import pmc006_pkg::frame_t;
(
    input wire logic        clk_i,
    input wire logic        power_i,
    input wire logic        ready_i,
    input wire logic [ 7:0] addr_i,
    input wire logic        rxd_i,
    input wire logic [31:0] reply_i
);

  // A bit is 8.5 cycles: 34 units, of which 4 pass in a cycle.
  localparam int unsigned ClkHz = 17, Baud = 2;
  localparam logic [5:0] BitUnits = 6'd34, CycleUnits = 6'd4;

  logic txd_o, de_o;
  frame_t frame_o;

  `FV_RESET
  `FV_ANY_START(power_i)

  pmc006_serial #(
      .ClkHz(ClkHz),
      .Baud (Baud)
  ) dut (
      .rst_ni(rst_dut_n),
      .*
  );

  logic ready_q;
  always_ff @(posedge clk_i or negedge rst_dut_n)
    if (!rst_dut_n) ready_q <= 1'b0;
    else ready_q <= ready_i;
  `FV_ASSUME(stays_ready, ready_i || !ready_q)

  // byte_q, bit_q: bit on the line, byte_q = 1 .. 8: reply; byte_q = 0: bit 8 before the driver is on, bit 9
  // after that. units_q: units since the beginning of this bit. The last stop bit of the frame was sampled at
  // the edge before the cycle of go.
  logic active_q, next_bit;
  logic [3:0] byte_q, bit_q;
  logic [5:0] units_q;
  logic [7:0] sum_q, data_q, data;

  // silence_q: bit times since the last byte plus one half, at most 202; exact if the byte did not end a
  // frame
  logic bytes_only_q;
  logic [7:0] silence_q;

  typedef logic [201:0][7:0] states_t;
  function automatic states_t states();
    for (int unsigned n = 0; n < 202; n++) states[n] = 8'(ppmc_lfsr_pkg::after(n, 8));
  endfunction
  localparam states_t States = states();

  assign next_bit = units_q + CycleUnits >= BitUnits;

  always_comb begin
    unique case (byte_q)
      4'd0: data = 8'hA5;
      4'd1: data = 8'h7A;
      4'd2: data = addr_i;
      4'd3: data = reply_i[7:0];
      4'd4: data = reply_i[15:8];
      4'd5: data = reply_i[23:16];
      4'd6: data = reply_i[31:24];
      default: data = sum_q;
    endcase
  end

  always_ff @(posedge clk_i) begin
    if (dut.valid) units_q <= frame_o.go ? CycleUnits : CycleUnits + BitUnits / 2;
    else units_q <= next_bit ? units_q + CycleUnits - BitUnits : units_q + CycleUnits;
    if (dut.valid) silence_q <= '0;
    else if (next_bit && silence_q != 8'd202) silence_q <= silence_q + 1'b1;

    if (frame_o.go) {byte_q, bit_q, sum_q} <= {4'd0, 4'd8, 8'd0};
    else if (next_bit) begin
      bit_q <= bit_q + 1'b1;
      if (bit_q == 4'd9) begin
        {bit_q, byte_q, data_q} <= {4'd0, byte_q + 1'b1, data};
        sum_q <= sum_q + data;
      end
    end
  end

  always_ff @(posedge clk_i or negedge rst_dut_n)
    if (!rst_dut_n) {active_q, bytes_only_q} <= '0;
    else begin
      if (dut.valid) bytes_only_q <= !frame_o.go;
      active_q <= frame_o.go || (active_q && !(next_bit && byte_q == 4'd8 && bit_q == 4'd9));
    end

  logic rx_off, line;
  assign rx_off = active_q && !(byte_q == 4'd8 && bit_q == 4'd9 && units_q >= BitUnits / 2);
  assign line   = !active_q || byte_q == '0 || bit_q == 4'd9 || (bit_q != '0 && data_q[3'(bit_q-1'b1)]);

  // The receiver is idle during the reply; only at its beginning, the line can cause the state StStart.
  logic lead, last, first_half, tail;  // lead: before the driver is on; tail: the receiver is on again
  logic [5:0] phase;  // phase of the block in this cycle; its offset is 30
  logic rx_idle;

  assign lead = active_q && byte_q == '0 && bit_q == 4'd8;
  assign last = active_q && byte_q == 4'd8 && bit_q == 4'd9;
  assign first_half = last && units_q < BitUnits / 2;
  assign tail = active_q && !rx_off;
  assign phase = units_q + CycleUnits + (first_half ? BitUnits / 2 : '0);
  assign rx_idle = dut.u_rx.state_q == 0 && dut.u_rx.phase_q == 6'd47 && !dut.u_rx.g_modulus.wrapped_q;

  `FV_LEMMA(lemma_range, !active_q || (byte_q <= 4'd8 && bit_q <= 4'd9 && (byte_q != '0 || bit_q >= 4'd8)))
  // verilog_format: off
  `FV_LEMMA(
      lemma_units,
      !(active_q || bytes_only_q) || (units_q < BitUnits && !(active_q && units_q[0]) && !(lead
          && units_q[1])))
  // verilog_format: on
  `FV_LEMMA(lemma_ready, !active_q || ready_q)
  `FV_LEMMA(lemma_tick, !(active_q || bytes_only_q) || dut.bit_tick_q == (phase >= BitUnits))
  `FV_LEMMA(
      lemma_phase,
      !(active_q || bytes_only_q) || dut.phase_q == (phase >= BitUnits ? phase - BitUnits : phase + 6'd30))
  // verilog_format: off
  `FV_LEMMA(
      lemma_silence,
      !bytes_only_q || (!active_q && silence_q <= 8'd202 && (silence_q == 8'd202
          || dut.u_silence.u_timer.count_q == States[silence_q])))
  // verilog_format: on
  `FV_LEMMA(lemma_byte, !active_q || dut.byte_index_q == byte_q)
  `FV_LEMMA(lemma_bit, !active_q || dut.bits_left_q == (byte_q == '0 ? 4'd0 : 4'd9 - bit_q))
  `FV_LEMMA(lemma_data, !active_q || byte_q == '0 || dut.bits_q == 8'({9'h1FF, data_q} >> bit_q))
  `FV_LEMMA(lemma_sum, !active_q || dut.sum_q == ((byte_q == '0 || bit_q != '0) ? sum_q : sum_q - data_q))
  `FV_LEMMA(lemma_valid,
            !dut.valid || dut.u_rx.state_q == 0 && dut.u_rx.phase_q == 6'd47 && !dut.u_rx.g_modulus.wrapped_q)
  // verilog_format: off
  `FV_LEMMA(
      lemma_rx_start,
      !lead || rx_idle || (dut.u_rx.state_q == 1 && !dut.u_rx.g_modulus.wrapped_q
          && 7'(dut.u_rx.phase_q) <= 7'd47 + 7'(units_q) && dut.u_rx.phase_q >= 6'd51 && (units_q < 6'd16
          || 7'(dut.u_rx.phase_q) >= 7'd35 + 7'(units_q))))
  // verilog_format: on
  `FV_LEMMA(lemma_rx_idle, !active_q || lead || rx_idle)
  `FV_LEMMA(lemma_gate,
            !active_q || (lead && units_q < 6'd8) || (tail && units_q >= 6'd22) || !dut.line_high_q)
  `FV_LEMMA(lemma_first,
            !active_q || (lead && units_q < 6'd12) || (tail && units_q >= 6'd26) || dut.u_rx.u_sync.q1_o)
  `FV_LEMMA(lemma_second,
            !active_q || (lead && units_q < 6'd16) || (tail && units_q >= 6'd30) || dut.u_rx.line)

  `FV_LEMMA(p006_frm_03_driver, de_o == (active_q && (byte_q != '0 || bit_q == 4'd9)))
  `FV_LEMMA(p006_frm_03_line, txd_o == line)
  `FV_LEMMA(p006_frm_07_off, dut.rx_off_q == rx_off)
  `FV_LEMMA(p006_frm_07_no_frame, !(frame_o.go && active_q))
  `FV_LEMMA(no_byte_in_a_reply, !(dut.valid && active_q))
  `FV_LEMMA(p006_frm_04_timeout, !bytes_only_q || dut.timeout == (silence_q == 8'd202))
  `FV_COVER(seen_go, frame_o.go)
  `FV_COVER(seen_end, tail && units_q >= 6'd30 && sum_q == 8'h12)
  `FV_COVER(seen_timeout, dut.timeout && bytes_only_q)

endmodule

`default_nettype wire
