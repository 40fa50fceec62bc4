// SPDX-License-Identifier: Apache-2.0
// ppmc104_pace: when a taken byte takes effect: at once (FAST), or after the old chip's processing times
// (DATASHEET).
// Rules:  P104-DS-01..12, P104-DS-14, P104-HSK-03/04; P104-LIM-01 (the guard is never blinded).
// Timing: DATASHEET times run from the C-event (2 clk after the write event) or from the pulse or decision
//         they belong to; what they release happens one clk after the nominal time.
// How:    three timers: one for the command at hand (mailbox closed), one for the motion (pulse 1, end), one
//         for a slow-down limit.
`default_nettype none

module ppmc104_pace
  import ppmc104_pkg::*;
  import ppmc_op_pkg::*;
  import ppmc_motion_pkg::*;
#(
    parameter bit          Datasheet = 1'b0,
    parameter int unsigned ClkHz     = 16_000_000,
    parameter int unsigned XtalHz    = 16_000_000
) (
    input  wire logic                    clk_i,
    input  wire logic                    rst_ni,
    // command unit, at the C-event
    input  wire action_t                 act_i,
    input  wire logic    [          7:0] code_i,
    input  wire logic    [         31:0] params_i,
    input  wire logic    [          7:0] code_held_i,    // the same afterwards
    input  wire logic    [         31:0] params_held_i,
    input  wire base_t                   base_i,         // base clock as it is selected now
    output logic                         open_o,         // bytes may be taken
    output logic                         stops_only_o,   // of those, stop commands only
    // when it takes effect
    output action_t                      act_o,
    output logic         [          7:0] code_o,
    output logic         [         31:0] params_o,
    output base_t                        base_o,
    // initialisation
    input  wire logic                    initialised_i,
    input  wire logic                    building_i,     // ramp table
    input  wire logic    [STEP_BITS-1:0] steps_i,        // PA in force
    output logic                         home_o,         // phases to index 0, first initialisation
    output logic                         ready_o,        // initialisation complete
    // motion
    input  wire logic                    moving_i,
    input  wire logic                    running_i,
    input  wire logic                    top_i,
    input  wire op_t                     op_run_i,
    input  wire base_t                   base_run_i,
    input  wire logic    [RATE_BITS-1:0] rate_i,
    input  wire logic                    slow_seen_i,
    input  wire logic                    stop_i,
    input  wire logic                    pulse_i,
    input  wire logic                    last_i,
    input  wire logic                    final_i,
    output logic                         slow_o,         // act on a slow-down limit
    output logic                         go_o,           // pulse 1 may come
    output logic                         linger_o        // the motion must not end yet
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
  localparam int unsigned FLAG_LIMIT = 12 * 16;
  localparam int unsigned FLAG_LIMIT_TOP = 17 * 16;
  localparam int unsigned AUX = 14 * 16;
  localparam int unsigned EXC_OFF = 18 * 16;
  // Quanta; an interval shorter than this closes the mailbox.
  localparam int unsigned BRISK_POUT = 100;
  localparam int unsigned BRISK_PHASE = 148;

  localparam int unsigned CmdBits = ppmc_pkg::cnt_width(INIT_BASE + INIT_STEP * STEPS_MAX);
  localparam int unsigned MotBits = 18;  // 3200 + 123/16 of at most 2 PA pulses
  localparam int unsigned SlowBits = 9;

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
    assign stops_only_o = 1'b0;
    assign home_o = act_i.init && !initialised_i;
    assign ready_o = built_q && !building_i;
    assign slow_o = slow_seen_i;
    assign go_o = 1'b1;
    assign linger_o = 1'b0;
    assign unused_bits  = &{1'b0, code_held_i, params_held_i, steps_i, moving_i, running_i, top_i, op_run_i,
        base_run_i, rate_i, stop_i, pulse_i, last_i, final_i};
  end else begin : g_datasheet

    // The byte is gone when its time is up: its data come from behind the C-event.
    op_code_t op_code;
    logic [23:0] count;

    assign op_code  = op_code_t'(code_i);
    assign count    = params_i[31:8];
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
          decel: act_i.decel && !op_run_i.ramp,
          default: 1'b0
      };
      late = act_i & ~now;
      late.init = act_i.init;
      cmd_start = late != '0;
      cmd_limit = CmdBits'(AUX);
      if (act_i.exc_off) cmd_limit = CmdBits'(EXC_OFF);
      if (act_i.decel) cmd_limit = CmdBits'(FLAG_COMMAND);
      if (act_i.start) begin
        cmd_limit = (op_code.pout_only || op_code.op inside {OP_ACC_DEC, OP_CONT_HIGH}) ?
          CmdBits'(BUSY_RAMP) : CmdBits'(BUSY_CONSTANT);
      end
      if (act_i.init) begin
        cmd_limit = CmdBits'(INIT_BASE) +
            CmdBits'(INIT_STEP) * (CmdBits'(params_i[16+:STEP_BITS]) - CmdBits'(STEPS_MIN));
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
    logic [MotBits-1:0] first_limit_q, busy_limit_q, open_limit_q;
    logic [21:0] pulses;
    logic triangle;
    logic unused_bits;

    assign pulses   = 22'(count) + 22'd1;  // of a triangle: fits
    assign triangle = count < 24'({steps_i, 1'b0});

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
            OP_SINGLE: first_limit_q <= MotBits'(FIRST_SINGLE);
            OP_ACC_DEC, OP_CONT_HIGH: begin
              first_limit_q <= MotBits'(FIRST_RAMP);
              if (op_code.op == OP_ACC_DEC && triangle) begin
                first_limit_q <= MotBits'(FIRST_RAMP) + MotBits'((pulses * 22'd123) >> 4);
              end
            end
            default:   first_limit_q <= MotBits'(FIRST_CONSTANT);
          endcase
        end else if (pulse_i || stop_i) begin
          first_q <= 1'b0;
        end
        if (stop_i) begin
          ending_q     <= 1'b1;
          busy_limit_q <= op_run_i.ramp ? MotBits'(END_RAMP) : MotBits'(END_BUSY);
          open_limit_q <= op_run_i.ramp ? MotBits'(END_RAMP) : MotBits'(END_OPEN);
        end else if (pulse_i && last_i) begin
          ending_q     <= 1'b1;
          busy_limit_q <= final_i ? MotBits'(END_BUSY) : MotBits'(END_RAMP);
          open_limit_q <= final_i ? MotBits'(END_OPEN) : MotBits'(END_RAMP);
          if (op_run_i.single) open_limit_q <= MotBits'(END_BUSY);
        end else if (ending_q && open_past && !last_q) begin
          ending_q <= 1'b0;
        end
      end
    end

    // One count, two ends: the fall of BUSY and the opening of the mailbox. After a pulse it starts with the
    // fall of the pin.
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

    assign unused_bits = &{1'b0, op_code, op_run_i, params_i};
    assign go_o        = mot_past;
    assign linger_o    = !mot_past;

    // ---- slow-down limit -----------------------------------------------------------------------------

    logic slow_busy_q, slow_top_q, slow_past;

    always_ff @(posedge clk_i or negedge rst_ni) begin
      if (!rst_ni) begin
        slow_busy_q <= 1'b0;
        slow_top_q  <= 1'b0;
      end else if (!moving_i) begin
        slow_busy_q <= 1'b0;
      end else if (!slow_busy_q) begin
        slow_busy_q <= slow_seen_i;
        slow_top_q  <= top_i;
      end else if (slow_past) begin
        slow_busy_q <= 1'b0;
      end
    end

    ppmc_xtal_timer #(
        .ClkHz (ClkHz),
        .XtalHz(XtalHz),
        .Width (SlowBits)
    ) u_slow (
        .clk_i,
        .rst_ni,
        .restart_i(!slow_busy_q),
        .limit_i  (slow_top_q ? SlowBits'(FLAG_LIMIT_TOP) : SlowBits'(FLAG_LIMIT)),
        .past_o   (slow_past)
    );

    assign slow_o = slow_busy_q && slow_past;

    // ---- when the mailbox is open --------------------------------------------------------------------

    logic [13:0] interval;  // quanta of the running interval

    always_comb begin
      interval = (14'(rate_i) + 14'd1) << (base_run_i.slow ? 5 : 3);
      if (base_run_i.extra) interval = interval + 14'd30;
      stops_only_o = running_i && !base_run_i.external &&
        interval < (op_run_i.pout_only ? 14'(BRISK_POUT) : 14'(BRISK_PHASE));
      open_o = !cmd_busy_q && !ending_q && !building_i;
    end
  end

endmodule

`default_nettype wire
