// SPDX-License-Identifier: Apache-2.0
// ppmc_proc_time: delays the effect of an accepted byte in a single-axis device. With FAST, there is no
//         delay. With DATASHEET, the delays are the processing times of the old chip.
// Rules:  P104-DS-01..12, P104-DS-14, P104-HSK-03/04; STMC-DS-01..14, STMC-INI-07.
// Timing: a DATASHEET time starts at the C-event (acceptance of a byte, 2 cycles after the write event), or
//         at the pulse or decision to which the time belongs. The delayed event occurs one cycle
//         after the nominal time.
// How:    two timers: one for the current command (during which the mailbox is closed), and one for the
//         motion (pulse 1, end).
`default_nettype none

module ppmc_proc_time
  import ppmc_code_pkg::*;
  import ppmc_op_pkg::*;
#(
    parameter bit Datasheet = 1'b0,
    parameter int unsigned ClkHz = 16_000_000,
    parameter int unsigned XtalHz = 16_000_000,
    parameter int unsigned StepBits = 14,  // bits of PA
    parameter int unsigned StepsMin = 4,  // smallest PA; initialisation with this PA takes 16.5 ms
    parameter int unsigned StepsMax = 11_220,  // largest PA
    parameter bit RampTimes = 1'b1  // 1: extra time for a stop in a ramp and for a triangular profile
) (
    input  wire logic                   clk_i,
    input  wire logic                   rst_ni,
    // command unit, at the C-event
    input  wire action_t                act_i,          // actions requested by the byte
    input  wire logic    [         7:0] code_i,         // code of act_i
    input  wire logic    [        31:0] params_i,       // parameters of code_i; valid only at the C-event
    input  wire logic    [         7:0] code_held_i,    // code_i of the last C-event
    input  wire logic    [        31:0] params_held_i,  // parameters of code_held_i
    input  wire logic    [         2:0] base_i,         // base clock that is currently selected
    output logic                        open_o,         // 1: a byte may be accepted
    // actions when they take effect
    output action_t                     act_o,          // actions, effective at the next edge
    output logic         [         7:0] code_o,         // code of act_o
    output logic         [        31:0] params_o,       // parameters of act_o
    output logic         [         2:0] base_o,         // base clock of the operation that starts
    // initialisation
    input  wire logic                   initialised_i,  // 1: an initialisation has been completed
    input  wire logic                   building_i,     // 1: the ramp table is being built
    input  wire logic    [StepBits-1:0] steps_i,        // current PA
    output logic                        phase_init_o,   // strobe: first initialisation, set phases to index 0
    output logic                        ready_o,        // strobe: the initialisation is complete
    // motion
    input  wire logic                   ramp_i,         // 1: the running operation has a ramp
    input  wire logic                   single_i,       // 1: the running operation is a single step
    input  wire logic                   stop_i,         // strobe: immediate end at the next edge
    input  wire logic                   pulse_i,        // strobe: pulse event at the next edge
    input  wire logic                   last_i,         // with pulse_i: it is the last pulse
    input  wire logic                   final_i,        // with pulse_i: the count is complete
    output logic                        go_o,           // 1: pulse 1 may occur
    output logic                        end_delay_o     // 1: the motion must not end yet
);

  // Times in crystal cycles: microseconds times 16.
  localparam int unsigned InitPhasesXtal = 44 * 16;
  localparam int unsigned BusyConstantXtal = 27 * 16;
  localparam int unsigned BusyRampXtal = 112 * 16;
  localparam int unsigned FlagCommandXtal = 17 * 16;
  localparam int unsigned AuxXtal = 14 * 16;
  localparam int unsigned ExcOffXtal = 18 * 16;

  localparam int unsigned CommandBits = ppmc_lfsr_pkg::width(ppmc_pkg::cyc(BusyRampXtal, ClkHz, XtalHz) - 1);

  // State of the counter one tick before the end of a time of `xtal_cycles` crystal cycles.
  function automatic logic [CommandBits-1:0] last_state(int unsigned xtal_cycles);
    return CommandBits'(ppmc_lfsr_pkg::after(ppmc_pkg::cyc(xtal_cycles, ClkHz, XtalHz) - 1, CommandBits));
  endfunction

  if (!Datasheet) begin : g_fast
    logic built_q;  // building_i, delayed by one cycle
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
    assign phase_init_o = act_i.init && !initialised_i;
    assign ready_o = built_q && !building_i;
    assign go_o = 1'b1;
    assign end_delay_o = 1'b0;
    assign unused_bits = &{1'b0, code_held_i, params_held_i, steps_i, ramp_i, single_i, stop_i, pulse_i,
                           last_i, final_i};
  end else begin : g_datasheet

    // When the time of a command has passed, its byte has left the mailbox. Therefore the held code and
    // parameters are used.
    op_code_t op_code, op_held;
    logic ramp;  // 1: the requested operation has a ramp
    logic unused_bits;

    assign op_code     = op_code_t'(code_i);
    assign op_held     = op_code_t'(code_held_i);
    assign ramp        = op_held.op inside {OP_ACC_DEC, OP_CONT_HIGH};
    assign code_o      = code_held_i;
    assign params_o    = params_held_i;
    assign unused_bits = &{1'b0, op_code, op_held, params_i};

    always_ff @(posedge clk_i or negedge rst_ni) begin
      if (!rst_ni) base_o <= '0;
      else if (act_i.start) base_o <= base_i;
    end

    // ---- current command -----------------------------------------------------------------------------

    action_t immediate, delayed, delayed_q;
    logic cmd_busy_q, cmd_past, phase_init_past, phase_init_done_q, cmd_start, past;
    logic init_past, closed;
    logic [CommandBits-1:0] cmd_last;

    // A deceleration stop that acts as an immediate stop has no separate processing time (P104-DS-14).
    always_comb begin
      immediate = '{
          init: act_i.init,
          halt: act_i.halt,
          switching: act_i.switching,
          read: act_i.read,
          decel: act_i.decel && !(RampTimes && ramp_i),
          default: 1'b0
      };
      delayed = act_i & ~immediate;
      delayed.init = act_i.init;
      cmd_start = delayed != '0;
    end

    localparam logic [CommandBits-1:0] LastAux = last_state(AuxXtal);
    localparam logic [CommandBits-1:0] LastExcOff = last_state(ExcOffXtal);
    localparam logic [CommandBits-1:0] LastDecel = last_state(FlagCommandXtal);
    localparam logic [CommandBits-1:0] LastRamp = last_state(BusyRampXtal);
    localparam logic [CommandBits-1:0] LastConstant = last_state(BusyConstantXtal);
    localparam logic [CommandBits-1:0] LastPhases = last_state(InitPhasesXtal);

    // The mailbox is closed during a processing time, so the code is stable.
    always_comb begin
      cmd_last = LastAux;
      if (delayed_q.exc_off) cmd_last = LastExcOff;
      if (delayed_q.decel) cmd_last = LastDecel;
      if (delayed_q.start) cmd_last = (op_held.pout_only || ramp) ? LastRamp : LastConstant;
      if (delayed_q.init) cmd_last = LastPhases;
    end

    always_ff @(posedge clk_i or negedge rst_ni) begin
      if (!rst_ni) begin
        delayed_q         <= '0;
        cmd_busy_q        <= 1'b0;
        phase_init_done_q <= 1'b1;
      end else if (cmd_start) begin
        delayed_q         <= delayed;
        cmd_busy_q        <= 1'b1;
        phase_init_done_q <= !act_i.init;
      end else begin
        if (cmd_past) cmd_busy_q <= 1'b0;
        if (phase_init_past) phase_init_done_q <= 1'b1;
      end
    end

    ppmc_timer #(
        .Width(CommandBits)
    ) u_command (
        .clk_i,
        .restart_i(cmd_start),
        .tick_i   (1'b1),
        .last_i   (cmd_last),
        .past_o   (past)
    );

    assign phase_init_past = past && !phase_init_done_q;
    assign cmd_past  = cmd_busy_q && (delayed_q.init ? init_past : past);
    assign phase_init_o    = phase_init_past && !initialised_i;
    assign ready_o   = init_past;

    always_comb begin
      act_o = immediate;
      if (cmd_past) act_o = act_o | delayed_q;
      act_o.init = immediate.init;
    end

    // ---- initialisation, motion ----------------------------------------------------------------------

    logic triangular;

    // triangular = 1: the number of pulses minus 1 (D in P104-DS-05) is below 2 * PA
    assign triangular = RampTimes && op_code.op == OP_ACC_DEC && params_i[31:23] == '0 && ppmc_pkg::less(
        32'(params_i[22:8]), 32'({steps_i, 1'b0})
    );

    ppmc_proc_time_motion #(
        .ClkHz    (ClkHz),
        .XtalHz   (XtalHz),
        .StepsMin (StepsMin),
        .StepsMax (StepsMax),
        .RampTimes(RampTimes)
    ) u_motion (
        .clk_i,
        .rst_ni,
        .init_i      (act_i.init),
        .start_i     (act_i.start),
        .triangular_i(triangular),
        .number_i    (params_i[23:8]),
        .ramp_i,
        .single_i,
        .stop_i,
        .pulse_i,
        .last_i,
        .final_i,
        .ready_o     (init_past),
        .go_o,
        .end_delay_o,
        .closed_o    (closed)
    );

    assign open_o = !cmd_busy_q && !closed && !building_i;
  end

endmodule

`default_nettype wire
