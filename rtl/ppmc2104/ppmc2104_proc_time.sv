// SPDX-License-Identifier: Apache-2.0
// ppmc2104_proc_time: with Datasheet = 1, delays accepted instructions by the processing times of the old
//         chip, and samples limits only at the poll ticks of the old chip. With Datasheet = 0, actions are
//         immediate and limits are always sampled.
// Rules:  P2104-DS-01..15, P2104-DS-20, P2104-STA-05 (DATASHEET).
// Timing: a window is the processing time of an instruction. It opens at the C-event (acceptance of a byte)
//         and closes ceil(time) + 1 cycles later. Actions that wait for the end of the window take effect at
//         the edge that closes it. The next byte may be accepted one cycle later. Poll ticks occur every
//         ceil(35 us) cycles, counted from the end of the last window, or from the first rising edge without
//         reset.
`default_nettype none

module ppmc2104_proc_time
  import ppmc2104_pkg::*;
  import ppmc_op_pkg::*;
#(
    parameter bit          Datasheet = 1'b0,
    parameter int unsigned ClkHz     = 16_000_000,
    parameter int unsigned XtalHz    = 16_000_000
) (
    input  wire logic                   clk_i,
    input  wire logic                   rst_ni,
    // command unit, at the C-event
    input  wire action_t                act_i,          // actions requested by the byte
    input  wire logic          [   7:0] code_i,         // code of act_i
    input  wire logic          [  31:0] params_i,       // data bytes of code_i
    input  wire logic          [   7:0] code_held_i,    // code_i of the last C-event
    input  wire logic          [  31:0] params_held_i,  // data bytes of code_held_i
    input  wire axis_summary_t [AXES:1] state_i,        // states of both axes
    output logic                        open_o,         // 1: a byte may be accepted
    output logic               [AXES:1] window_o,       // 1: a window of this axis is open
    // actions that take effect
    output action_t                     act_o,          // actions, effective at the next rising edge
    output logic               [   7:0] code_o,         // code of the actions at the end of a window
    output logic               [  31:0] params_o,       // data bytes of code_o
    output logic               [AXES:1] run_open_o,     // 1: RUN is sampled
    output logic               [AXES:1] end_delay_o,    // 1: an operation that was stopped must not end yet
    output logic                        poll_o          // 1: limits and alarms are sampled in this cycle
);

  // Times in crystal cycles: microseconds times 16.
  localparam int unsigned SettingXtal = 71_000 * 16;
  localparam int unsigned HaltXtal = 400 * 16;
  localparam int unsigned DecelXtal = 32 * 16;
  localparam int unsigned StartSingleXtal = 103 * 16;
  localparam int unsigned StartTriangularXtal = 340 * 16;
  localparam int unsigned StartTrapezoidalXtal = 110 * 16;
  localparam int unsigned StartConstantXtal = 29 * 16;
  localparam int unsigned StartContinuousXtal = 32 * 16;  // continuous constant speed, origin search
  localparam int unsigned StartHighXtal = 118 * 16;
  localparam int unsigned ReadEndXtal = 40 * 16;
  localparam int unsigned ReadInputsXtal = 36 * 16;
  localparam int unsigned ReadOutputsXtal = 32 * 16;
  localparam int unsigned ReadRemainingXtal = 37 * 16;
  localparam int unsigned ReadErrorXtal = 43 * 16;
  localparam int unsigned ExcOffXtal = 32 * 16;
  localparam int unsigned AuxXtal = 40 * 16;
  localparam int unsigned SwitchingXtal = 36 * 16;
  localparam int unsigned HoldDelayXtal = 32 * 16;
  localparam int unsigned PollXtal = 35 * 16;

  if (!Datasheet) begin : g_fast
    logic unused_bits;

    assign unused_bits = &{1'b0, clk_i, rst_ni, code_held_i, params_held_i, state_i};
    assign open_o      = 1'b1;
    assign window_o    = '0;
    assign act_o       = act_i;
    assign code_o      = code_i;
    assign params_o    = params_i;
    assign run_open_o  = '1;
    assign end_delay_o = '0;
    assign poll_o      = 1'b1;
  end else begin : g_datasheet

    localparam int unsigned Bits = ppmc_pkg::cnt_width(SettingXtal + 1);
    localparam int unsigned PollCycles = ppmc_pkg::cyc(PollXtal, ClkHz, XtalHz);
    localparam int unsigned PollBits = ppmc_pkg::cnt_width(PollCycles - 1);

    // The byte leaves the mailbox at the C-event. Therefore actions at the end of a window use the held
    // code and data.
    assign code_o   = code_held_i;
    assign params_o = params_held_i;

    // ---- window -----------------------------------------------------------------------------------

    axis_action_t any_act;
    action_t immediate, delayed_q;
    op_code_t op_code;
    axis_summary_t addressed;
    logic window_q, begins, past, ends, triangular, unused_bits;
    logic [AXES:1] axis_q, starting_q, halted_q;
    logic [Bits-1:0] limit, limit_q;

    assign op_code     = op_code_t'(code_i);
    assign addressed   = op_code.second ? state_i[2] : state_i[1];
    assign triangular  = params_i[31:8] < 24'({addressed.setup.steps, 1'b0});
    assign any_act     = act_i.axis[1] | act_i.axis[2];
    assign begins      = act_i != '0;
    assign ends        = window_q && past;
    assign unused_bits = &{1'b0, op_code, params_i, addressed, state_i};

    always_comb begin
      limit = Bits'(AuxXtal);
      // This is not a unique case, because before the first reset the flip-flops may request several actions
      // at a time.
      case (1'b1)
        any_act.init: limit = Bits'(SettingXtal);
        any_act.halt: limit = Bits'(HaltXtal);
        any_act.decel: limit = Bits'(DecelXtal);
        any_act.exc_off: limit = Bits'(ExcOffXtal);
        any_act.switching: limit = Bits'(SwitchingXtal);
        any_act.hold_delay: limit = Bits'(HoldDelayXtal);
        any_act.start:
        unique case (op_code.op)
          OP_SINGLE:    limit = Bits'(StartSingleXtal);
          OP_ACC_DEC:   limit = triangular ? Bits'(StartTriangularXtal) : Bits'(StartTrapezoidalXtal);
          OP_CONSTANT:  limit = Bits'(StartConstantXtal);
          OP_CONT_HIGH: limit = Bits'(StartHighXtal);
          default:      limit = Bits'(StartContinuousXtal);
        endcase
        any_act.read:
        unique case (code_i[2:0])
          SEL_END:     limit = Bits'(ReadEndXtal);
          SEL_INPUTS:  limit = Bits'(ReadInputsXtal);
          SEL_OUTPUTS: limit = Bits'(ReadOutputsXtal);
          SEL_ERROR:   limit = Bits'(ReadErrorXtal);
          default:     limit = Bits'(ReadRemainingXtal);
        endcase
        default: ;
      endcase
    end

    // Actions that take effect at the C-event.
    always_comb begin
      immediate = '0;
      for (int n = 1; n <= AXES; n++) begin
        immediate.axis[n].init  = act_i.axis[n].init;
        immediate.axis[n].start = act_i.axis[n].start;
        immediate.axis[n].halt  = act_i.axis[n].halt;
      end
      act_o = immediate;
      if (ends) act_o = act_o | delayed_q;
    end

    always_ff @(posedge clk_i or negedge rst_ni) begin
      if (!rst_ni) begin
        window_q   <= 1'b0;
        axis_q     <= '0;
        delayed_q  <= '0;
        limit_q    <= '0;
        starting_q <= '0;
        halted_q   <= '0;
      end else if (begins) begin
        window_q  <= 1'b1;
        delayed_q <= act_i & ~immediate;
        limit_q   <= limit;
        for (int n = 1; n <= AXES; n++) begin
          axis_q[n]     <= act_i.axis[n] != '0;
          starting_q[n] <= act_i.axis[n].start;
          halted_q[n]   <= act_i.axis[n].halt && state_i[n].moving;
        end
      end else if (ends) begin
        window_q   <= 1'b0;
        axis_q     <= '0;
        starting_q <= '0;
        halted_q   <= '0;
      end
    end

    ppmc_xtal_timer #(
        .ClkHz (ClkHz),
        .XtalHz(XtalHz),
        .Width (Bits)
    ) u_window (
        .clk_i,
        .rst_ni,
        .restart_i(begins),
        .limit_i  (limit_q),
        .past_o   (past)
    );

    assign open_o = !window_q;
    assign window_o = axis_q;
    assign end_delay_o = past ? '0 : halted_q;

    always_comb begin
      for (int n = 1; n <= AXES; n++) run_open_o[n] = !act_i.axis[n].start && (past || !starting_q[n]);
    end

    // ---- polling ----------------------------------------------------------------------------------

    logic [PollBits-1:0] poll_q;

    assign poll_o = poll_q == PollBits'(PollCycles - 1);

    always_ff @(posedge clk_i or negedge rst_ni) begin
      // The count begins at the first rising edge without reset. rst_ni rises one cycle
      // later, so the count has already reached 1.
      if (!rst_ni) poll_q <= PollBits'(1);
      else if (begins || window_q || poll_o) poll_q <= '0;
      else poll_q <= poll_q + 1'b1;
    end
  end

endmodule

`default_nettype wire
