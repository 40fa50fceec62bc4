// SPDX-License-Identifier: Apache-2.0
// ppmc_pace: when a taken byte takes effect in a part with one axis: at once (FAST), or after the old chip's
// processing times (DATASHEET).
// Rules:  P104-DS-01..12, P104-DS-14, P104-HSK-03/04; STMC-DS-01..14, STMC-INI-07.
// Timing: DATASHEET times run from the C-event (2 clk after the write event) or from the pulse or decision
//         they belong to; what they release happens one clk after the nominal time.
// How:    two timers: one for the command at hand (mailbox closed), one for the motion (pulse 1, end).
`default_nettype none

module ppmc_pace
  import ppmc_code_pkg::*;
  import ppmc_op_pkg::*;
#(
    parameter bit Datasheet = 1'b0,
    parameter int unsigned ClkHz = 16_000_000,
    parameter int unsigned XtalHz = 16_000_000,
    parameter int unsigned StepBits = 14,  // of PA
    parameter int unsigned StepsMin = 4,  // smallest PA; its table takes 16.5 ms
    parameter int unsigned StepsMax = 11_220,
    parameter bit RampTimes = 1'b1  // a stop in a ramp and the start of one without a plateau take longer
) (
    input  wire logic                   clk_i,
    input  wire logic                   rst_ni,
    // command unit, at the C-event
    input  wire action_t                act_i,          // what the byte asks for
    input  wire logic    [         7:0] code_i,         // its code
    input  wire logic    [        31:0] params_i,       // its parameters
    input  wire logic    [         7:0] code_held_i,    // the same afterwards
    input  wire logic    [        31:0] params_held_i,  // the same afterwards
    input  wire logic    [         2:0] base_i,         // base clock as it is selected now
    output logic                        open_o,         // bytes may be taken
    // when it takes effect
    output action_t                     act_o,          // takes effect at the coming edge
    output logic         [         7:0] code_o,         // code that act_o belongs to
    output logic         [        31:0] params_o,       // its parameters
    output logic         [         2:0] base_o,         // base clock of the operation that starts
    // initialisation
    input  wire logic                   initialised_i,  // an initialisation has been completed
    input  wire logic                   building_i,     // ramp table
    input  wire logic    [StepBits-1:0] steps_i,        // PA in force
    output logic                        home_o,         // phases to index 0, first initialisation
    output logic                        ready_o,        // initialisation complete
    // motion
    input  wire logic                   ramp_i,         // the running operation has a ramp
    input  wire logic                   single_i,       // is a single step
    input  wire logic                   stop_i,         // immediate end decided at the coming edge
    input  wire logic                   pulse_i,        // pulse event at the coming edge
    input  wire logic                   last_i,         // with pulse_i: the last one
    input  wire logic                   final_i,        // with pulse_i: and the count is complete
    output logic                        go_o,           // pulse 1 may come
    output logic                        linger_o        // the motion must not end yet
);

  // Crystal cycles; microseconds times 16.
  localparam int unsigned INIT_PHASES = 44 * 16;
  localparam int unsigned INIT_BASE = 264_000;
  localparam int unsigned INIT_STEP = 209;
  localparam int unsigned BUSY_CONSTANT = 27 * 16;
  localparam int unsigned BUSY_RAMP = 112 * 16;
  localparam int unsigned FIRST_CONSTANT = 194 * 16;
  localparam int unsigned FIRST_RAMP = 200 * 16;
  localparam int unsigned FIRST_SINGLE = 86 * 16;
  localparam int unsigned END_BUSY = 26 * 16;
  localparam int unsigned END_OPEN = 156 * 16;
  localparam int unsigned END_RAMP = 200 * 16;
  localparam int unsigned FLAG_COMMAND = 17 * 16;
  localparam int unsigned AUX = 14 * 16;
  localparam int unsigned EXC_OFF = 18 * 16;

  localparam int unsigned CmdBits = ppmc_pkg::cnt_width(INIT_BASE + INIT_STEP * StepsMax);
  localparam int unsigned MotBits = RampTimes ? 18 : 12;  // 3200, and 123/16 of at most 2 PA pulses

  if (!Datasheet) begin : g_fast
    logic built_q;  // the table is complete one clk after building_i
    logic unused_bits;

    always_ff @(posedge clk_i or negedge rst_ni) begin
      if (!rst_ni) built_q <= 1'b0;
      else built_q <= building_i;
    end

    assign act_o = act_i;
    assign code_o = code_i;
    assign params_o = params_i;
    assign base_o = base_i;
    assign open_o = !building_i && !built_q;
    assign home_o = act_i.init && !initialised_i;
    assign ready_o = built_q && !building_i;
    assign go_o = 1'b1;
    assign linger_o = 1'b0;
    assign unused_bits = &{1'b0, code_held_i, params_held_i, steps_i, ramp_i, single_i, stop_i, pulse_i,
                           last_i, final_i};
  end else begin : g_datasheet

    // The byte is gone when its time is up: its data come from behind the C-event.
    op_code_t op_code;
    logic ramp;  // of the operation that the byte asks for

    assign op_code  = op_code_t'(code_i);
    assign ramp     = op_code.op inside {OP_ACC_DEC, OP_CONT_HIGH};
    assign code_o   = code_held_i;
    assign params_o = params_held_i;

    always_ff @(posedge clk_i or negedge rst_ni) begin
      if (!rst_ni) base_o <= '0;
      else if (act_i.start) base_o <= base_i;
    end

    // ---- command at hand -----------------------------------------------------------------------------

    action_t now, late, held_q;
    logic cmd_busy_q, cmd_past, home_past, homed_q, cmd_start;
    logic [CmdBits-1:0] cmd_limit, cmd_limit_q;

    always_comb begin
      // A decelerating stop that acts as an immediate one has no time of its own (P104-DS-14).
      now = '{
          init: act_i.init,
          halt: act_i.halt,
          switching: act_i.switching,
          read: act_i.read,
          decel: act_i.decel && !(RampTimes && ramp_i),
          default: 1'b0
      };
      late = act_i & ~now;
      late.init = act_i.init;
      cmd_start = late != '0;
      cmd_limit = CmdBits'(AUX);
      if (act_i.exc_off) cmd_limit = CmdBits'(EXC_OFF);
      if (act_i.decel) cmd_limit = CmdBits'(FLAG_COMMAND);
      if (act_i.start) begin
        cmd_limit = (op_code.pout_only || ramp) ? CmdBits'(BUSY_RAMP) : CmdBits'(BUSY_CONSTANT);
      end
      if (act_i.init) begin
        cmd_limit = CmdBits'(INIT_BASE) +
            CmdBits'(INIT_STEP) * (CmdBits'(params_i[16+:StepBits]) - CmdBits'(StepsMin));
      end
    end

    always_ff @(posedge clk_i or negedge rst_ni) begin
      if (!rst_ni) begin
        held_q      <= '0;
        cmd_busy_q  <= 1'b0;
        cmd_limit_q <= '0;
        homed_q     <= 1'b1;
      end else if (cmd_start) begin
        held_q      <= late;
        cmd_busy_q  <= 1'b1;
        cmd_limit_q <= cmd_limit;
        homed_q     <= !act_i.init;
      end else begin
        if (cmd_past) cmd_busy_q <= 1'b0;
        if (home_past) homed_q <= 1'b1;
      end
    end

    logic past;

    ppmc_xtal_timer #(
        .ClkHz (ClkHz),
        .XtalHz(XtalHz),
        .Width (CmdBits)
    ) u_command (
        .clk_i,
        .rst_ni,
        .restart_i(cmd_start),
        .limit_i  (homed_q ? cmd_limit_q : CmdBits'(INIT_PHASES)),
        .past_o   (past)
    );

    assign home_past = past && !homed_q;
    assign cmd_past  = past && homed_q && cmd_busy_q;
    assign home_o    = home_past && !initialised_i;
    assign ready_o   = cmd_past && held_q.init;

    always_comb begin
      act_o = now;
      if (cmd_past) act_o = act_o | held_q;
      act_o.init = now.init;
    end

    // ---- motion --------------------------------------------------------------------------------------

    logic first_q, ending_q, last_q, mot_past, open_past;
    logic [MotBits-1:0] first_limit_q, busy_limit_q, open_limit_q, growth;
    logic unused_bits;

    if (RampTimes) begin : g_triangle
      logic [21:0] pulses;

      assign pulses = 22'(params_i[31:8]) + 22'd1;  // of a triangle: fits
      assign growth = (params_i[31:8] < 24'({steps_i, 1'b0})) ? MotBits'((pulses * 22'd123) >> 4) : '0;
    end else begin : g_level
      logic unused_steps;

      assign unused_steps = &{1'b0, steps_i};
      assign growth       = '0;
    end

    always_ff @(posedge clk_i or negedge rst_ni) begin
      if (!rst_ni) begin
        first_q       <= 1'b0;
        ending_q      <= 1'b0;
        first_limit_q <= '0;
        busy_limit_q  <= '0;
        open_limit_q  <= '0;
      end else begin
        if (act_i.start) begin
          first_q <= 1'b1;
          unique case (op_code.op)
            OP_SINGLE:    first_limit_q <= MotBits'(FIRST_SINGLE);
            OP_ACC_DEC:   first_limit_q <= MotBits'(FIRST_RAMP) + growth;
            OP_CONT_HIGH: first_limit_q <= MotBits'(FIRST_RAMP);
            default:      first_limit_q <= MotBits'(FIRST_CONSTANT);
          endcase
        end else if (pulse_i || stop_i) begin
          first_q <= 1'b0;
        end
        if (stop_i) begin
          ending_q     <= 1'b1;
          busy_limit_q <= ramp_i ? MotBits'(END_RAMP) : MotBits'(END_BUSY);
          open_limit_q <= ramp_i ? MotBits'(END_RAMP) : MotBits'(END_OPEN);
        end else if (pulse_i && last_i) begin
          ending_q     <= 1'b1;
          busy_limit_q <= final_i ? MotBits'(END_BUSY) : MotBits'(END_RAMP);
          open_limit_q <= final_i ? MotBits'(END_OPEN) : MotBits'(END_RAMP);
          if (single_i) open_limit_q <= MotBits'(END_BUSY);
        end else if (ending_q && open_past && !last_q) begin
          ending_q <= 1'b0;
        end
      end
    end

    // One count, two ends: the fall of BUSY and the opening of the mailbox. After a pulse it starts with the
    // change of the pins.
    logic mot_restart;

    always_ff @(posedge clk_i or negedge rst_ni) begin
      if (!rst_ni) last_q <= 1'b0;
      else last_q <= pulse_i && last_i;
    end

    assign mot_restart = act_i.start || stop_i || last_q;

    ppmc_xtal_timer #(
        .ClkHz (ClkHz),
        .XtalHz(XtalHz),
        .Width (MotBits)
    ) u_motion (
        .clk_i,
        .rst_ni,
        .restart_i(mot_restart),
        .limit_i  (first_q ? first_limit_q : busy_limit_q),
        .past_o   (mot_past)
    );

    ppmc_xtal_timer #(
        .ClkHz (ClkHz),
        .XtalHz(XtalHz),
        .Width (MotBits)
    ) u_open (
        .clk_i,
        .rst_ni,
        .restart_i(mot_restart),
        .limit_i  (open_limit_q),
        .past_o   (open_past)
    );

    assign unused_bits = &{1'b0, op_code, params_i};
    assign open_o      = !cmd_busy_q && !ending_q && !building_i;
    assign go_o        = mot_past;
    assign linger_o    = !mot_past || last_q;
  end

endmodule

`default_nettype wire
