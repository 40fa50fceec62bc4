// SPDX-License-Identifier: Apache-2.0
// pmc006_refs: computes the current references of both phases from angle, current setting, compensation and
//         decay.
// Rules:  P006-EXC-10..13, P006-EXC-20, P006-EXC-30, P006-STA-12.
// Timing: a computation takes 32 cycles; the first begins in the first cycle after reset. All inputs except
//         base_i are sampled at the same edge, base_i one cycle later. The four outputs change together 24
//         cycles after that edge.
// How:    the peak code is RB + B, at most 255. If decay_i is high, the peak code is shifted right by att_i
//         bits. A serial multiplier then multiplies the result by the sine of phase A and by the sine of
//         phase B, in 8 cycles each. The first of these 8 cycles also adds the rounding constant.
`default_nettype none

module pmc006_refs (
    input  wire logic        clk_i,
    input  wire logic        rst_ni,
    input  wire logic        off_i,           // 1: no current (boot, or motor released)
    input  wire logic        decay_i,         // 1: reduce the current (standstill)
    input  wire logic [ 2:0] att_i,           // attenuation coefficient, 1 .. 4
    input  wire logic [ 7:0] base_i,          // base code RB; valid one cycle after the other inputs
    input  wire logic [10:0] current_comp_i,  // current compensation B
    input  wire logic [ 6:0] lead_angle_i,    // lead angle W
    input  wire logic        forward_i,       // direction of the motion
    input  wire logic [ 8:0] angle_i,         // electrical angle, 512 per turn
    output logic      [ 7:0] a_ref_o,         // current reference of phase A
    output logic             a_sign_o,        // sign of a_ref_o
    output logic      [ 7:0] b_ref_o,         // current reference of phase B
    output logic             b_sign_o         // sign of b_ref_o
);

  logic [4:0] cycle_q, cycle_d;
  logic off_q;
  logic [2:0] att_q;
  logic [10:0] current_comp_q;
  logic [11:0] peak_sum;  // RB + B
  logic [8:0] angle_q, angle_a;
  logic [7:0] peak_q, reduced_q, angle, index, a_q;
  logic [8:0] sine, product_q;
  logic [9:0] sum;

  assign cycle_d = cycle_q + 1'b1;

  // ---- peak code ------------------------------------------------------------------------------------------

  assign peak_sum = 12'(current_comp_q) + 12'(base_i);

  // ---- sine and product -----------------------------------------------------------------------------------

  // Phase A leads by a quarter turn. Its product is computed in cycles 8 to 15, that of phase B in cycles
  // 16 to 23.
  assign angle_a = {angle_q[8:7] + 2'd1, angle_q[6:0]};
  assign angle = cycle_d[4] ? angle_q[7:0] : angle_a[7:0];
  assign index = angle[7] ? 8'd128 - 8'(angle[6:0]) : 8'(angle[6:0]);
  assign sum     = ((cycle_q[2:0] == '0) ? 10'd128 : 10'(product_q)) +
      (reduced_q[cycle_q[2:0]] ? 10'(sine) : 10'd0);

  pmc006_sine_rom u_sine (
      .clk_i,
      .index_i(index),
      .sine_o (sine)
  );

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) cycle_q <= '0;
    else cycle_q <= cycle_d;
  end

  // No reset: cycle 0 starts a computation, which sets these registers before use.
  always_ff @(posedge clk_i) begin
    if (cycle_q == '0) begin
      off_q <= off_i;
      att_q <= decay_i ? att_i : '0;
      current_comp_q <= current_comp_i;
      angle_q <= forward_i ? angle_i + 9'(lead_angle_i) : angle_i - 9'(lead_angle_i);
    end
    if (cycle_q == 5'd1) peak_q <= (peak_sum[11:8] != '0) ? 8'hff : peak_sum[7:0];
    reduced_q <= off_q ? '0 : peak_q >> att_q;  // stable from cycle 3 on
    product_q <= 9'(sum >> 1);
    if (cycle_q == 5'd16) a_q <= product_q[7:0];
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {a_ref_o, a_sign_o, b_ref_o, b_sign_o} <= '0;
    end else if (cycle_q == 5'd24) begin
      a_ref_o  <= a_q;
      a_sign_o <= angle_a[8] && angle_a[7:0] != '0 && !off_q;
      b_ref_o  <= product_q[7:0];
      b_sign_o <= angle_q[8] && angle_q[7:0] != '0 && !off_q;
    end
  end

endmodule

`default_nettype wire
