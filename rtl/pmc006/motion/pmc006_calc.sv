// SPDX-License-Identifier: Apache-2.0
// pmc006_calc: sequential processor of the motion planner. Contains one adder, a small memory, and the
//         program in pmc006_calc_rom (source: pmc006_calc.asm). The adder multiplies and divides one bit per
//         cycle.
// Rules:  P006-MOT-10..23, P006-EXC-20..23; docs/pmc006/README.md, 6.1.
// Timing: an instruction takes 2 cycles without an operand, 3 cycles with an operand, n + 2 cycles with n
//         steps. A run ends within 785 cycles of plan_i, and within 590 cycles of advance_i. plan_i aborts
//         a run in progress: a motion can be halted, and the next motion started, during a run. The aborted
//         run does not load V in the cycle of plan_i or later.
// Assumes: advance_i is low while busy_o is high (two update ticks are at least 800 cycles apart).
`include "ppmc_assert.svh"
`default_nettype none

module pmc006_calc
  import pmc006_calc_pkg::*;
(
    input  wire logic        clk_i,
    input  wire logic        rst_ni,
    input  wire logic        plan_i,          // strobe: start the run that plans a motion
    input  wire logic        advance_i,       // strobe: start the run of an update tick
    output logic             busy_o,          // 1: a run is in progress
    // motion; all except left_i are stable while busy_o is high
    input  wire logic        short_i,         // 1: short move (at most 255 steps)
    input  wire logic        speed_i,         // 1: speed run
    input  wire logic        stop_i,          // 1: stop requested
    input  wire logic        analog_i,        // 1: the target speed is analog
    input  wire logic [ 2:0] acc_i,           // acceleration coefficient, sampled with plan_i
    input  wire logic [ 2:0] dec_i,           // deceleration coefficient, sampled with plan_i
    input  wire logic [13:0] v_i,             // current speed V
    input  wire logic [11:0] ve_i,            // register VSTOP
    input  wire logic [30:0] left_i,          // remaining steps R; stable until 6 cycles after the strobe
    input  wire logic [ 7:0] mstep_i,         // microsteps per full step: 1, 2, 4, .. 128
    // sampled settings; stable while busy_o is high
    input  wire logic [13:0] vmax_i,          // register VMAX
    input  wire logic [ 9:0] adc_i,           // sample h of the analog speed input
    input  wire logic [ 7:0] base_i,          // base code RB of the current
    input  wire logic [10:0] ccomp_i,         // register CCOMP
    input  wire logic [10:0] scomp_i,         // register SCOMP
    // results
    output phase_e           phase_o,         // phase of the motion
    output logic      [13:0] next_v_o,        // Vn, next value of V
    output logic             load_v_o,        // strobe: load V with Vn
    output logic      [10:0] current_comp_o,  // Bn, next value of B
    output logic      [ 6:0] lead_angle_o     // Wn, next value of W
);


  instr_t instr, ir_q;  // instr: fetched instruction; ir_q: register that stores instr for its execution
  logic run_q, read_q, no_operand, exec_q, fetch, last, done, taken;
  logic [8:0] pc_q, pc_d;
  logic [4:0] steps_left_q, steps;
  logic plan_q, up_q, smooth_q, carry_q, zero, load_v_q;
  logic [2:0] acc_q, dec_q;

  logic [31:0] hi_q, lo_q, operand_q, a, b;
  logic [31:0] word, register;
  logic [32:0] sum;
  logic mul, div, root, shift_only;
  logic [2:0] coefficient;

  // ---- sequence -------------------------------------------------------------------------------------------

  assign busy_o = run_q;
  assign last = exec_q && steps_left_q == '0;
  assign done = last && run_q;
  assign fetch = plan_i || advance_i || done;
  assign no_operand = instr.op[3] || instr.op[1:0] == '0;  // the instruction has no operand

  always_comb begin
    unique case (cond_e'(ir_q.aux))
      CondAlways:   taken = 1'b1;
      CondCarry:    taken = carry_q;
      CondNotCarry: taken = !carry_q;
      CondZero:     taken = zero;
      CondShort:    taken = short_i;
      CondSpeed:    taken = speed_i;
      CondStop:     taken = stop_i && speed_i;
      CondAnalog:   taken = analog_i;
      CondPlan:     taken = plan_q;
      CondEnding:   taken = phase_o[1:0] == PhEnd[1:0];
      CondRamp:     taken = phase_o[2];
      CondLive:     taken = phase_o[1:0] == PhCruise[1:0] && !short_i;
      CondUp:       taken = up_q;
      CondSmooth:   taken = smooth_q;
      CondAcc5:     taken = acc_q == 3'd5;
      CondDec5:     taken = dec_q == 3'd5;
      default:      taken = 1'b0;
    endcase
    if (plan_i) pc_d = ENTRY_PLAN;
    else if (advance_i) pc_d = ENTRY_TICK;
    else if (ir_q.op == OpJump && taken) pc_d = ir_q.low;
    else pc_d = pc_q + 1'b1;
    unique case (ir_q.op)
      OpMul: begin
        unique case (mul_steps_e'(ir_q.aux))
          Steps1:  steps = 5'd0;
          Steps2:  steps = 5'd1;
          Steps16: steps = 5'd15;
          default: steps = 5'd31;
        endcase
      end
      OpDiv, OpRoot: steps = 5'd31;
      default:       steps = 5'd0;
    endcase
  end

  pmc006_calc_rom u_rom (
      .clk_i,
      .fetch_i(fetch),
      .addr_i (pc_d),
      .code_o (instr)
  );

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) run_q <= 1'b0;
    else if (plan_i || advance_i) run_q <= 1'b1;
    else if (done && ir_q.op == OpHalt) run_q <= 1'b0;
  end

  // No reset: plan_i and advance_i start a run, which sets these registers before use.
  always_ff @(posedge clk_i) begin
    if (fetch) pc_q <= pc_d;
    ir_q   <= instr;
    read_q <= fetch;
    exec_q <= !fetch && run_q && (!read_q || no_operand);
    if (read_q) steps_left_q <= '0;
    else if (!exec_q) steps_left_q <= steps;
    else steps_left_q <= steps_left_q - 1'b1;
  end

  // ---- operands -------------------------------------------------------------------------------------------

  assign coefficient = (instr.low[3] ? instr.aux[0] : !up_q) ? dec_q : acc_q;

  // The output of the memory is 0 if the operand is a register.
  pmc006_calc_words u_words (
      .clk_i,
      .we_i(done && ir_q.op == OpStore),
      .waddr_i(ir_q.low[3:0]),
      .data_i(hi_q),
      .raddr_i({instr.low[6:3], instr.low[5] ? coefficient : instr.low[2:0]}),
      .word_o(word)
  );

  always_comb begin
    unique case (ir_q.low[3:0])
      RV[3:0]:      register = 32'(v_i);
      RVe[3:0]:     register = 32'(ve_i);
      RLeft[3:0]:   register = 32'(left_i);
      RVmax[3:0]:   register = 32'(vmax_i);
      RAdc[3:0]:    register = 32'({adc_i, 6'd0});
      RAdc9[3:0]:   register = 32'({adc_i[9], 6'd0});
      RBase[3:0]:   register = 32'(base_i);
      RCcomp[3:0]:  register = 32'(ccomp_i);
      RScomp[3:0]:  register = 32'(scomp_i);
      RMstep[3:0]:  register = 32'(mstep_i);
      RLo[3:0]:     register = lo_q;
      RMid[3:0]:    register = {hi_q[15:0], lo_q[31:16]};
      RMargin[3:0]: register = 32'({1'b1, hi_q[13:12]});
      RRoot[3:0]:   register = 32'({next_v_o, 2'b01});
      default:      register = '0;
    endcase
  end

  always_ff @(posedge clk_i) operand_q <= word | (ir_q.low[6] ? register : '0);

  // ---- adder ----------------------------------------------------------------------------------------------

  assign mul = ir_q.op == OpMul;
  assign root = ir_q.op == OpRoot;
  assign div = ir_q.op == OpDiv || root;
  assign shift_only = root && steps_left_q[0];  // one bit of the root consumes two bits of the radicand
  assign zero = hi_q == '0;

  always_comb begin
    a   = div ? {hi_q[30:0], lo_q[31]} : (ir_q.op == OpLoad) ? '0 : hi_q;
    b   = (div || ir_q.op == OpSub) ? ~operand_q : (mul && !lo_q[0]) ? '0 : operand_q;
    sum = {1'b0, a} + {1'b0, b} + 33'(div || ir_q.op == OpSub);
  end

  always_ff @(posedge clk_i) begin
    if (exec_q) begin
      unique case (ir_q.op)
        OpLoad, OpAdd, OpSub: begin
          if (ir_q.aux[1]) {hi_q, lo_q} <= {32'd0, sum[31:0]};
          else hi_q <= sum[31:0];
          carry_q <= sum[32];
        end
        OpMul:   {hi_q, lo_q} <= {sum, lo_q[31:1]};
        OpDiv, OpRoot: begin
          hi_q <= (sum[32] && !shift_only) ? sum[31:0] : a;
          lo_q <= {lo_q[30:0], sum[32]};
        end
        default: ;
      endcase
    end
  end

  // ---- results --------------------------------------------------------------------------------------------

  assign load_v_o = load_v_q && !plan_i;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      plan_q   <= 1'b0;
      phase_o  <= PhCruise;
      load_v_q <= 1'b0;
    end else begin
      load_v_q <= done && !plan_i && ir_q.op == OpOut && output_sel_e'(ir_q.aux) == OutSpeed;
      if (plan_i || advance_i) plan_q <= plan_i;
      if (done && ir_q.op == OpSet) begin
        if (ir_q.aux[3]) phase_o <= phase_e'({1'b0, phase_o[1:0]});
        else if (ir_q.aux[2]) phase_o <= phase_e'(ir_q.low[4:2]);
      end
    end
  end

  always_ff @(posedge clk_i) begin
    if (done && ir_q.op == OpOut) begin
      unique case (output_sel_e'(ir_q.aux))
        OutNext, OutSpeed: next_v_o <= hi_q[13:0];
        OutCurrentComp:    current_comp_o <= hi_q[16:6];
        OutLeadAngle:      lead_angle_o <= (hi_q[8:6] != '0) ? 7'd64 : 7'(hi_q[5:0]);
        OutAcc:            acc_q <= acc_q + 1'b1;
        OutDec:            dec_q <= dec_q + 1'b1;
        default:           ;
      endcase
    end else if (exec_q && root && !steps_left_q[0]) next_v_o <= {next_v_o[12:0], sum[32]};
    if (done && ir_q.op == OpSet) begin
      if (ir_q.aux[1]) up_q <= ir_q.low[1];
      if (ir_q.aux[0]) smooth_q <= ir_q.low[0];
    end
    if (plan_i) begin
      acc_q    <= acc_i;
      dec_q    <= dec_i;
      up_q     <= 1'b1;
      smooth_q <= 1'b1;
    end
  end

`ifndef SYNTHESIS
  `PPMC_ASSERT(calc_advance_while_idle, !(advance_i && busy_o))
  `PPMC_ASSERT(calc_coefficients, !busy_o || (acc_q <= 3'd5 && dec_q <= 3'd5))
`endif

endmodule

`default_nettype wire
