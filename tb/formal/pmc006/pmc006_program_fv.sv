// SPDX-License-Identifier: Apache-2.0
// pmc006_program_fv: proves that the user program executes its instructions in the order that the manual
// states, for any times of frames, keys and conditions.
`include "ppmc_fv.svh"
`default_nettype none

module pmc006_program_fv
  import pmc006_pkg::*;
(
    input wire logic            clk_i,
    input wire logic            autostart_i,
    input wire exec_cmd_t       cmd_i,
    input wire logic            legal_i,
    input wire logic            exec_i,
    input wire logic            instr_ack_i,
    input wire logic            word1_i,
    input wire logic            use_pp_i,
    input wire logic            burning_i,
    input wire logic            us_i,
    input wire logic      [4:0] gpi_i,
    input wire logic      [1:0] flags_i,
    input wire logic            busy_i,
    input wire logic            stall_i
);

  logic instr_req_o, cancel_o, try_accept_o, put_o, accepted_o, stop_o;
  logic [7:0] word_addr_o, pp_o;

  `FV_RESET

  pmc006_program dut (.*);

  // ---- executor -----------------------------------------------------------------------------------

  logic pending_q;  // the executor processes an instruction of the program
  logic from_program, is_program_op, is_program_unit_op;

  assign from_program = cmd_i.source == FromProgram;
  assign is_program_op = cmd_i.op[7];
  assign is_program_unit_op = cmd_i.op inside {I_PUT, I_TRY, I_START, I_GET, I_POINTER, I_OFFLINE};

  always_ff @(posedge clk_i)
    pending_q <= rst_ni && (instr_ack_i || (pending_q && !(exec_i && from_program) && !cancel_o));

  `FV_ASSUME(acknowledges_a_request, !instr_ack_i || (instr_req_o && !exec_i))
  `FV_ASSUME(executes_what_was_requested, !exec_i || (from_program == pending_q && !(pending_q && cancel_o)))
  `FV_ASSUME(codes_of_a_frame, !(exec_i && is_program_op) || cmd_i.source inside {FromProgram, FromTry})
  `FV_ASSUME(codes_of_a_program, !(exec_i && is_program_unit_op) || cmd_i.source inside {FromFrame, FromBoot})
  `FV_ASSUME(
      legal_line,
      !(exec_i && legal_i && cmd_i.op inside {P_JMP, P_JNE, P_JEQ, P_RESET_EN}) || cmd_i.data <= 32'd99)
  `FV_ASSUME(legal_option,
             !(exec_i && legal_i && cmd_i.op inside {P_WAIT, P_CMP}) || cmd_i.option inside {[4'd1 : 4'd9]})
  `FV_ASSUME(legal_pointer, !(exec_i && legal_i && cmd_i.op == I_POINTER) || cmd_i.data <= 32'd199)
  `FV_ASSUME(starts_after_boot, !autostart_i || (!pending_q && !instr_ack_i))

  // ---- instructions of frames ---------------------------------------------------------------------

  logic run_q, start, put, get, off;
  logic [7:0] pointer_q;

  assign start = exec_i && cmd_i.op == I_START && !run_q && pointer_q < 8'd200;
  assign put   = exec_i && cmd_i.op == I_PUT && !run_q && pointer_q < 8'd200 && !burning_i;
  assign get   = exec_i && cmd_i.op == I_GET && pointer_q < 8'd200;
  assign off   = exec_i && legal_i && cmd_i.op == I_OFFLINE && !cmd_i.data[0];

  always_ff @(posedge clk_i)
    if (!rst_ni) pointer_q <= '0;
    else if (exec_i && legal_i && cmd_i.op == I_POINTER) pointer_q <= cmd_i.data[7:0];
    else pointer_q <= pointer_q + 8'(put || get);

  `FV_ASSERT(pointer, pp_o == pointer_q && pointer_q <= 8'd200)
  `FV_ASSERT(accepts_put, put_o == put)
  `FV_ASSERT(accepts_try, try_accept_o == (exec_i && cmd_i.op == I_TRY && !run_q && pointer_q < 8'd200))
  `FV_ASSERT(accepts, accepted_o == (put || get || start || try_accept_o))
  `FV_ASSERT(address_of_pointer, from_program || word_addr_o == (use_pp_i ? {pp_o[7:1], word1_i} : pp_o))

  // ---- instructions of the program ----------------------------------------------------------------

  logic wait_q, key_q, paused_q;  // WAIT in progress, held by the RESET key, paused; valid with run_q
  logic reset_on_q, pause_on_q;  // the key is enabled
  logic equal_q, met, taken, next, key_hit;
  logic [31:0] counter_q;
  logic [6:0] line_q, target_q;
  logic [ 5:0] age_q;  // cycles since the last instruction began, at most 48
  logic [ 4:0] wait_option_q;  // {level, option}
  logic [15:0] levels;  // [option]: level of the source of WAIT
  logic [31:0] value;  // value that CMP compares

  assign levels = 16'({stall_i, busy_i, flags_i, gpi_i, 1'b0});
  assign met = wait_q ? levels[wait_option_q[3:0]] == wait_option_q[4] :
      levels[cmd_i.option] == cmd_i.data[0];
  assign taken = cmd_i.op == P_JMP || (cmd_i.op == P_JEQ && equal_q) || (cmd_i.op == P_JNE && !equal_q);
  assign key_hit = reset_on_q && dut.reset_hit;

  always_comb begin
    value = 32'(levels[cmd_i.option]);
    if (cmd_i.option == 4'd8) value = counter_q;
    if (cmd_i.option == 4'd9) value = 32'(gpi_i);
    next = run_q && wait_q && !paused_q && met;
    if (exec_i && from_program) begin
      next = !(cmd_i.op == P_WAIT && legal_i && !met) && cmd_i.op != P_END && !taken;
    end
  end

  always_ff @(posedge clk_i) begin
    if (!rst_ni || off) {run_q, wait_q, key_q, paused_q, reset_on_q, pause_on_q} <= '0;
    else if (start || autostart_i) begin
      {run_q, wait_q, key_q, paused_q, reset_on_q, pause_on_q} <= 6'b100000;
      line_q <= autostart_i ? 7'd0 : pointer_q[7:1];
    end else if (key_hit && run_q) begin
      {wait_q, key_q, paused_q} <= 3'b010;
      line_q <= target_q;
    end else begin
      if (run_q && !key_q && pause_on_q && dut.pause_hit) paused_q <= !paused_q;
      if (key_q && dut.reset_rearm) key_q <= 1'b0;
      if (next) begin
        {run_q, wait_q} <= {line_q != 7'd99, 1'b0};
        line_q <= line_q + 1'b1;
      end
      if (exec_i && from_program) begin
        if (cmd_i.op == P_END || (taken && !legal_i)) run_q <= 1'b0;
        if (taken) line_q <= cmd_i.data[6:0];
        if (cmd_i.op == P_WAIT && !next) {wait_q, wait_option_q} <= {1'b1, cmd_i.data[0], cmd_i.option};
        if (cmd_i.op == P_RESET_EN && legal_i) {reset_on_q, target_q} <= {cmd_i.option[0], cmd_i.data[6:0]};
        if (cmd_i.op == P_PAUSE_EN && legal_i) pause_on_q <= cmd_i.option[0];
      end
    end
    if (start || autostart_i) {equal_q, counter_q} <= '0;
    else if (exec_i) begin
      if (cmd_i.op == P_CMP) equal_q <= legal_i && cmd_i.data == value;
      if (cmd_i.op == P_CNTI) counter_q <= counter_q + 1'b1;
      if (cmd_i.op == P_CNTC) counter_q <= '0;
    end
    if (!rst_ni || start) age_q <= 6'd48;
    else if (instr_ack_i) age_q <= 6'd1;
    else if (age_q != 6'd48) age_q <= age_q + 1'b1;
  end

  `FV_ASSERT(lemma_run, run_q == (dut.state_q != 0))
  `FV_ASSERT(lemma_held, !run_q || {wait_q, key_q} == {dut.state_q == 2, dut.state_q == 3})
  `FV_ASSERT(lemma_keys, {reset_on_q, pause_on_q} == {dut.rsten_q, dut.pauen_q})
  `FV_ASSERT(lemma_paused, !run_q || paused_q == dut.paused_q)
  `FV_ASSERT(lemma_line, !run_q || dut.line_q == line_q)
  `FV_ASSERT(lemma_registers, !run_q || {dut.flag_q, dut.count_q} == {equal_q, counter_q})
  `FV_ASSERT(lemma_target, !reset_on_q || dut.target_q == target_q)
  `FV_ASSERT(lemma_wait, !(run_q && wait_q) || {dut.wait_level_q, dut.option_q} == wait_option_q)
  `FV_ASSERT(lemma_age, dut.instr_left_q == 6'd48 - age_q)
  `FV_ASSERT(pending_in_a_running_program, !pending_q || (run_q && !wait_q && !key_q))

  `FV_ASSERT(requests, instr_req_o == (run_q && !wait_q && !key_q && !paused_q && age_q == 6'd48 && !key_hit))
  `FV_ASSERT(line_of_the_program, !(run_q && from_program) || word_addr_o == {line_q, word1_i})
  `FV_ASSERT(existing_line, !run_q || line_q <= 7'd99)
  `FV_ASSERT(key_stops, stop_o == key_hit && cancel_o == (key_hit && run_q))
  `FV_COVER(seen_end, !run_q && $past
            (rst_ni && run_q && exec_i && line_q == 7'd99 && !taken && cmd_i.op == P_CMP))
  `FV_COVER(seen_wait, next && wait_q && levels[wait_option_q[3:0]] && wait_option_q[3:0] == 4'd9)
  `FV_COVER(seen_key, run_q && $past(key_q) && !key_q && line_q == 7'd50)
  `FV_COVER(seen_pause, run_q && paused_q)

endmodule

`default_nettype wire
