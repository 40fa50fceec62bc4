// SPDX-License-Identifier: Apache-2.0
// ppmc312_move: a judged motion or rate change: limits, look-up or plan, then the start or the change.
// Rules:  P312-CMD-82..88, P312-CMD-10/11, P312-INP-11, P312-BLK-01 (8), P312-STA-04.
// Timing: begin_i is followed by done_o, 4 clk later without a look-up (single step). start_o and change_o come
//         with done_o. Rate and number of pulses are kept until t0, whatever is executed meanwhile.
`default_nettype none

module ppmc312_move
  import ppmc312_pkg::*;
  import ppmc312_stage_pkg::*;
(
    input  wire logic           clk_i,
    input  wire logic           rst_ni,
    input  wire logic           begin_i,
    input  wire block_t         block_i,
    input  wire status_e        status_i,
    input  wire table_t         table_i,
    input  wire target_t        home_i,
    input  wire levels_t        levels_i,
    input  wire logic    [15:0] limit_rate_i,
    input  wire logic           gate_i,          // a start is not held
    input  wire logic           open_i,          // the time for it has come
    output logic                done_o,
    output logic                limited_o,       // with done_o: a limit is in the way
    output logic                refused_o,       // with done_o: no longer at rest
    output logic         [ 7:0] kind_o,          // with done_o: status byte of the answer
    // motion
    output logic                start_o,
    output logic                change_o,
    output op_t                 op_o,
    output plan_t               plan_o,
    // planner
    output logic                plan_start_o,
    output logic                plan_ramp_o,
    output logic                plan_endless_o,
    output logic         [15:0] plan_rate_o,
    output logic         [31:0] plan_count_o,
    input  wire logic           plan_busy_i,
    input  wire logic    [ 7:0] plan_kind_i,
    input  wire plan_t          plan_i
);

  typedef enum logic [2:0] {
    StIdle,
    StLimit,
    StPlan,   // the planner is started
    StWait,
    StGo
  } state_e;

  state_e state_q;
  logic starts_q, single_q, limited_q, hit;
  logic [15:0] rate;
  logic [7:0] code;
  info_t info;

  assign code = block_i.code;
  assign info = info_of(code);
  assign rate = {block_i.par[1], block_i.par[2]};
  assign hit = op_o.ccw ? !levels_i.bl_n || (!levels_i.bhl_n && plan_rate_o <= limit_rate_i) :
      !levels_i.fl_n || (!levels_i.fhl_n && plan_rate_o <= limit_rate_i);

  assign done_o = state_q == StGo;
  assign limited_o = starts_q && limited_q;
  assign refused_o = starts_q && !limited_q && status_i != StatusNor;
  assign start_o = done_o && starts_q && !limited_q && status_i == StatusNor;
  assign change_o = done_o && !starts_q;
  assign kind_o = ((code == I_MOVE) ? plan_kind_i : 8'h00) | 8'(!gate_i);
  assign plan_start_o = state_q == StPlan;

  always_comb begin
    plan_o = plan_i;
    if (single_q) begin
      plan_o.climb = 1'b0;
      plan_o.dec   = '0;
      plan_o.to    = home_i;
    end
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) state_q <= StIdle;
    else begin
      unique case (state_q)
        StIdle:  if (begin_i) state_q <= StLimit;
        StLimit: begin
          if (starts_q && hit) state_q <= StGo;
          else if (single_q) state_q <= StWait;
          else state_q <= StPlan;
        end
        StPlan:  state_q <= StWait;
        StWait:  if (!plan_busy_i && (open_i || !starts_q)) state_q <= StGo;
        default: state_q <= StIdle;
      endcase
    end
  end

  // No reset: begin_i sets all of it.
  always_ff @(posedge clk_i) begin
    if (begin_i) begin
      starts_q       <= info.starts;
      single_q       <= code == I_STEP;
      plan_ramp_o    <= code inside {I_MOVE, I_HIGH, I_ZERO};
      plan_endless_o <= !(code inside {I_MOVE, I_CONST, I_STEP});
      plan_count_o   <= {block_i.par[3], block_i.par[4], block_i.par[5], block_i.par[6]};
      plan_rate_o    <= (rate == '0) ? table_i.fast : rate;
      if (code == I_STEP) begin
        plan_count_o <= 32'd1;
        plan_rate_o  <= table_i.rate_acc;
      end
      if (info.starts) begin
        op_o <= '{
            ccw: block_i.par[0][6],
            zero: code == I_ZERO,
            origin: code == I_ORIGIN,
            index: block_i.par[0][4]
        };
      end
    end
    if (state_q == StLimit) limited_q <= hit;
  end

  logic unused_bits;
  assign unused_bits = &{1'b0, block_i, table_i, levels_i, info};

endmodule

`default_nettype wire
