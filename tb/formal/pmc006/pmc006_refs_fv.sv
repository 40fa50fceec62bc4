// SPDX-License-Identifier: Apache-2.0
// pmc006_refs_fv: compares the references with the rounded product of peak code and sine, for any table.
`include "ppmc_fv.svh"
`include "common/ppmc_lemma.svh"
`default_nettype none

module pmc006_refs_fv (
    input wire logic        clk_i,
    input wire logic        power_i,
    input wire logic        off_i,
    input wire logic        decay_i,
    input wire logic [ 2:0] att_i,
    input wire logic [ 7:0] base_i,
    input wire logic [10:0] current_comp_i,
    input wire logic [ 6:0] lead_angle_i,
    input wire logic        forward_i,
    input wire logic [ 8:0] angle_i
);

  logic [7:0] a_ref_o, b_ref_o;
  logic a_sign_o, b_sign_o;

  `FV_RESET
  `FV_ANY_START(power_i)

  pmc006_refs dut (
      .rst_ni(rst_dut_n),
      .*
  );

  logic [4:0] cycle_q;  // cycle of the computation
  logic off_q;
  logic [2:0] att_q;
  logic [11:0] comp_q;
  logic [7:0] peak_q, reduced_q;
  logic [8:0] b_angle_q, a_angle;
  logic [7:0] a_q, b_q;
  logic a_negative_q, b_negative_q;

  // Sine of an angle without its sign; 512 is one turn.
  function automatic logic [7:0] index(logic [8:0] angle);
    logic [8:0] half;
    half = {1'b0, angle[7:0]};
    return 8'((half <= 9'd128) ? half : 9'd256 - half);
  endfunction

  // (code * sine + 128) >> 8 in eight steps, from the lowest bit of the code on.
  logic a_runs, b_runs;
  logic [8:0] product_q, a_product_q, addend;
  assign addend  = reduced_q[cycle_q[2:0]] ? dut.sine : '0;
  assign a_runs  = cycle_q inside {[5'd8 : 5'd15]};
  assign b_runs  = cycle_q inside {[5'd16 : 5'd23]};
  assign a_angle = b_angle_q + 9'd128;
  always_ff @(posedge clk_i) begin
    product_q <= 9'((10'(cycle_q[2:0] == '0 ? 9'd128 : product_q) + 10'(addend)) >> 1);
    if (cycle_q == 5'd16) a_product_q <= product_q;
  end

  always_ff @(posedge clk_i or negedge rst_dut_n)
    if (!rst_dut_n) {cycle_q, a_q, b_q, a_negative_q, b_negative_q} <= '0;
    else begin
      cycle_q <= cycle_q + 5'd1;
      if (cycle_q == 5'd24) begin
        {a_q, b_q} <= {a_product_q[7:0], product_q[7:0]};
        {a_negative_q, b_negative_q} <= {!off_q && a_angle > 9'd256, !off_q && b_angle_q > 9'd256};
      end
    end

  always_ff @(posedge clk_i) begin
    if (cycle_q == 5'd0) begin
      off_q <= off_i;
      att_q <= decay_i ? att_i : '0;
      comp_q <= 12'(current_comp_i);
      b_angle_q <= forward_i ? angle_i + 9'(lead_angle_i) : angle_i - 9'(lead_angle_i);
    end
    if (cycle_q == 5'd1) peak_q <= (comp_q + 12'(base_i) > 12'd255) ? 8'd255 : 8'(comp_q + 12'(base_i));
    if (cycle_q == 5'd2) reduced_q <= off_q ? '0 : peak_q >> att_q;
  end

  `FV_LEMMA(lemma_cycle, dut.cycle_q == cycle_q)
  // verilog_format: off
  `FV_LEMMA(
      lemma_inputs,
      cycle_q == '0 || ({dut.off_q, dut.att_q, dut.angle_q} == {off_q, att_q, b_angle_q}
          && 12'(dut.current_comp_q) == comp_q && comp_q < 12'd2048))
  // verilog_format: on
  `FV_LEMMA(lemma_peak, cycle_q < 5'd2 || dut.peak_q == peak_q)
  `FV_LEMMA(lemma_reduced, cycle_q < 5'd3 || dut.reduced_q == reduced_q)
  `FV_LEMMA(lemma_index, !(a_runs || b_runs) || dut.u_sine.index_q == index(a_runs ? a_angle : b_angle_q))
  `FV_LEMMA(lemma_product, !(cycle_q inside {[5'd9 : 5'd24]}) || dut.product_q == product_q)
  `FV_LEMMA(lemma_a, !(cycle_q inside {[5'd17 : 5'd24]}) || dut.a_q == a_product_q[7:0])

  `FV_LEMMA(p006_exc_13_references, {a_ref_o, b_ref_o} == {a_q, b_q})
  `FV_LEMMA(p006_exc_10_signs, {a_sign_o, b_sign_o} == {a_negative_q, b_negative_q})
  `FV_COVER(seen_reference, a_ref_o == 8'd77 && a_sign_o && cycle_q == 5'd25)

endmodule

`default_nettype wire
