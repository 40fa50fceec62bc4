// SPDX-License-Identifier: Apache-2.0
// ppmc_sync: simulation model of the synchroniser with metastability, for `make test JITTER=1`.
// Timing: like rtl/common/ppmc_sync.sv, but the first stage samples each change of a bit one cycle late with
//         a probability of one half. The first edge after a reset samples the pins without delay.
//         A bit that changes together with the registers of clk_i, for example an output of a bridge on the
//         same board, is sampled without delay: it is stable long before the next edge.
// Assumes: a model of an asynchronous device does not change its outputs together with registers of clk_i.
// How:    the decision depends only on the seed of the simulation, the instance, the bit and the number of
//         edges since the reset, so that a repeated stimulus has the same delays. The end of the simulation
//         prints the number of changes that were sampled with and without delay.
`default_nettype none

module ppmc_sync #(
    parameter int unsigned             Width    = 1,
    parameter logic        [Width-1:0] ResetVal = '1
) (
    input  wire logic             clk_i,
    input  wire logic             rst_ni,
    input  wire logic [Width-1:0] d_i,
    output logic      [Width-1:0] q1_o,
    output logic      [Width-1:0] q2_o
);

  logic [Width-1:0] late_q  /*verilator public_flat_rd*/;  // bits that the last edge sampled late
  logic [Width-1:0] stage_q;
  logic [Width-1:0] last_q;  // pins at the last edge
  logic [Width-1:0] changed, late;
  logic is_running_q = 1'b0;  // 1: the last edge was not in reset
  int unsigned key, edges_q;
  logic tick_q = 1'b0;  // changes at each edge, together with all registers of clk_i
  logic [Width-1:0] after;  // pins after the registers have changed at the last edge
  int unsigned late_count = 0, prompt_count = 0;

  initial key = $urandom;  // depends on the seed of the simulation

  function automatic int unsigned draw(int unsigned number);
    int unsigned mixed;
    mixed = (number ^ key) * 32'h9E37_79B1;
    mixed = (mixed ^ (mixed >> 15)) * 32'h85EB_CA6B;
    mixed = (mixed ^ (mixed >> 13)) * 32'hC2B2_AE35;
    return mixed ^ (mixed >> 16);
  endfunction

  always @(posedge clk_i) tick_q <= !tick_q;
  always @(posedge tick_q or negedge tick_q) after = d_i;

  always_comb begin
    changed = is_running_q ? (d_i ^ last_q) & (d_i ^ after) : '0;
    late = '0;
    if (changed != '0)
      for (int unsigned i = 0; i < Width; i++) if (changed[i]) late[i] = draw((edges_q << 10) ^ i) >> 31 != 0;
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {q2_o, stage_q, last_q} <= {ResetVal, ResetVal, ResetVal};
      {is_running_q, edges_q, late_q} <= '0;
    end else begin
      q2_o         <= stage_q;
      stage_q      <= d_i ^ late;
      late_q       <= late;
      last_q       <= d_i;
      is_running_q <= 1'b1;
      edges_q      <= edges_q + 1;
    end
  end

  assign q1_o = stage_q;

  always @(posedge clk_i) begin
    late_count   <= late_count + $countones(late);
    prompt_count <= prompt_count + $countones(changed & ~late);
  end

  final $display("ppmc_sync: %0d late, %0d prompt", late_count, prompt_count);

endmodule

`default_nettype wire
