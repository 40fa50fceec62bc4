// SPDX-License-Identifier: Apache-2.0
// pmc006_exec: executes instructions, one at a time: from a frame, from the user program, from the EEPROM at
// boot.
// Rules:  P006-FRM-03, P006-CMD-52/53, P006-PRG-15/16, P006-STA-15.
// Timing: a frame takes effect 4 cycles after its last sample if no instruction is in progress, a program
//         instruction 5 cycles after its start. Both take effect on the edge that ends the cycle of act_o.
//         reply_o follows one cycle later.
`include "ppmc_assert.svh"
`default_nettype none

module pmc006_exec
  import pmc006_pkg::*;
(
    input  wire logic          clk_i,
    input  wire logic          rst_ni,
    // frames
    input  wire frame_t        frame_i,      // instruction of the host
    // user program
    input  wire logic          next_i,       // the next program instruction is scheduled
    input  wire logic          cancel_i,     // discard the program instruction in progress
    output logic               begin_o,      // the program instruction begins
    output logic               claim_o,      // the executor owns the address of the buffer
    output logic               second_o,     // word W1 instead of W0
    output logic               trial_o,      // the address is that of the instruction at PP
    input  wire logic   [31:0] word_i,       // word of the buffer, two cycles after the address
    // EEPROM
    input  wire logic          load_i,       // a parameter is available, during the boot
    input  wire logic   [ 7:0] load_op_i,    // instruction that loads the parameter
    input  wire logic   [15:0] load_data_i,  // data of the parameter
    input  wire logic          store_i,      // 1: execute; 0: only check the data
    // instruction in progress
    output order_t             order_o,      // instruction
    output access_t            access_o,     // register of the instruction
    output logic               legal_o,      // the data of order_o are in range
    output logic               act_o,        // order_o is executed in this cycle
    output logic               place_o,      // the position is set in this cycle
    input  wire logic          step_i,       // a step is counted in this cycle
    input  wire logic          try_i,        // E was accepted
    output logic               reply_o       // sample the reply
);

  typedef enum logic [2:0] {
    StIdle,
    StFirst,   // address of W0
    StSecond,  // address of W1
    StDecode,  // W0 is valid
    StLook,
    StAct,
    StReply
  } state_e;

  state_e  state_q;
  source_e source_q;
  logic ask_q, again_q, program_q, place;
  logic [7:0] op_d, op_q;
  logic [3:0] option_q;

  assign program_q = source_q == FromProgram || source_q == FromTry;
  // The position is set in a cycle in which no step is counted. act_o stays low, because an act can stop the
  // motor and so suppress the step.
  assign place = state_q == StAct && op_q == I_POS_SET;
  assign place_o = place && !step_i;

  assign act_o = state_q == StAct && !place && !(cancel_i && source_q == FromProgram);
  assign reply_o = state_q == StReply;
  assign begin_o = state_q == StIdle && !ask_q && next_i;
  assign trial_o = source_q == FromTry;
  assign second_o = program_q && state_q != StFirst;
  assign claim_o = source_q != FromBoot && state_q inside {StFirst, StSecond, StDecode, StLook, StAct};

  always_comb begin
    order_o = '{op: op_q, option: option_q, source: source_q, data: frame_i.data};
    if (program_q) order_o.data = word_i;
    if (source_q == FromBoot) order_o.data = {16'd0, load_data_i};
  end

  assign op_d = (state_q == StDecode) ? op_of(
      word_i[7:0]
  ) : load_i ? load_op_i : frame_i.code[7] ? I_NONE : frame_i.code;

  pmc006_data_check u_range (
      .clk_i,
      .take_i   (state_q inside {StIdle, StDecode}),
      .program_i(state_q == StDecode),
      .op_i     (op_d),
      .order_i  (order_o),
      .access_o,
      .ok_o     (legal_o)
  );

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      state_q  <= StIdle;
      source_q <= FromBoot;
      ask_q    <= 1'b0;
    end else begin
      if (frame_i.go) ask_q <= 1'b1;
      unique case (state_q)
        StIdle:
        if (ask_q) begin
          ask_q    <= 1'b0;
          source_q <= FromFrame;
          state_q  <= StLook;
        end else if (load_i) begin
          source_q <= FromBoot;
          state_q  <= StLook;
        end else if (next_i) begin
          source_q <= FromProgram;
          state_q  <= StFirst;
        end
        StFirst: state_q <= StSecond;
        StSecond: state_q <= StDecode;
        StDecode: state_q <= StLook;
        StLook: state_q <= (source_q == FromBoot && !store_i) ? StIdle : StAct;
        StAct: if (!place || !step_i) state_q <= (source_q == FromFrame) ? StReply : StIdle;
        default: begin  // StReply
          state_q <= StIdle;
          if (again_q) begin
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
    again_q <= act_o && try_i;
  end

`ifndef SYNTHESIS
  `PPMC_ASSERT(p006_sta_15, !(place_o && step_i) && !(place_o && act_o))
  `PPMC_ASSERT(p006_frm_07, !(frame_i.go && ask_q))
`endif

endmodule

`default_nettype wire
