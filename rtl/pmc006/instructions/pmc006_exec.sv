// SPDX-License-Identifier: Apache-2.0
// pmc006_exec: executes one instruction at a time. The instruction comes from a frame, from the user
//         program, or (during the boot) from the EEPROM.
// Rules:  P006-FRM-03, P006-CMD-52/53, P006-PRG-15/16, P006-STA-15.
// Timing: an instruction takes effect at the edge that ends the cycle of exec_o. For a frame, this edge is
//         4 cycles after the last sample of the frame if no instruction is in progress, and reply_sample_o
//         is high in the next cycle. For a program instruction, this edge is 5 cycles after the edge that
//         ends the cycle of instr_ack_o.
`include "ppmc_assert.svh"
`default_nettype none

module pmc006_exec
  import pmc006_pkg::*;
(
    input  wire logic          clk_i,
    input  wire logic          rst_ni,
    // frames
    input  wire frame_t        frame_i,         // valid frame from the host
    // user program
    input  wire logic          instr_req_i,     // level: execute the next program instruction
    input  wire logic          cancel_i,        // 1: discard the program instruction in progress
    output logic               instr_ack_o,     // strobe: execution of the program instruction begins
    output logic               claim_o,         // 1: the executor addresses the buffer
    output logic               word1_o,         // 1: address word W1 of the instruction, 0: W0
    output logic               use_pp_o,        // 1: address the instruction at PP
    input  wire logic   [31:0] word_i,          // word of the buffer, two cycles after the address
    // EEPROM
    input  wire logic          load_i,          // strobe: execute or check load_op_i; only during the boot
    input  wire logic   [ 7:0] load_op_i,       // instruction that loads the parameter
    input  wire logic   [15:0] load_data_i,     // data of the parameter
    input  wire logic          store_i,         // with load_i; 1: execute, 0: only check the data
    // instruction in progress
    output exec_cmd_t          cmd_o,           // instruction
    output reg_access_t        access_o,        // register of cmd_o
    output logic               legal_o,         // 1: the data of cmd_o are accepted
    output logic               exec_o,          // strobe: cmd_o is executed
    output logic               set_position_o,  // strobe: set the position
    input  wire logic          step_i,          // 1: a step is counted in this cycle
    input  wire logic          try_accept_i,    // 1: instruction E is accepted; valid with exec_o
    output logic               reply_sample_o   // strobe: sample the reply data
);

  typedef enum logic [2:0] {
    StIdle,
    StFirst,   // outputs the address of W0
    StSecond,  // outputs the address of W1
    StDecode,  // W0 is valid
    StCheck,
    StExec,
    StReply
  } state_e;

  state_e state_q;
  instr_source_e source_q;
  logic frame_pending_q, try_next_q, is_program, set_position;
  logic [7:0] op_d, op_q;
  logic [3:0] option_q;

  assign is_program = source_q == FromProgram || source_q == FromTry;
  // The position is set in a cycle in which no step is counted. For this instruction exec_o stays low,
  // because step_i depends on exec_o: an executed instruction can stop the motor and so suppress the step.
  assign set_position = state_q == StExec && op_q == I_POS_SET;
  assign set_position_o = set_position && !step_i;

  assign exec_o = state_q == StExec && !set_position && !(cancel_i && source_q == FromProgram);
  assign reply_sample_o = state_q == StReply;
  assign instr_ack_o = state_q == StIdle && !frame_pending_q && instr_req_i;
  assign use_pp_o = source_q == FromTry;
  assign word1_o = is_program && state_q != StFirst;
  assign claim_o = source_q != FromBoot && state_q inside {StFirst, StSecond, StDecode, StCheck, StExec};

  always_comb begin
    cmd_o = '{op: op_q, option: option_q, source: source_q, data: frame_i.data};
    if (is_program) cmd_o.data = word_i;
    if (source_q == FromBoot) cmd_o.data = {16'd0, load_data_i};
  end

  assign op_d = (state_q == StDecode) ? program_op(
      word_i[7:0]
  ) : load_i ? load_op_i : frame_i.code[7] ? I_NONE : frame_i.code;

  pmc006_data_check u_data_check (
      .clk_i,
      .read_i   (state_q inside {StIdle, StDecode}),
      .program_i(state_q == StDecode),
      .op_i     (op_d),
      .cmd_i    (cmd_o),
      .access_o,
      .ok_o     (legal_o)
  );

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      state_q  <= StIdle;
      source_q <= FromBoot;
      frame_pending_q    <= 1'b0;
    end else begin
      if (frame_i.go) frame_pending_q <= 1'b1;
      unique case (state_q)
        StIdle:
        if (frame_pending_q) begin
          frame_pending_q    <= 1'b0;
          source_q <= FromFrame;
          state_q  <= StCheck;
        end else if (load_i) begin
          source_q <= FromBoot;
          state_q  <= StCheck;
        end else if (instr_req_i) begin
          source_q <= FromProgram;
          state_q  <= StFirst;
        end
        StFirst:  state_q <= StSecond;
        StSecond: state_q <= StDecode;
        StDecode: state_q <= StCheck;
        StCheck:  state_q <= (source_q == FromBoot && !store_i) ? StIdle : StExec;
        StExec:   if (!set_position || !step_i) state_q <= (source_q == FromFrame) ? StReply : StIdle;
        default: begin  // StReply
          state_q <= StIdle;
          if (try_next_q) begin
            source_q <= FromTry;
            state_q  <= StFirst;
          end
        end
      endcase
      if (cancel_i && source_q == FromProgram && state_q != StIdle) state_q <= StIdle;
    end
  end

  always_ff @(posedge clk_i) begin
    if (state_q inside {StIdle, StDecode}) op_q <= op_d;
    if (state_q == StIdle) option_q <= '0;
    else if (state_q == StDecode) begin
      option_q <= (word_i[15:12] == '0) ? word_i[11:8] : 4'hf;
    end
    try_next_q <= exec_o && try_accept_i;
  end

`ifndef SYNTHESIS
  `PPMC_ASSERT(p006_sta_15, !(set_position_o && step_i) && !(set_position_o && exec_o))
  `PPMC_ASSERT(p006_frm_07, !(frame_i.go && frame_pending_q))
`endif

endmodule

`default_nettype wire
