// SPDX-License-Identifier: Apache-2.0
// ppmc312_fetch: reads an instruction into block_o, or copies it into the instruction queue.
// Rules:  P312-GEN-04, P312-CMD-00 and P312-CMD-82 (short forms), P312-OVR-01, P312-CMD-49.
// Timing: done_o follows start_i or copy_i by 19 cycles, regardless of the length of the instruction.
// Assumes: data_i is valid two cycles after addr_o.
`default_nettype none

module ppmc312_fetch
  import ppmc312_pkg::*;
  import ppmc312_link_pkg::*;
(
    input  wire logic                     clk_i,        // clock
    input  wire logic                     rst_ni,       // reset, asynchronous
    input  wire logic                     start_i,      // strobe: read an instruction
    input  wire source_e                  source_i,     // with start_i: source of the instruction
    input  wire logic    [  BLOCK_BITS:0] size_i,       // with start_i: bytes that the host has written
    input  wire logic                     copy_i,       // strobe: copy an instruction
    input  wire logic                     inner_i,      // 1: copy only the embedded block
    output logic                          busy_o,       // 1: from the cycle after the start to done_o
    output logic                          done_o,       // strobe: the instruction is read or copied
    output block_t                        block_o,      // instruction; valid from done_o on
    // source of the instruction
    output logic         [BLOCK_BITS-1:0] addr_o,       // byte number, 0 = header
    input  wire logic    [           7:0] data_i,       // byte at addr_o, two cycles later
    // destination of the copy
    output logic                          copy_we_o,    // strobe: write a byte of the copy
    output logic         [           3:0] copy_addr_o,  // byte number, 0 = header; valid with copy_we_o
    output logic         [           7:0] copy_data_o   // byte; valid with copy_we_o
);

  localparam logic [4:0] Bytes = 5'd16;

  logic run_q, copy_q;
  logic [4:0] sent_q, sent_s1_q, at_q;
  logic [1:0] valid_q;
  logic [BLOCK_BITS:0] left_q;  // remaining bytes of the instruction
  logic [3:0] index;
  logic shifted, one_side;
  logic [PARAMS-1:0] par_we;

  // The block embedded in an event setting begins at byte 4.
  assign addr_o = {(copy_q && inner_i) ? 3'(ppmc_pkg::inc(32'(sent_q[4:2]))) : sent_q[4:2], sent_q[1:0]};
  assign busy_o = run_q;
  assign done_o = run_q && at_q == Bytes;
  assign copy_we_o = copy_q && valid_q[1];
  assign copy_addr_o = at_q[3:0];
  assign copy_data_o = data_i;

  // Each parameter is stored at its position in the long form of the instruction. The position parameter of
  // instructions 80 and 81 is stored at the place that it has in instructions 87 and 88.
  assign shifted = (block_o.code == I_INIT && block_o.len == 8'd9 && at_q >= 5'd6) ||
      (block_o.code inside {I_MOVE, I_HALT, I_DECEL} && block_o.len == 8'd6 && at_q >= 5'd4);
  assign index = at_q[3:0] - (shifted ? 4'd1 : 4'd3);

  // one_side: an initial setting describes only one ramp, for acceleration and deceleration. The stop rate is
  // then equal to the start-up rate, and the deceleration pulses are equal to the acceleration pulses.
  assign one_side = block_o.code == I_INIT && !block_o.par[0][4];

  always_comb begin
    for (int unsigned n = 0; n < PARAMS; n++) par_we[n] = index == 4'(n);
    if (one_side) begin
      par_we[4:3]   = par_we[2:1];
      par_we[12:10] = par_we[9:7];
    end
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      run_q   <= 1'b0;
      copy_q  <= 1'b0;
      sent_q  <= '0;
      valid_q <= '0;
    end else if (start_i || copy_i) begin
      run_q   <= 1'b1;
      copy_q  <= copy_i;
      sent_q  <= '0;
      valid_q <= '0;
    end else begin
      valid_q <= {valid_q[0], run_q && sent_q != Bytes};
      if (run_q && sent_q != Bytes) sent_q <= 5'(ppmc_pkg::inc(32'(sent_q)));
      if (done_o) begin
        run_q  <= 1'b0;
        copy_q <= 1'b0;
      end
    end
  end

  // at_q is the number of the byte on data_i, which was requested two cycles before.
  always_ff @(posedge clk_i) begin
    if (start_i || copy_i) {at_q, sent_s1_q} <= '0;
    else {at_q, sent_s1_q} <= {sent_s1_q, sent_q};
  end

  // The length byte of a stored instruction was checked before, so it determines the number of bytes.
  always_ff @(posedge clk_i) begin
    if (start_i) left_q <= (source_i == SrcHost) ? size_i : 6'd2;
    else if (valid_q[1]) begin
      if (at_q == 5'd1 && block_o.source != SrcHost) left_q <= data_i[BLOCK_BITS:0];
      else if (left_q != '0) left_q <= 6'(ppmc_pkg::dec(32'(left_q)));
    end
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) block_o <= '0;
    else if (start_i) block_o <= '{source: source_i, size: size_i, default: '0};
    else if (valid_q[1] && !copy_q) begin
      if (left_q != '0 || at_q < 5'd2) begin
        unique case (at_q)
          5'd0:    block_o.head <= data_i;
          5'd1:    block_o.len <= (left_q == '0) ? 8'd0 : data_i;
          5'd2:    block_o.code <= data_i;
          default: for (int unsigned n = 0; n < PARAMS; n++) if (par_we[n]) block_o.par[n] <= data_i;
        endcase
      end
    end
  end

endmodule

`default_nettype wire
