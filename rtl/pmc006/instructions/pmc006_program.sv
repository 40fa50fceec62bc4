// SPDX-License-Identifier: Apache-2.0
// pmc006_program: processor of the user program: its current line, counter and flag, WAIT, the two keys.
// Rules:  sections 12.3..12.7, P006-CMD-01..05/18/47, P006-BAD-11/16..19/23.
// Timing: instructions start at least 48 cycles apart. WAIT ends on the edge after the cycle in which its
//         source has the requested level.
`include "ppmc_assert.svh"
`default_nettype none

module pmc006_program
  import pmc006_pkg::*;
(
    input  wire logic         clk_i,
    input  wire logic         rst_ni,
    input  wire logic         autostart_i,  // strobe: the program starts without a command
    // executor
    input  wire order_t       order_i,      // instruction
    input  wire logic         legal_i,      // the data of order_i are in range
    input  wire logic         act_i,        // order_i is executed in this cycle
    input  wire logic         begin_i,      // next_o was accepted
    output logic              next_o,       // the next program instruction is scheduled
    output logic              cancel_o,     // discard the program instruction in progress
    input  wire logic         second_i,     // address of W1
    input  wire logic         trial_i,      // the address is that of the instruction at PP
    output logic        [7:0] word_at_o,    // address of a word in the buffer
    output logic              try_o,        // E is accepted
    output logic              put_o,        // a word is written
    output logic              took_o,       // a word instruction, z or E is accepted
    input  wire logic         burning_i,    // the program is written to the EEPROM: no word may change
    output logic        [7:0] pp_o,         // pointer PP, a word address
    // sources
    input  wire logic         us_i,         // strobe every microsecond
    input  wire logic   [4:0] gpi_i,        // general inputs, synchronised
    input  wire logic   [1:0] flags_i,      // flags of EXT1, EXT2
    input  wire logic         busy_i,       // a motion is in progress
    input  wire logic         stall_i,      // register STALL
    output logic              stop_o        // the RESET key stops the motion
);

  localparam int unsigned PaceClk = 48;
  localparam int unsigned PaceBits = ppmc_pkg::cnt_width(PaceClk - 1);

  typedef enum logic [1:0] {
    StHalt,
    StRun,
    StWait,
    StHeld
  } state_e;

  state_e state_q;
  logic paused_q, flag_q, rsten_q, pauen_q, want_q, met, equal, advance, jump, halt, go, inside_pp, mine;
  logic reset_hit, reset_armed, pause_hit, unused_armed;
  logic [3:0] option_q, option;
  logic [6:0] line_q, target_q;
  logic [31:0] count_q;
  logic [4:0] value;
  logic [8:0] bits;
  logic [PaceBits-1:0] pace_q;
  logic unused_bits;

  assign unused_bits = &{1'b0, order_i};

  // ---- sources --------------------------------------------------------------------------------------------

  // During WAIT the option of the WAIT instruction is used, because the executor may process another
  // instruction.
  assign option = (state_q == StWait) ? option_q : order_i.option;
  assign bits = {stall_i, busy_i, flags_i, gpi_i};

  always_comb begin
    met = 1'b1;
    for (int unsigned i = 0; i < 9; i++) begin
      if (option == 4'(i + 1)) met = bits[i] == ((state_q == StWait) ? want_q : order_i.data[0]);
    end
    value = 5'd0;
    for (int unsigned i = 0; i < 7; i++) if (order_i.option == 4'(i + 1)) value[0] = bits[i];
    if (order_i.option == 4'd9) value = gpi_i;
    equal = (order_i.option == 4'd8) ? order_i.data == count_q : order_i.data == 32'(value);
  end

  // ---- keys -----------------------------------------------------------------------------------------------

  pmc006_debounce u_key_reset (
      .clk_i,
      .rst_ni,
      .us_i,
      .pin_i  (gpi_i[0]),
      .hit_o  (reset_hit),
      .armed_o(reset_armed)
  );

  pmc006_debounce u_key_pause (
      .clk_i,
      .rst_ni,
      .us_i,
      .pin_i  (gpi_i[1]),
      .hit_o  (pause_hit),
      .armed_o(unused_armed)
  );

  assign stop_o = rsten_q && reset_hit;
  assign cancel_o = stop_o && state_q != StHalt;

  // ---- words ----------------------------------------------------------------------------------------------

  assign inside_pp = pp_o < WORDS;
  assign put_o = act_i && order_i.op == I_PUT && inside_pp && state_q == StHalt && !burning_i;
  assign try_o = act_i && order_i.op == I_TRY && inside_pp && state_q == StHalt;
  assign go = act_i && order_i.op == I_START && inside_pp && state_q == StHalt;
  assign took_o = put_o || try_o || go || (act_i && order_i.op == I_GET && inside_pp);
  assign word_at_o = (order_i.source == FromProgram) ? {line_q, second_i} :
      trial_i ? {pp_o[7:1], second_i} : pp_o;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) pp_o <= '0;
    else if (act_i && legal_i && order_i.op == I_POINTER) pp_o <= order_i.data[7:0];
    else if (put_o || (act_i && order_i.op == I_GET && inside_pp)) pp_o <= pp_o + 1'b1;
  end

  // ---- processor ------------------------------------------------------------------------------------------

  assign next_o = state_q == StRun && !paused_q && pace_q == '0 && !cancel_o;
  assign mine = act_i && order_i.source == FromProgram;
  assign jump = mine && (order_i.op == P_JMP || (order_i.op == P_JNE && !flag_q) ||
                         (order_i.op == P_JEQ && flag_q));
  assign halt = mine && (order_i.op == P_END || (jump && !legal_i));
  assign advance = (mine && !jump && !halt && (order_i.op != P_WAIT || !legal_i || met)) ||
      (state_q == StWait && !paused_q && met);

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      state_q  <= StHalt;
      paused_q <= 1'b0;
      rsten_q  <= 1'b0;
      pauen_q  <= 1'b0;
    end else begin
      if (mine && order_i.op == P_WAIT) state_q <= StWait;
      if (advance) state_q <= (line_q == LAST_LINE) ? StHalt : StRun;
      if (state_q == StHeld && reset_armed) state_q <= StRun;
      if (mine && legal_i && order_i.op == P_RESET_EN) rsten_q <= order_i.option[0];
      if (mine && legal_i && order_i.op == P_PAUSE_EN) pauen_q <= order_i.option[0];
      if (pauen_q && pause_hit && state_q inside {StRun, StWait}) paused_q <= !paused_q;
      if (halt) state_q <= StHalt;
      if (cancel_o) begin
        state_q  <= StHeld;
        paused_q <= 1'b0;
      end
      if (go || autostart_i) begin
        state_q  <= StRun;
        paused_q <= 1'b0;
        rsten_q  <= 1'b0;
        pauen_q  <= 1'b0;
      end
      if (act_i && legal_i && order_i.op == I_OFFLINE && !order_i.data[0]) begin
        state_q  <= StHalt;
        paused_q <= 1'b0;
        rsten_q  <= 1'b0;
        pauen_q  <= 1'b0;
      end
    end
  end

  always_ff @(posedge clk_i) begin
    if (cancel_o) line_q <= target_q;
    else if (jump) line_q <= order_i.data[6:0];
    else if (advance) line_q <= line_q + 1'b1;
    if (go) line_q <= pp_o[7:1];
    if (autostart_i) line_q <= '0;
    if (mine && legal_i && order_i.op == P_RESET_EN) target_q <= order_i.data[6:0];
    if (mine && order_i.op == P_WAIT) {want_q, option_q} <= {order_i.data[0], order_i.option};
    if (act_i && order_i.op == P_CMP) flag_q <= legal_i && equal;
    if (act_i && order_i.op == P_CNTI) count_q <= count_q + 1'b1;
    if (act_i && order_i.op == P_CNTC) count_q <= '0;
    if (go || autostart_i) begin
      flag_q  <= 1'b0;
      count_q <= '0;
    end
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) pace_q <= '0;
    else if (go) pace_q <= '0;
    else if (begin_i) pace_q <= PaceBits'(PaceClk - 1);
    else if (pace_q != '0) pace_q <= pace_q - 1'b1;
  end

`ifndef SYNTHESIS
  `PPMC_ASSERT(p006_prg_15, !mine || state_q == StRun)
  `PPMC_ASSERT(p006_prg_13, state_q == StHalt || line_q <= LAST_LINE)
`endif

endmodule

`default_nettype wire
