// SPDX-License-Identifier: Apache-2.0
// pmc006_exec_fv: proves that every frame is executed once, in time, and has one reply, and that every
// instruction of the program or of the EEPROM that begins is executed once or canceled.
`include "ppmc_fv.svh"
`default_nettype none

module pmc006_exec_fv
  import pmc006_pkg::*;
(
    input wire logic          clk_i,
    input wire frame_t        frame_i,
    input wire logic          instr_req_i,
    input wire logic          cancel_i,
    input wire logic   [31:0] word_i,
    input wire logic          load_i,
    input wire logic   [ 7:0] load_op_i,
    input wire logic   [15:0] load_data_i,
    input wire logic          store_i,
    input wire logic          step_i,
    input wire logic          try_accept_i
);

  exec_cmd_t   cmd_o;
  reg_access_t access_o;
  logic instr_ack_o, claim_o, word1_o, use_pp_o, legal_o, exec_o, set_position_o, reply_sample_o;

  `FV_RESET

  pmc006_exec dut (.*);

  // Cycles since the frame, the acknowledgement or the load; 0: none in progress. A frame is in progress
  // until its reply, and then, if it is an accepted E, until its instruction is executed.
  logic [3:0] frame_q, program_q, try_q, load_q;
  logic executed, frame_executed_q, stored_q;

  assign executed = exec_o || set_position_o;

  always_ff @(posedge clk_i)
    if (!rst_ni) {frame_q, program_q, try_q, load_q, frame_executed_q} <= '0;
    else begin
      frame_executed_q <= executed && cmd_o.source == FromFrame;
      if (frame_i.go || (frame_q != '0 && !reply_sample_o)) frame_q <= frame_q + 1'b1;
      else frame_q <= '0;
      if (instr_ack_o) program_q <= 4'd1;
      else if (program_q != '0)
        program_q <= ((executed && cmd_o.source == FromProgram) || cancel_i) ? '0 : program_q + 1'b1;
      if (exec_o && try_accept_i) try_q <= 4'd1;
      else if (try_q != '0) try_q <= (executed && cmd_o.source == FromTry) ? '0 : try_q + 1'b1;
      if (load_i) {load_q, stored_q} <= {4'd1, store_i};
      else if (load_q != '0) load_q <= (load_q == 4'd2 || (load_q == 4'd1 && !stored_q)) ? '0 : load_q + 1'b1;
    end

  `FV_ASSUME(frames_apart, !frame_i.go || (frame_q == '0 && try_q == '0))
  `FV_ASSUME(frame_stable, frame_q == '0 || {frame_i.code, frame_i.data} == $past
             ({frame_i.code, frame_i.data}))
  `FV_ASSUME(steps_apart, !(step_i && $past(step_i)))
  // verilog_format: off
  `FV_ASSUME(
      load_in_boot,
      !load_i || !(frame_i.go || frame_q != '0 || try_q != '0 || program_q != '0 || instr_req_i
          || load_q != '0))
  // verilog_format: on
  `FV_ASSUME(boot_without_frames, load_q == '0 || !(frame_i.go || instr_req_i))
  `FV_ASSUME(store_stable, load_q == '0 || store_i == stored_q)
  `FV_ASSUME(try_of_a_frame, !try_accept_i || (exec_o && cmd_o.source == FromFrame && cmd_o.op == I_TRY))
  `FV_ASSUME(no_position_in_a_program,
             !(dut.state_q == 5 && cmd_o.source != FromFrame) || cmd_o.op != I_POS_SET)

  `FV_ASSERT(frame_in_time, frame_q <= 4'd10)
  `FV_ASSERT(
      frame_once,
      !(executed && cmd_o.source == FromFrame) || (frame_q != '0 && !frame_executed_q && !reply_sample_o))
  // verilog_format: off
  `FV_ASSERT(
      frame_instruction,
      !(executed && cmd_o.source == FromFrame) || (cmd_o.data == frame_i.data && cmd_o.op == (frame_i.code[7]
          ? I_NONE : frame_i.code) && cmd_o.option == '0))
  // verilog_format: on
  `FV_ASSERT(reply, reply_sample_o == frame_executed_q)
  `FV_ASSERT(program_in_time, program_q <= 4'd5)
  `FV_ASSERT(program_once, !(executed && cmd_o.source == FromProgram) || (program_q == 4'd5 && !cancel_i))
  `FV_ASSERT(acknowledge, !instr_ack_o || (instr_req_i && program_q == '0 && try_q == '0))
  `FV_ASSERT(try_in_time, try_q <= 4'd7)
  `FV_ASSERT(try_once, !(executed && cmd_o.source == FromTry) || try_q != '0)
  `FV_ASSERT(load_once, (executed && cmd_o.source == FromBoot) == (load_q == 4'd2))
  `FV_ASSERT(position, !(set_position_o && (step_i || exec_o)))
  `FV_COVER(seen_wait, frame_q == 4'd10 && reply_sample_o)
  `FV_COVER(seen_try, exec_o && cmd_o.source == FromTry && program_q == '0)

endmodule

`default_nettype wire
