// SPDX-License-Identifier: Apache-2.0
// ppmc312_move: executes an instruction that starts a motion or changes the rate, after ppmc312_instr_check
//         has accepted it. First tests the limit switches (only for a start), then the planner looks up the
//         rate and plans the operation, then the motion starts or changes.
// Rules:  P312-CMD-82..88, P312-CMD-10/11, P312-INP-11, P312-BLK-01 (check 8), P312-STA-04.
// Timing: result_o.done follows begin_i by 2 cycles if a limit prevents the start, and by 3 cycles for a
//         single step, which does not use the planner. Otherwise this block waits for the planner. With
//         Datasheet = 1, a start also waits for elapsed_i. start_o or change_o is asserted together with
//         result_o.done. Rate and number of pulses are held until t0, when the motion starts, even if other
//         instructions are executed before t0.
`default_nettype none

module ppmc312_move
  import ppmc312_pkg::*;
  import ppmc312_link_pkg::*;
  import ppmc312_instr_pkg::*;
  import ppmc312_stage_pkg::*;
(
    input wire logic clk_i,  // clock
    input wire logic rst_ni,  // reset, asynchronous
    input wire logic begin_i,  // strobe: begin block_i
    input wire block_t block_i,  // the instruction; stable until result_o.done
    input wire status_e status_i,  // status of the device
    input wire table_t table_i,  // active table
    input wire motor_inputs_t levels_i,  // input pins, filtered
    input wire logic [15:0] limit_rate_i,  // rate limit HSL in base clocks
    input wire logic gate_i,  // 0: the start gate holds a start
    input wire logic elapsed_i,  // the processing time has passed
    output move_status_t result_o,  // result of the move
    // motion
    output logic start_o,  // strobe: start op_o along profile_o
    output logic change_o,  // strobe: change the rate to profile_o.target
    output operation_t op_o,  // operation; valid with start_o
    output profile_t profile_o,  // plan of the operation; stable until t0
    output logic single_pulse_o,  // with start_o; 1: use the start-up rate instead of profile_o.target
    // planner
    output profile_req_t profile_req_o,  // command to the planner
    input wire logic plan_busy_i,  // the planner is busy
    input wire logic [7:0] plan_kind_i,  // status byte of the plan
    input wire profile_t profile_i  // result of the planner
);

  typedef enum logic [2:0] {
    StIdle,
    StLimit,
    StPlan,   // starts the planner
    StWait,
    StGo
  } state_e;

  state_e state_q;
  logic starts_motion_q, single_q, ramp_q, endless_q, limited_q, hit, done;
  logic [15:0] rate, rate_q;
  logic [31:0] count_q;
  logic [7:0] code;
  instr_info_t info;

  assign code = block_i.code;
  assign info = instr_info(code);
  assign rate = {block_i.par[1], block_i.par[2]};
  assign hit = op_o.ccw ? !levels_i.bl_n || (!levels_i.bhl_n && rate_q <= limit_rate_i) :
      !levels_i.fl_n || (!levels_i.fhl_n && rate_q <= limit_rate_i);

  assign done = state_q == StGo;
  assign result_o.done = done;
  assign result_o.at_limit = starts_motion_q && limited_q;
  assign result_o.rejected = starts_motion_q && !limited_q && status_i != StatusNor;
  assign start_o = done && starts_motion_q && !limited_q && status_i == StatusNor;
  assign change_o = done && !starts_motion_q;
  // The planner returns a kind other than 0 only for a move.
  assign result_o.status_byte = plan_kind_i | 8'(!gate_i);
  assign profile_req_o = '{
          start: state_q == StPlan,
          ramp: ramp_q,
          endless: endless_q,
          rate: rate_q,
          count: count_q
      };
  assign single_pulse_o = single_q;

  always_comb begin
    profile_o = profile_i;
    if (single_q) profile_o.starts_with_accel = 1'b0;
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) state_q <= StIdle;
    else begin
      unique case (state_q)
        StIdle:  if (begin_i) state_q <= StLimit;
        StLimit: begin
          if (starts_motion_q && hit) state_q <= StGo;
          else if (single_q) state_q <= StWait;
          else state_q <= StPlan;
        end
        StPlan:  state_q <= StWait;
        StWait:  if (!plan_busy_i && (elapsed_i || !starts_motion_q)) state_q <= StGo;
        default: state_q <= StIdle;
      endcase
    end
  end

  // No reset: begin_i sets all these registers.
  always_ff @(posedge clk_i) begin
    if (begin_i) begin
      starts_motion_q  <= info.starts_motion;
      single_q  <= code == I_STEP;
      ramp_q    <= code inside {I_MOVE, I_HIGH, I_ZERO};
      endless_q <= !(code inside {I_MOVE, I_CONST, I_STEP});
      count_q   <= {block_i.par[3], block_i.par[4], block_i.par[5], block_i.par[6]};
      rate_q    <= (rate == '0) ? table_i.high_rate : rate;
      if (code == I_STEP) begin
        count_q[0] <= 1'b1;  // this instruction has no number of pulses, so all other bits are 0
        rate_q     <= table_i.rate_acc;
      end
      if (info.starts_motion) begin
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
