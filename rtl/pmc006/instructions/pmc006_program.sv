// SPDX-License-Identifier: Apache-2.0
// pmc006_program: executes the user program. Contains the current line, the counter, the compare flag,
//         WAIT, and the RESET and PAUSE keys.
// Rules:  P006-PRG-02/10..17/20/30..33, P006-CMD-01..05/18/47, P006-BAD-11/16..19/23.
// Timing: instructions start at least 48 cycles apart. WAIT selects a signal (its source), and ends at the
//         end of the cycle in which this signal has the requested level.
`include "ppmc_assert.svh"
`default_nettype none

module pmc006_program
  import pmc006_pkg::*;
(
    input  wire logic            clk_i,
    input  wire logic            rst_ni,
    input  wire logic            autostart_i,   // strobe: start the program at line 0
    // executor
    input  wire exec_cmd_t       cmd_i,         // instruction in progress
    input  wire logic            legal_i,       // 1: the data of cmd_i are accepted
    input  wire logic            exec_i,        // strobe: cmd_i is executed
    input  wire logic            instr_ack_i,   // strobe: execution of the requested instruction begins
    output logic                 instr_req_o,   // level: execute the instruction of the current line
    output logic                 cancel_o,      // 1: discard the program instruction in progress
    input  wire logic            word1_i,       // 1: address word W1 of the line, 0: W0
    input  wire logic            use_pp_i,      // 1: address the instruction at PP
    output logic           [7:0] word_addr_o,   // address of a word in the buffer
    output logic                 try_accept_o,  // strobe: instruction E is accepted
    output logic                 put_o,         // strobe: write a word into the buffer
    output logic                 accepted_o,    // strobe: instruction W, G, z or E is accepted
    input  wire logic            burning_i,     // 1: program being written, words must not change
    output logic           [7:0] pp_o,          // pointer PP, word address 0 .. 200
    // sources of WAIT
    input  wire logic            us_i,          // strobe every microsecond
    input  wire logic      [4:0] gpi_i,         // general inputs, synchronised
    input  wire logic      [1:0] flags_i,       // EXT flags, [0]: EXT1
    input  wire logic            busy_i,        // 1: a motion is in progress
    input  wire logic            stall_i,       // register STALL
    output logic                 stop_o         // strobe: the RESET key stops the motion
);

  localparam int unsigned InstrCycles = 48;
  localparam int unsigned InstrBits = ppmc_pkg::cnt_width(InstrCycles - 1);

  typedef enum logic [1:0] {
    StHalt,
    StRun,
    StWait,
    StResetKey
  } state_e;

  state_e state_q;
  logic paused_q, flag_q, rsten_q, pauen_q, wait_level_q, cond_met, equal, advance, jump, halt;
  logic start, pp_in_range, program_exec;
  logic reset_hit, reset_rearm, pause_hit, unused_rearm;
  logic [3:0] option_q, option;
  logic [6:0] line_q, target_q;
  logic [31:0] count_q;
  logic [4:0] value;
  logic [8:0] bits;
  logic [InstrBits-1:0] instr_left_q;
  logic unused_bits;

  assign unused_bits = &{1'b0, cmd_i};

  // ---- sources --------------------------------------------------------------------------------------------

  // During WAIT, the stored option is used, because cmd_i may then be an instruction of a frame.
  assign option = (state_q == StWait) ? option_q : cmd_i.option;
  assign bits = {stall_i, busy_i, flags_i, gpi_i};

  always_comb begin
    cond_met = 1'b1;
    for (int unsigned i = 0; i < 9; i++) begin
      if (option == 4'(i + 1)) cond_met = bits[i] == ((state_q == StWait) ? wait_level_q : cmd_i.data[0]);
    end
    value = 5'd0;
    for (int unsigned i = 0; i < 7; i++) if (cmd_i.option == 4'(i + 1)) value[0] = bits[i];
    if (cmd_i.option == 4'd9) value = gpi_i;
    equal = (cmd_i.option == 4'd8) ? cmd_i.data == count_q : cmd_i.data == 32'(value);
  end

  // ---- keys -----------------------------------------------------------------------------------------------

  pmc006_debounce u_key_reset (
      .clk_i,
      .rst_ni,
      .us_i,
      .pin_i  (gpi_i[0]),
      .hit_o  (reset_hit),
      .rearm_o(reset_rearm)
  );

  pmc006_debounce u_key_pause (
      .clk_i,
      .rst_ni,
      .us_i,
      .pin_i  (gpi_i[1]),
      .hit_o  (pause_hit),
      .rearm_o(unused_rearm)
  );

  assign stop_o = rsten_q && reset_hit;
  assign cancel_o = stop_o && state_q != StHalt;

  // ---- words ----------------------------------------------------------------------------------------------

  assign pp_in_range = pp_o < PROGRAM_WORDS;
  assign put_o = exec_i && cmd_i.op == I_PUT && pp_in_range && state_q == StHalt && !burning_i;
  assign try_accept_o = exec_i && cmd_i.op == I_TRY && pp_in_range && state_q == StHalt;
  assign start = exec_i && cmd_i.op == I_START && pp_in_range && state_q == StHalt;
  assign accepted_o = put_o || try_accept_o || start || (exec_i && cmd_i.op == I_GET && pp_in_range);
  assign word_addr_o = (cmd_i.source == FromProgram) ? {line_q, word1_i} :
      use_pp_i ? {pp_o[7:1], word1_i} : pp_o;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) pp_o <= '0;
    else if (exec_i && legal_i && cmd_i.op == I_POINTER) pp_o <= cmd_i.data[7:0];
    else if (put_o || (exec_i && cmd_i.op == I_GET && pp_in_range)) pp_o <= pp_o + 1'b1;
  end

  // ---- processor ------------------------------------------------------------------------------------------

  assign instr_req_o = state_q == StRun && !paused_q && instr_left_q == '0 && !cancel_o;
  assign program_exec = exec_i && cmd_i.source == FromProgram;
  assign jump = program_exec && (cmd_i.op == P_JMP || (cmd_i.op == P_JNE && !flag_q) ||
                         (cmd_i.op == P_JEQ && flag_q));
  assign halt = program_exec && (cmd_i.op == P_END || (jump && !legal_i));
  assign advance = (program_exec && !jump && !halt && (cmd_i.op != P_WAIT || !legal_i || cond_met)) ||
      (state_q == StWait && !paused_q && cond_met);

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      state_q  <= StHalt;
      paused_q <= 1'b0;
      rsten_q  <= 1'b0;
      pauen_q  <= 1'b0;
    end else begin
      if (program_exec && cmd_i.op == P_WAIT) state_q <= StWait;
      if (advance) state_q <= (line_q == PROGRAM_LAST_LINE) ? StHalt : StRun;
      if (state_q == StResetKey && reset_rearm) state_q <= StRun;
      if (program_exec && legal_i && cmd_i.op == P_RESET_EN) rsten_q <= cmd_i.option[0];
      if (program_exec && legal_i && cmd_i.op == P_PAUSE_EN) pauen_q <= cmd_i.option[0];
      if (pauen_q && pause_hit && state_q inside {StRun, StWait}) paused_q <= !paused_q;
      if (halt) state_q <= StHalt;
      if (cancel_o) begin
        state_q  <= StResetKey;
        paused_q <= 1'b0;
      end
      if (start || autostart_i) begin
        state_q  <= StRun;
        paused_q <= 1'b0;
        rsten_q  <= 1'b0;
        pauen_q  <= 1'b0;
      end
      if (exec_i && legal_i && cmd_i.op == I_OFFLINE && !cmd_i.data[0]) begin
        state_q  <= StHalt;
        paused_q <= 1'b0;
        rsten_q  <= 1'b0;
        pauen_q  <= 1'b0;
      end
    end
  end

  always_ff @(posedge clk_i) begin
    if (cancel_o) line_q <= target_q;
    else if (jump) line_q <= cmd_i.data[6:0];
    else if (advance) line_q <= line_q + 1'b1;
    if (start) line_q <= pp_o[7:1];
    if (autostart_i) line_q <= '0;
    if (program_exec && legal_i && cmd_i.op == P_RESET_EN) target_q <= cmd_i.data[6:0];
    if (program_exec && cmd_i.op == P_WAIT) {wait_level_q, option_q} <= {cmd_i.data[0], cmd_i.option};
    if (exec_i && cmd_i.op == P_CMP) flag_q <= legal_i && equal;
    if (exec_i && cmd_i.op == P_CNTI) count_q <= count_q + 1'b1;
    if (exec_i && cmd_i.op == P_CNTC) count_q <= '0;
    if (start || autostart_i) begin
      flag_q  <= 1'b0;
      count_q <= '0;
    end
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) instr_left_q <= '0;
    else if (start) instr_left_q <= '0;
    else if (instr_ack_i) instr_left_q <= InstrBits'(InstrCycles - 1);
    else if (instr_left_q != '0) instr_left_q <= instr_left_q - 1'b1;
  end

`ifndef SYNTHESIS
  `PPMC_ASSERT(p006_prg_15, !program_exec || state_q == StRun)
  `PPMC_ASSERT(p006_prg_13, state_q == StHalt || line_q <= PROGRAM_LAST_LINE)
`endif

endmodule

`default_nettype wire
