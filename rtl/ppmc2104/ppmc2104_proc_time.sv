// SPDX-License-Identifier: Apache-2.0
// ppmc2104_proc_time: with Datasheet = 1, delays accepted instructions by the processing times of the old
//         chip and schedules its polling of limits. Otherwise actions are immediate and limits are always
//         sampled.
// Rules:  P2104-DS-01..15, P2104-DS-20, P2104-STA-05 (c).
// Timing: a window opens at the C-event and closes ceil(time) + 1 cycles later. Actions that wait for its end
//         take effect at that edge; the next byte may be accepted one cycle later. Poll ticks occur every
//         ceil(35 us) cycles, counted from the first rising edge without reset or the end of the last window.
`default_nettype none

module ppmc2104_proc_time
  import ppmc2104_pkg::*;
  import ppmc_op_pkg::*;
#(
    parameter bit          Datasheet = 1'b0,
    parameter int unsigned ClkHz     = 16_000_000,
    parameter int unsigned XtalHz    = 16_000_000
) (
    input  wire logic             clk_i,
    input  wire logic             rst_ni,
    // command unit, at the C-event
    input  wire action_t          act_i,          // actions requested by the byte
    input  wire logic    [   7:0] code_i,         // code of act_i
    input  wire logic    [  31:0] params_i,       // data bytes of code_i
    input  wire logic    [   7:0] code_held_i,    // code_i after the C-event
    input  wire logic    [  31:0] params_held_i,  // data bytes of code_held_i
    input  wire state_t  [AXES:1] state_i,        // states of both axes
    output logic                  open_o,         // bytes may be accepted
    output logic         [AXES:1] window_o,       // a window of this axis is open
    // actions that take effect
    output action_t               act_o,          // actions, effective at the next rising edge
    output logic         [   7:0] code_o,         // code of the actions at the end of a window
    output logic         [  31:0] params_o,       // data bytes of code_o
    output logic         [AXES:1] run_open_o,     // 1: RUN is sampled
    output logic         [AXES:1] end_delay_o,    // 1: a stopped operation does not end yet
    output logic                  poll_o          // 1: limits and alarms are sampled in this cycle
);

  // Crystal periods: microseconds times 16.
  localparam int unsigned SETTING = 71_000 * 16;
  localparam int unsigned HALT = 400 * 16;
  localparam int unsigned DECEL = 32 * 16;
  localparam int unsigned START_SINGLE = 103 * 16;
  localparam int unsigned START_TRIANGLE = 340 * 16;
  localparam int unsigned START_TRAPEZOID = 110 * 16;
  localparam int unsigned START_CONSTANT = 29 * 16;
  localparam int unsigned START_ENDLESS = 32 * 16;  // continuous constant speed, origin search
  localparam int unsigned START_HIGH = 118 * 16;
  localparam int unsigned READ_END = 40 * 16;
  localparam int unsigned READ_INPUTS = 36 * 16;
  localparam int unsigned READ_OUTPUTS = 32 * 16;
  localparam int unsigned READ_REMAINING = 37 * 16;
  localparam int unsigned READ_ERROR = 43 * 16;
  localparam int unsigned EXC_OFF = 32 * 16;
  localparam int unsigned AUX = 40 * 16;
  localparam int unsigned SWITCHING = 36 * 16;
  localparam int unsigned HOLD_DELAY = 32 * 16;
  localparam int unsigned POLL = 35 * 16;

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

    localparam int unsigned Bits = ppmc_pkg::cnt_width(SETTING + 1);
    localparam int unsigned PollClk = ppmc_pkg::cyc(POLL, ClkHz, XtalHz);
    localparam int unsigned PollBits = ppmc_pkg::cnt_width(PollClk - 1);

    // The byte leaves the mailbox at the C-event. Actions at the end of a window use the held code and data.
    assign code_o   = code_held_i;
    assign params_o = params_held_i;

    // ---- window -----------------------------------------------------------------------------------

    axis_action_t any;
    action_t now, late_q;
    op_code_t op_code;
    state_t   mine;
    logic window_q, begins, past, ends, triangle, unused_bits;
    logic [AXES:1] axis_q, starting_q, halted_q;
    logic [Bits-1:0] limit, limit_q;

    assign op_code     = op_code_t'(code_i);
    assign mine        = op_code.second ? state_i[2] : state_i[1];
    assign triangle    = params_i[31:8] < 24'({mine.setup.steps, 1'b0});
    assign any         = act_i.axis[1] | act_i.axis[2];
    assign begins      = act_i != '0;
    assign ends        = window_q && past;
    assign unused_bits = &{1'b0, op_code, params_i, mine, state_i};

    always_comb begin
      limit = Bits'(AUX);
      // Not a unique case: before the first reset, flip-flops may request several actions at a time.
      case (1'b1)
        any.init: limit = Bits'(SETTING);
        any.halt: limit = Bits'(HALT);
        any.decel: limit = Bits'(DECEL);
        any.exc_off: limit = Bits'(EXC_OFF);
        any.switching: limit = Bits'(SWITCHING);
        any.hold_delay: limit = Bits'(HOLD_DELAY);
        any.start:
        unique case (op_code.op)
          OP_SINGLE:    limit = Bits'(START_SINGLE);
          OP_ACC_DEC:   limit = triangle ? Bits'(START_TRIANGLE) : Bits'(START_TRAPEZOID);
          OP_CONSTANT:  limit = Bits'(START_CONSTANT);
          OP_CONT_HIGH: limit = Bits'(START_HIGH);
          default:      limit = Bits'(START_ENDLESS);
        endcase
        any.read:
        unique case (code_i[2:0])
          SEL_END:     limit = Bits'(READ_END);
          SEL_INPUTS:  limit = Bits'(READ_INPUTS);
          SEL_OUTPUTS: limit = Bits'(READ_OUTPUTS);
          SEL_ERROR:   limit = Bits'(READ_ERROR);
          default:     limit = Bits'(READ_REMAINING);
        endcase
        default: ;
      endcase
    end

    // Actions that take effect at the C-event.
    always_comb begin
      now = '0;
      for (int n = 1; n <= AXES; n++) begin
        now.axis[n].init  = act_i.axis[n].init;
        now.axis[n].start = act_i.axis[n].start;
        now.axis[n].halt  = act_i.axis[n].halt;
      end
      act_o = now;
      if (ends) act_o = act_o | late_q;
    end

    always_ff @(posedge clk_i or negedge rst_ni) begin
      if (!rst_ni) begin
        window_q   <= 1'b0;
        axis_q     <= '0;
        late_q     <= '0;
        limit_q    <= '0;
        starting_q <= '0;
        halted_q   <= '0;
      end else if (begins) begin
        window_q <= 1'b1;
        late_q   <= act_i & ~now;
        limit_q  <= limit;
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

    assign poll_o = poll_q == PollBits'(PollClk - 1);

    always_ff @(posedge clk_i or negedge rst_ni) begin
      if (!rst_ni) poll_q <= PollBits'(1);  // starts at 1, because reset ends one cycle late
      else if (begins || window_q || poll_o) poll_q <= '0;
      else poll_q <= poll_q + 1'b1;
    end
  end

endmodule

`default_nettype wire
