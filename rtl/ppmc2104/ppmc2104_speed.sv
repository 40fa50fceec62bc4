// SPDX-License-Identifier: Apache-2.0
// ppmc2104_speed: with Datasheet = 1, checks a rate against the limits of the old chip, which are lower
//         when both axes operate. With Datasheet = 0, there are no limits.
// Rules:  P2104-DS-30..35.
// Timing: error_o follows code_i and params_i by one cycle, but depends combinationally on csel and on the
//         state of the other axis.
`default_nettype none

module ppmc2104_speed
  import ppmc2104_pkg::*;
  import ppmc_op_pkg::*;
#(
    parameter bit Datasheet = 1'b0
) (
    input  wire logic                   clk_i,
    input  wire logic                   rst_ni,
    input  wire logic          [   7:0] code_i,    // code of an operation
    input  wire logic          [  31:0] params_i,  // data bytes of code_i
    input  wire axis_summary_t [AXES:1] state_i,   // states of both axes
    input  wire pin_levels_t   [AXES:1] levels_i,  // inputs of both axes, synchronised
    output cmd_error_e                  error_o    // ErrRateOne, ErrRateTwo or ErrNone
);

  if (!Datasheet) begin : g_fast
    logic unused_bits;

    assign unused_bits = &{1'b0, clk_i, rst_ni, code_i, params_i, state_i, levels_i};
    assign error_o = ErrNone;
  end else begin : g_datasheet

    // Lowest valid rate values for one or two operating axes, with the fast or the slow internal clock.
    typedef struct packed {
      logic [RATE_BITS-1:0] one_axis_fast;
      logic [RATE_BITS-1:0] two_axes_fast;
      logic [RATE_BITS-1:0] one_axis_slow;
      logic [RATE_BITS-1:0] two_axes_slow;
    } min_rates_t;

    localparam min_rates_t MinRatesPout = '{8'h0C, 8'h19, 8'h03, 8'h06};
    localparam min_rates_t MinRatesPhase = '{8'h12, 8'h23, 8'h04, 8'h08};
    localparam min_rates_t MinRatesOrigin = '{8'h14, 8'h25, 8'h05, 8'h09};

    op_code_t op_code;
    axis_summary_t addressed, other;
    min_rates_t min_rates;
    logic [RATE_BITS-1:0] rate;
    logic [3:0] below, below_q;  // below: rate value below the limit; below_q: register that stores below
    logic is_limited, second_q, csel, below_one_axis, below_two_axes, unused_bits;

    assign op_code = op_code_t'(code_i);
    assign addressed = op_code.second ? state_i[2] : state_i[1];
    assign unused_bits = &{1'b0, op_code, params_i, state_i, levels_i, addressed, other};

    always_comb begin
      unique case (op_code.op)
        OP_ACC_DEC, OP_CONT_HIGH: rate = addressed.setup.fast;
        OP_CONSTANT:              rate = params_i[7:0];
        default:                  rate = params_i[31:24];
      endcase
      min_rates = MinRatesPhase;
      if (op_code.pout_only) min_rates = MinRatesPout;
      else if (op_code.op == OP_ORIGIN) min_rates = MinRatesOrigin;
      is_limited = op_code.op != OP_SINGLE && !addressed.setup.external;
      below = {
        rate < min_rates.one_axis_fast,
        rate < min_rates.two_axes_fast,
        rate < min_rates.one_axis_slow,
        rate < min_rates.two_axes_slow
      };
    end

    always_ff @(posedge clk_i or negedge rst_ni) begin
      if (!rst_ni) begin
        below_q  <= '0;
        second_q <= 1'b0;
      end else begin
        below_q  <= below & {4{is_limited}};
        second_q <= op_code.second;
      end
    end

    // An axis that chops at standstill counts as operating.
    always_comb begin
      other = second_q ? state_i[1] : state_i[2];
      csel = second_q ? levels_i[2].csel : levels_i[1].csel;
      below_one_axis = csel ? below_q[3] : below_q[1];
      below_two_axes = csel ? below_q[2] : below_q[0];
      error_o = ErrNone;
      if (below_one_axis) error_o = ErrRateOne;
      else if (below_two_axes && (other.busy || (other.setup.initialised && other.setup.chop)))
        error_o = ErrRateTwo;
    end
  end

endmodule

`default_nettype wire
