// SPDX-License-Identifier: Apache-2.0
// ppmc_ramp_serial: bit-serial arithmetic of the ramp builder. One block RAM stores three long numbers;
//         each word has one bit of each number.
// Rules:  P104-RMP-02/04 (numerator and denominator of every threshold).
// Timing: a pass begins in the cycle after start_i. A pass over w words takes w + 2 cycles. last_o marks its
//         last cycle, in which the next pass may be started. PassOutput outputs one bit per cycle from its
//         third to its last cycle (use_o = 1).
// How:    n is the numerator, u is the number that is subtracted between the divisions, and v is a product,
//         quotient or difference. Bit i is stored in word i. A quotient follows its dividend by two cycles
//         and is written two words lower, so its lowest bits are stored in the last two words of the RAM. In
//         these two words, u is always 0.
`default_nettype none

module ppmc_ramp_serial
  import ppmc_ramp_pkg::*;
#(
    parameter  int unsigned StepBits = 14,           // bits of PA
    parameter  int unsigned RateBits = 8,
    localparam int unsigned Width    = RateBits + 1
) (
    input  wire logic              clk_i,
    input  wire logic              rst_ni,
    input  wire logic              start_i,   // strobe: begin a pass
    input  wire pass_e             next_i,    // next pass; valid with start_i
    input  wire pass_e             pass_i,    // current pass: next_i, from the cycle after start_i on
    input  wire logic              mul_i,     // multiplier bit of PassMulBit; stable during the pass
    input  wire logic              keep_i,    // 1: PassMulEnd also sets u; stable during the pass
    input  wire logic              init_i,    // bit of PassInit, in the order and timing of bit_o
    input  wire logic  [Width-1:0] first_i,   // first divisor of a division, minus 1
    input  wire logic  [Width-1:0] second_i,  // divisor of the first quotient, minus 1
    output logic                   bit_o,     // bit of PassOutput; the lowest bit is first
    output logic                   use_o,     // 1: bit_o is valid, and init_i is used
    output logic                   last_o     // strobe: last cycle of the pass
);

  localparam int unsigned DivideBits = StepBits + 2 * RateBits;  // bits of v at the subtraction of u
  localparam int unsigned Bits = DivideBits + 2 * Width;  // bits of n
  localparam int unsigned AddrBits = ppmc_pkg::cnt_width(Bits + 10);

  typedef logic [AddrBits-1:0] addr_t;
  typedef struct packed {logic n, v, u;} serial_word_t;

  // First and last word of each pass. Divisions count the words down.
  function automatic addr_t first_word(pass_e pass);
    unique case (pass)
      PassDivideSquare: return addr_t'(Bits - 1);
      PassDivide:  return addr_t'(DivideBits - 1);
      PassSubtract:   return -addr_t'(2);
      PassOutput:   return -addr_t'(2);
      default:    return '0;
    endcase
  endfunction

  function automatic addr_t last_word(pass_e pass);
    unique case (pass)
      PassDivideSquare, PassDivide: return -addr_t'(2);
      PassSubtract:                 return addr_t'(DivideBits - 1);
      PassOutput:                   return addr_t'(StepBits - 3);
      default:                      return addr_t'(Bits - 1);
    endcase
  endfunction

  serial_word_t rd, wr;
  addr_t read_addr_q, use_addr;  // read_addr_q: word to be read; use_addr: word in use
  addr_t flip, flipped;
  logic down;
  logic run_q, read_q, use_q, second_q;  // pipeline stages: address, RAM, use, second division

  assign down     = pass_i inside {PassDivideSquare, PassDivide};
  assign use_o    = use_q;
  assign last_o   = use_q && !read_q;
  // use_addr is the value of read_addr_q two cycles earlier. Gates compute it from read_addr_q: minus 2 if
  // the pass counts up, plus 2 if it counts down.
  assign flip     = {{(AddrBits - 1) {!down}}, 1'b0};
  assign flipped  = read_addr_q ^ flip;
  assign use_addr = {(AddrBits - 1)'(ppmc_pkg::inc(32'(flipped[AddrBits-1:1]))), flipped[0]} ^ flip;

  ppmc_ram #(
      .Width   ($bits(serial_word_t)),
      .AddrBits(AddrBits)
  ) u_scratch (
      .clk_i,
      .we_i   (use_q),
      .waddr_i(use_addr),
      .wdata_i(wr),
      .raddr_i(read_addr_q),
      .rdata_o(rd)
  );

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {second_q, use_q, read_q, run_q} <= '0;
      read_addr_q <= '0;
    end else begin
      {second_q, use_q, read_q} <= {use_q, read_q, run_q};
      run_q <= start_i || (run_q && read_addr_q != last_word(pass_i));
      read_addr_q <= start_i ? first_word(next_i) : read_addr_q + {{(AddrBits - 1) {down}}, 1'b1};
    end
  end

  // ---- sums: one serial adder ----------------------------------------------------------------------

  logic [1:0] v_q;  // previous two bits of v
  logic carry_q, addend, operand, sum;

  always_comb begin
    unique case (pass_i)
      PassInit:               addend = 1'b0;
      PassMulBit, PassMulOne: addend = v_q[0];  // 2v
      PassSubtract:           addend = v_q[1];  // the difference is stored two words lower
      default:                addend = rd.v;
    endcase
    unique case (pass_i)
      PassMulBit: operand = rd.n && mul_i;
      PassSubtract:   operand = !rd.u;
      PassInit, PassOutput: operand = 1'b0;
      default:    operand = rd.n;
    endcase
    sum = addend ^ operand ^ carry_q;
  end

  // carry_q is set before PassSubtract and PassOutput, and cleared before all other passes.
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      v_q     <= '0;
      carry_q <= 1'b0;
    end else begin
      v_q <= {v_q[0], rd.v && use_q};
      if (use_q) carry_q <= (addend && operand) || (addend && carry_q) || (operand && carry_q);
      else carry_q <= pass_i inside {PassSubtract, PassOutput};
    end
  end

  assign bit_o = sum;

  // ---- two divisions in series ---------------------------------------------------------------------

  logic between, quotient;

  ppmc_ramp_divide #(
      .Width(Width)
  ) u_first (
      .clk_i,
      .run_i(use_q),
      .bit_i((pass_i == PassDivideSquare) ? rd.n : rd.v),
      .divisor_m1_i(first_i),
      .bit_o(between)
  );

  ppmc_ramp_divide #(
      .Width(Width)
  ) u_second (
      .clk_i,
      .run_i(second_q),
      .bit_i(between),
      .divisor_m1_i(second_i),
      .bit_o(quotient)
  );

  // ---- write-back of each pass ---------------------------------------------------------------------

  always_comb begin
    wr   = rd;
    wr.v = sum;
    unique case (pass_i)
      PassInit: wr.n = init_i;  // sum is 0 here, so wr.v = 0
      PassMulEnd: begin
        wr.n = sum;
        wr.v = 1'b0;
        if (keep_i) wr.u = sum;
      end
      PassDivideSquare, PassDivide: wr.v = quotient;
      default: ;
    endcase
  end

endmodule

`default_nettype wire
