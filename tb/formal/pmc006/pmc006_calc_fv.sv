// SPDX-License-Identifier: Apache-2.0
// pmc006_calc_fv: proves the duration and the order of the instructions of any program, and that results are
// only those of the run that was started last.
`include "ppmc_fv.svh"
`default_nettype none

module pmc006_calc_fv
  import pmc006_calc_pkg::*;
(
    input wire logic        clk_i,
    input wire logic        plan_i,
    input wire logic        advance_i,
    input wire logic        short_i,
    input wire logic        speed_i,
    input wire logic        stop_i,
    input wire logic        analog_i,
    input wire logic [ 2:0] acc_i,
    input wire logic [ 2:0] dec_i,
    input wire logic [13:0] v_i,
    input wire logic [11:0] ve_i,
    input wire logic [30:0] left_i,
    input wire logic [ 7:0] mstep_i,
    input wire logic [13:0] vmax_i,
    input wire logic [ 9:0] adc_i,
    input wire logic [ 7:0] base_i,
    input wire logic [10:0] ccomp_i,
    input wire logic [10:0] scomp_i
);

  logic busy_o, load_v_o;
  phase_e phase_o;
  logic [13:0] next_v_o;
  logic [10:0] current_comp_o;
  logic [6:0] lead_angle_o;

  `FV_RESET

  pmc006_calc dut (.*);

  // Cycles from the fetch of an instruction to the fetch of the next one.
  function automatic logic [5:0] cycles(instr_t instr);
    unique case (instr.op)
      OpLoad, OpAdd, OpSub: return 6'd3;
      OpMul:
      unique case (instr.aux)
        Steps1:  return 6'd3;
        Steps2:  return 6'd4;
        Steps16: return 6'd18;
        default: return 6'd34;
      endcase
      OpDiv, OpRoot: return 6'd34;
      default: return 6'd2;
    endcase
  endfunction

  logic run_q, plan_q, ends, any_start;
  logic [5:0] age_q;  // cycles since the fetch
  logic [8:0] pc_q, pc;
  logic [15:0] conditions;  // [cond_e]
  instr_t instr;

  assign instr = dut.u_rom.code_o;
  assign any_start = plan_i || advance_i;
  assign ends = run_q && age_q == cycles(instr);
  assign conditions = {
    dut.dec_q == 3'd5,
    dut.acc_q == 3'd5,
    dut.smooth_q,
    dut.up_q,
    phase_o[1:0] == 2'd0 && !short_i,
    phase_o[2],
    phase_o[1:0] == 2'd2,
    plan_q,
    analog_i,
    stop_i && speed_i,
    speed_i,
    short_i,
    dut.hi_q == '0,
    !dut.carry_q,
    dut.carry_q,
    1'b1
  };
  assign pc = (instr.op == OpJump && conditions[instr.aux]) ? instr.low : pc_q + 1'b1;

  always_ff @(posedge clk_i) begin
    if (!rst_ni) {run_q, plan_q} <= '0;
    else if (any_start) {run_q, plan_q} <= {1'b1, plan_i};
    else if (ends && instr.op == OpHalt) run_q <= 1'b0;
    if (any_start || ends) age_q <= 6'd1;
    else age_q <= age_q + 1'b1;
    if (any_start) pc_q <= plan_i ? 9'd0 : 9'd1;
    else if (ends) pc_q <= pc;
  end

  `FV_ASSERT(lemma_age, !run_q || age_q inside {[6'd1 : cycles(instr)]})
  `FV_ASSERT(lemma_read, !run_q || dut.read_q == (age_q == 6'd1))
  `FV_ASSERT(lemma_instruction, !run_q || age_q == 6'd1 || dut.ir_q == instr)
  `FV_ASSERT(lemma_execute, !run_q || dut.exec_q == (age_q >= ((cycles(instr) == 6'd2) ? 6'd2 : 6'd3)))
  `FV_ASSERT(lemma_steps, !(run_q && dut.exec_q) || 6'(dut.steps_left_q) == cycles(instr) - age_q)
  `FV_ASSERT(lemma_plan, !run_q || dut.plan_q == plan_q)

  `FV_ASSERT(lemma_pc, !run_q || dut.pc_q == pc_q)
  `FV_ASSERT(no_start_lost, !$past(rst_ni && any_start) || (busy_o && age_q == 6'd1 && dut.pc_q == ($past
             (plan_i) ? ENTRY_PLAN : ENTRY_TICK)))
  `FV_ASSERT(run, busy_o == run_q)
  `FV_ASSERT(fetch, dut.u_rom.fetch_i == (any_start || ends))
  `FV_ASSERT(address,
             !dut.u_rom.fetch_i || dut.u_rom.addr_i == (plan_i ? ENTRY_PLAN : advance_i ? ENTRY_TICK : pc))

  // Results change only at the end of an instruction that outputs them. V is loaded only by the last run.
  logic out, started_q;
  always_ff @(posedge clk_i) started_q <= rst_ni && run_q;
  assign out = ends && instr.op == OpOut;
  `FV_ASSERT(load, load_v_o == ($past(rst_ni && out && instr.aux == OutSpeed && !plan_i) && !plan_i))
  `FV_ASSERT(next, !started_q || next_v_o == $past(next_v_o) || $past
             (rst_ni && run_q && (instr.op == OpRoot || (out && instr.aux inside {OutNext, OutSpeed}))))
  `FV_ASSERT(current, !started_q || current_comp_o == $past(current_comp_o) || $past
             (out && instr.aux == OutCurrentComp))
  `FV_ASSERT(lead, !started_q || lead_angle_o == $past(lead_angle_o) || $past
             (out && instr.aux == OutLeadAngle))
  `FV_ASSERT(phase, phase_o == $past(phase_o) || $past(!rst_ni || (ends && instr.op == OpSet)))
  `FV_ASSERT(words, dut.u_words.we_i == (ends && instr.op == OpStore))
  `FV_COVER(seen_end, !busy_o && $past(rst_ni && busy_o && plan_q && pc_q == 9'd2))
  `FV_COVER(seen_load, load_v_o && pc_q == 9'd17)

endmodule

`default_nettype wire
