// SPDX-License-Identifier: Apache-2.0
// ppmc312_position_fv: compares both positions with signed sums of pulses and edges, and the monitors
// with the difference of the positions.
`include "ppmc_fv.svh"
`default_nettype none

module ppmc312_position_fv (
    input wire logic        clk_i,
    input wire logic        count_i,
    input wire logic        ccw_i,
    input wire logic        output_i,
    input wire logic        epin_i,
    input wire logic        epdir_i,
    input wire logic [31:0] value_i,
    input wire logic [31:0] lock_value_i,
    input wire logic        set_pos_i,
    input wire logic        set_enc_i,
    input wire logic        set_lock_i,
    input wire logic        toggle_lock_i,
    input wire logic [ 1:0] set_window_i,
    input wire logic [ 2:0] window_flags_i,
    input wire logic [15:0] window_range_i,
    input wire logic [ 1:0] load_i,
    input wire logic [ 1:0] read_i
);

  logic [31:0] pos_o, enc_o;
  logic counted_o, lock_o, unlock_o, coupled_inside_o, coupled_o;
  logic [1:0] window_on_o, outside_o, pending_o, value_o;

  `FV_RESET

  ppmc312_position dut (.*);

  // ---- positions, interlock ---------------------------------------------------------------------------

  logic [31:0] pos_q, enc_q, lock_pos_q;
  logic epin_q, lock_q, counted_q, reached;

  assign reached = counted_q && lock_q && pos_q == lock_pos_q;

  always_ff @(posedge clk_i)
    if (!rst_ni) {pos_q, enc_q, lock_pos_q, epin_q, lock_q, counted_q} <= {96'd0, 1'b1, 2'b00};
    else begin
      epin_q <= epin_i;
      counted_q <= count_i;
      if (set_pos_i) pos_q <= value_i;
      else if (count_i) pos_q <= ccw_i ? pos_q - 32'd1 : pos_q + 32'd1;
      if (set_enc_i) enc_q <= value_i;
      else if (epin_i && !epin_q) enc_q <= epdir_i ? enc_q - 32'd1 : enc_q + 32'd1;
      if (set_lock_i) lock_pos_q <= lock_value_i;
      lock_q <= (lock_q ^ toggle_lock_i) && !reached;
    end

  `FV_ASSERT(p312_mot_05_counts, pos_o == pos_q && counted_o == counted_q)
  `FV_ASSERT(p312_mon_01_edges, enc_o == enc_q)
  `FV_ASSERT(p312_out_03_lock, lock_o == lock_q)
  `FV_ASSERT(p312_out_03_unlock, unlock_o == $past(rst_ni && reached))
  `FV_ASSERT(lemma_lock, dut.lock_pos_q == lock_pos_q && dut.epin_q == epin_q)

  // ---- monitors ---------------------------------------------------------------------------------------

  logic [31:0] difference_q, difference_q2, magnitude;
  logic [1:0][15:0] range_q;
  logic [2:0] young_q, rest_q;  // cycles since a set_window_i or reset; cycles at standstill; at most 7

  assign magnitude = difference_q2[31] ? -difference_q2 : difference_q2;

  always_ff @(posedge clk_i) begin
    difference_q  <= pos_q - enc_q;
    difference_q2 <= difference_q;
    for (int unsigned n = 0; n < 2; n++) if (set_window_i[n]) range_q[n] <= window_range_i;
    if (!rst_ni || set_window_i != '0) young_q <= '0;
    else if (young_q != '1) young_q <= young_q + 3'd1;
    if (!rst_ni || output_i || set_window_i[0]) rest_q <= '0;
    else if (rest_q != '1) rest_q <= rest_q + 3'd1;
  end

  // inside: decision of the block in this cycle, for the positions three cycles ago
  for (genvar n = 0; n < 2; n++) begin : g_monitor
    logic inside_q, known_q;  // known_q: a range has been set
    always_ff @(posedge clk_i) begin
      inside_q <= magnitude <= {16'd0, range_q[n]};
      known_q  <= rst_ni && (known_q || set_window_i[n]);
    end
    `FV_ASSERT(lemma_range, !known_q || dut.range_q[n] == range_q[n])
    `FV_ASSERT(p312_mon_02_inside, young_q < 3'd3 || !known_q || dut.inside_q[n] == inside_q)
  end
  `FV_ASSERT(lemma_difference, young_q < 3'd1 || dut.diff_q == difference_q)
  // verilog_format: off
  `FV_ASSERT(
      lemma_size,
      young_q < 3'd2 || (dut.negative_q == difference_q2[31]
          && dut.size_q == (difference_q2[15:0] ^ {16{difference_q2[31]}})
          && dut.large_q == (difference_q2[31:16] != {16{difference_q2[31]}})))
  // verilog_format: on
  `FV_ASSERT(lemma_settle, dut.settle_q == ((rest_q >= 3'd4) ? 4'hf : ~(4'hf << rest_q[1:0])))
  `FV_ASSERT(p312_mon_03_standstill, dut.evaluate == {1'b1, rest_q >= 3'd4 && !output_i})
  `FV_ASSERT(p312_mon_06_clamp, !coupled_o || (window_on_o[0] && rest_q >= 3'd4 && !output_i))
  `FV_ASSERT(p312_mon_06_inside, coupled_inside_o == (coupled_o && dut.inside_q[0]))
  `FV_COVER(seen_unlock, unlock_o && pos_q == 32'hFFFFFFFE)
  `FV_COVER(seen_outside, outside_o[1] && !outside_o[0] && coupled_inside_o)

endmodule

`default_nettype wire
