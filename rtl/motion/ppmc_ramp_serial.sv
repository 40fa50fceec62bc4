// SPDX-License-Identifier: Apache-2.0
// ppmc_ramp_serial: the bit-serial arithmetic of the ramp builder: six long numbers in one block RAM, a bit
// of each a word.
// Rules:  P104-RMP-02/04 (numerator and denominator of every threshold).
// Timing: a pass over all bits takes Bits + 2 clk from start_i (which may overlap nothing); last_o marks its
//         last clk.
// How:    with U = B*PA - (A-B), numerator and denominator of thr(r) = floor(num/den) are quadratic in r, so
//         they follow from additions alone (second differences). Products before that are made one multiplier
//         bit a pass.
//         num = -n, v = first difference of n, u = U, den = d, e = first difference of d, g = A-B.
`default_nettype none

module ppmc_ramp_serial
  import ppmc_ramp_pkg::*;
#(
    parameter int unsigned Bits     = 48,
    parameter int unsigned StepBits = 14   // bits of steps_i
) (
    input  wire logic                 clk_i,
    input  wire logic                 rst_ni,
    input  wire logic                 start_i,  // begin a pass
    input  wire pass_e                pass_i,   // which; steady during the pass
    input  wire logic                 mul_i,    // multiplier bit of a PassMulBit; steady during the pass
    input  wire logic  [StepBits-1:0] steps_i,  // PA
    output logic                      valid_o,  // bit_o is a bit of the result, LSB first
    output logic                      num_o,    // bit of the new -num
    output logic                      den_o,    // bit of den
    output logic                      last_o    // the pass ends with this clk
);

  localparam int unsigned AddrBits = ppmc_pkg::cnt_width(Bits - 1);
  localparam int unsigned CountBits = AddrBits + 1;  // top bit: leading zeros

  typedef struct packed {logic n, v, u, d, e, g;} word_t;

  word_t rd, wr;
  logic run_q, read_q, use_q, first_q, lead_q, we;
  logic [CountBits-1:0] bit_q, last_bit;
  logic [CountBits-1:0] read_bit_q;
  logic [ AddrBits-1:0] at_q;

  ppmc_ram #(
      .Width   ($bits(word_t)),
      .AddrBits(AddrBits)
  ) u_scratch (
      .clk_i,
      .we_i   (we),
      .waddr_i(at_q),
      .wdata_i(wr),
      .raddr_i(bit_q[AddrBits-1:0]),
      .rdata_o(rd)
  );

  // den comes out behind StepBits - 1 leading zeros, that is shifted to the left; its own top bits are zeros and
  // stay behind.
  assign last_bit = (pass_i == PassRead) ? CountBits'(Bits - StepBits) : CountBits'(Bits - 1);

  // Address, RAM, use: three stages.
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      run_q   <= 1'b0;
      read_q  <= 1'b0;
      use_q   <= 1'b0;
      first_q <= 1'b0;
      lead_q  <= 1'b0;
      bit_q   <= '0;
      at_q    <= '0;
      read_bit_q <= '0;
    end else begin
      if (start_i) begin
        run_q <= 1'b1;
        bit_q <= (pass_i == PassRead) ? CountBits'(0) - CountBits'(StepBits - 1) : '0;
      end else begin
        if (bit_q == last_bit) run_q <= 1'b0;
        bit_q <= bit_q + 1'b1;
      end
      {use_q, read_q} <= {read_q, run_q};
      read_bit_q      <= bit_q;
      first_q         <= read_bit_q == '0;
      lead_q          <= read_bit_q[CountBits-1];
      at_q            <= read_bit_q[AddrBits-1:0];
    end
  end

  assign last_o  = use_q && !read_q;
  assign valid_o = use_q;
  assign we      = use_q && pass_i != PassRead;

  // Serial adders: sum and carry a bit; the carry starts as 1 where the second operand is inverted.
  logic cn_q, cv_q, cu_q, cd_q, ce_q;  // carries
  logic cn, cv, cu, cd, ce;
  logic [1:0] n_q;  // delayed bits: times 2, 4
  logic v_q, e_q;
  logic [2:0] u_q, g_q;  // times 2, 4, 8
  logic final_pass, an, bn, av, bv, ad, bd, ae, be;
  logic sum_n, sum_v, sum_u, sum_d, sum_e, u_new, g_new;

  logic [15:0] steps;
  assign steps = 16'(steps_i);

  function automatic logic maj(logic x, logic y, logic z);
    return (x & y) | (x & z) | (y & z);
  endfunction

  always_comb begin
    final_pass = pass_i == PassFinal;
    cn = first_q ? final_pass : cn_q;
    cv = !first_q && cv_q;
    cu = first_q || cu_q;
    cd = first_q ? final_pass : cd_q;
    ce = !first_q && ce_q;

    ad = rd.d;
    bd = final_pass ? !rd.g : rd.e;
    sum_d = ad ^ bd ^ cd;
    sum_u = rd.u ^ !sum_d ^ cu;  // used in the final pass only
    u_new = final_pass ? sum_u : rd.u;
    g_new = final_pass ? sum_d : rd.g;
    an = final_pass ? sum_u : rd.n;
    bn = final_pass ? !n_q[1] : rd.v;
    sum_n = an ^ bn ^ cn;

    av = (pass_i == PassMulBit) ? v_q : (pass_i == PassStep) && rd.v;
    bv = (pass_i == PassMulBit) ? rd.n && mul_i : u_q[2];
    ae = (pass_i == PassMulBit) ? e_q : (pass_i == PassStep) && rd.e;
    be = (pass_i == PassMulBit) ? rd.d && mul_i : g_q[2];
    sum_v = av ^ bv ^ cv;
    sum_e = ae ^ be ^ ce;
  end

  // What each kind of pass writes back.
  always_comb begin
    wr = rd;
    unique case (pass_i)
      PassInit: begin
        wr.n = at_q[AddrBits-1:4] == '0 && steps[at_q[3:0]];
        wr.d = first_q;
        wr.v = 1'b0;
        wr.e = 1'b0;
      end
      PassMulBit: begin
        wr.v = sum_v;
        wr.e = sum_e;
      end
      PassMulEnd: begin
        wr.n = sum_n;
        wr.d = sum_d;
        wr.v = 1'b0;
        wr.e = 1'b0;
      end
      PassSave: begin
        wr.u = rd.n;
        wr.g = rd.d;
        wr.d = first_q;
      end
      PassFinal, PassStep: wr = '{n: sum_n, v: sum_v, u: u_new, d: sum_d, e: sum_e, g: g_new};
      default: ;
    endcase
  end

  assign num_o = sum_n;
  assign den_o = rd.d && !lead_q;  // no pass writes what the zeros' addresses hold

  // Delay lines are emptied between passes, when use_q is low.
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {cn_q, cv_q, cu_q, cd_q, ce_q} <= '0;
      {n_q, v_q, e_q, u_q, g_q}      <= '0;
    end else begin
      cn_q <= maj(an, bn, cn);
      cv_q <= maj(av, bv, cv);
      cu_q <= maj(rd.u, !sum_d, cu);
      cd_q <= maj(ad, bd, cd);
      ce_q <= maj(ae, be, ce);
      n_q  <= use_q ? {n_q[0], rd.n} : '0;
      v_q  <= use_q && rd.v;
      e_q  <= use_q && rd.e;
      u_q  <= use_q ? {u_q[1:0], u_new} : '0;
      g_q  <= use_q ? {g_q[1:0], g_new} : '0;
    end
  end

endmodule

`default_nettype wire
