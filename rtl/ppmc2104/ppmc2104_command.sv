// SPDX-License-Identifier: Apache-2.0
// ppmc2104_command: accepts bytes from the host, checks them, collects data bytes and issues the actions.
// Rules:  P2104-HSK-03/04/08, P2104-CMD-01..04, P2104-INI-02/03, P2104-STP-02..07, P2104-AUX-04,
//         P2104-ERR-01..05, P2104-LIM-06, P2104-FSM-01..05.
// Timing: take_o is the C-event: state changes of this block, act_o and charge_o take effect at the edge that
//         ends the cycle of take_o. The request of the byte and the check of its values are computed in the
//         cycle before; the states and pins of the axes are sampled in the cycle of take_o.
`include "ppmc_assert.svh"
`default_nettype none

module ppmc2104_command
  import ppmc2104_pkg::*;
  import ppmc_op_pkg::*;
(
    input  wire logic                clk_i,
    input  wire logic                rst_ni,
    // mailbox
    input  wire logic                ready_i,       // byte_i is available
    input  wire logic                command_i,     // 1: byte_i was written as a code, 0: as data
    input  wire logic       [   7:0] byte_i,        // byte from the host
    input  wire logic                open_i,        // bytes may be accepted
    output logic                     take_o,        // accept strobe, effective at the next rising edge
    // state of the axes
    input  wire state_t     [AXES:1] state_i,       // states of both axes
    input  wire levels_t    [AXES:1] levels_i,      // inputs of both axes, synchronised
    input  wire logic       [AXES:1] building_i,    // ramp table build; codes that need the table wait
    // rate limits (ppmc2104_speed)
    input  wire cmd_error_e          speed_i,       // rate-limit error of code_o with params_o
    // result
    output logic            [AXES:1] collecting_o,  // data bytes are outstanding
    output action_t                  act_o,         // actions of the accepted byte
    output charge_t                  charge_o,      // errors of the accepted byte
    output logic            [   7:0] code_o,        // code of the action
    output logic            [  31:0] params_o,      // data bytes of code_o, the last one in the high bits
    output logic            [   7:0] code_held_o,   // code_o after the C-event, valid until the next one
    output logic            [  31:0] params_held_o  // data bytes of code_held_o
);

  logic [2:0] awaited_q;  // data bytes outstanding
  logic [7:0] code_q;
  logic [31:0] params_q;
  logic awaited;

  assign awaited = awaited_q != '0;
  assign params_o = {byte_i, params_q[31:8]};
  assign params_held_o = params_q;
  assign code_held_o = code_q;
  assign code_o = command_i ? byte_i : code_q;
  assign collecting_o = {awaited && code_q[5], awaited && !code_q[5]};

  // ---- values of a last data byte -----------------------------------------------------------------

  cmd_error_e value;
  logic external, operation;
  setup_t setup;  // settings of the axis whose data bytes are collected
  init_code_t init_code;
  logic [RATE_BITS:0] gap;

  assign init_code = init_code_t'(code_q);
  assign operation = code_q[6];
  assign setup = code_q[5] ? state_i[2].setup : state_i[1].setup;
  assign external = (operation || setup.initialised) ? setup.external : init_code.external;
  assign gap = {1'b0, params_o[7:0]} - {1'b0, params_o[15:8]};

  always_comb begin
    value = ErrNone;
    if (operation) begin
      // The rate is the first of four bytes, or the only one.
      if (code_q[2] && !external && (code_q[1:0] == 2'b00 ? params_o[7:0] : params_o[31:24]) == '0) begin
        value = ErrRates;
      end
    end else if (!code_q[7]) begin
      if (params_o[31:16] > 16'(STEPS_MAX)) value = ErrSteps;
      if ((params_o[15:8] == '0 && !external) || gap[RATE_BITS] || gap < (RATE_BITS + 1)'(RATE_GAP) ||
          params_o[31:16] < 16'(STEPS_MIN)) begin
        value = ErrRates;
      end
    end else if (!code_q[0]) begin
      if (params_o[31:30] == 2'b00 || params_o[23:22] == 2'b00) value = ErrSwitching;
    end
  end

  // ---- request of the byte, one cycle before it is accepted ---------------------------------------

  typedef struct packed {
    axis_action_t act;        // actions if the state of the axis allows them
    logic         aux_out;
    logic         aux_in;
    cmd_error_e   error;      // error of the byte, regardless of the axis state
    logic         stop;       // stop instruction
    logic         abandons;   // stop that cancels outstanding data bytes
    logic         rest;       // the byte is an error while the axis is busy
    logic         operation;  // the byte is an error while the axis is not initialised
    logic         table_use;  // the instruction waits while the ramp table is being built
    logic         anyone;     // errors are charged to axis 1, regardless of second
    logic         second;     // the instruction is for axis 2
    logic         ccw;
    logic         origin;
    logic [2:0]   params;     // data bytes that follow
  } wish_t;

  decoded_t dec;
  op_code_t op_now;
  wish_t wish, wish_q;

  assign op_now = op_code_t'(code_o);
  assign dec = decode(byte_i);

  always_comb begin
    wish        = '0;
    wish.second = op_now.second;
    wish.ccw    = op_now.ccw;
    wish.origin = op_now.op == OP_ORIGIN;
    if (command_i) begin
      wish.stop      = dec.kind inside {CmdHalt, CmdDecel};
      wish.abandons  = awaited && wish.stop;
      wish.rest      = !wish.stop && !(dec.kind inside {CmdAuxOut, CmdAuxIn, CmdErrorRead});
      wish.operation = dec.kind == CmdOperation;
      wish.table_use = !awaited && dec.kind inside {CmdInit, CmdOperation, CmdExcOff};
      wish.anyone    = dec.kind inside {CmdAuxOut, CmdAuxIn};
      wish.params    = dec.params;
      if (awaited && !wish.stop) wish.error = ErrAbandoned;
      else if (dec.kind == CmdUndefined) wish.error = ErrUndefined;
      else if (dec.params == '0) begin
        wish.act.start   = dec.kind == CmdOperation;
        wish.act.halt    = dec.kind == CmdHalt;
        wish.act.decel   = dec.kind == CmdDecel;
        wish.act.exc_off = dec.kind == CmdExcOff;
        wish.act.read    = dec.kind inside {CmdRead, CmdErrorRead};
        wish.aux_out     = dec.kind == CmdAuxOut;
        wish.aux_in      = dec.kind == CmdAuxIn;
      end
    end else if (!awaited) begin
      wish.error  = ErrData;
      wish.anyone = 1'b1;
    end else if (awaited_q == 3'd1) begin
      wish.error = value;
      if (value == ErrNone) begin
        wish.act.start      = operation;
        wish.act.init       = !operation && !code_q[7];
        wish.act.switching  = !operation && code_q[7] && !code_q[0];
        wish.act.hold_delay = !operation && code_q[7] && code_q[0];
      end
    end
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) wish_q <= '0;
    else wish_q <= wish;
  end

  // ---- check against the state of the axes --------------------------------------------------------

  logic [AXES:1] mine, refused;
  logic waits, taken;
  logic unused_bits;

  assign waits = wish_q.table_use && (building_i & mine) != '0;
  assign take_o = ready_i && open_i && !waits;
  assign unused_bits = &{1'b0, op_now, init_code, setup, state_i, levels_i};

  for (genvar n = 1; n <= AXES; n++) begin : g_axis
    axis_action_t act;
    logic busy, limit, fine;

    assign busy       = state_i[n].busy;
    assign mine[n]    = wish_q.second == (n == 2);
    assign limit      = wish_q.ccw ? !levels_i[n].bl : !levels_i[n].fl;
    assign refused[n] = limit || !levels_i[n].alm || (wish_q.origin && !levels_i[n].org);
    assign fine       = state_i[n].setup.initialised && !refused[n] && speed_i == ErrNone;

    always_comb begin
      act           = wish_q.act;
      act.start     = wish_q.act.start && !busy && fine;
      act.halt      = wish_q.act.halt && busy;
      act.decel     = wish_q.act.decel && state_i[n].decel_ok;
      act.exc_off   = wish_q.act.exc_off && !busy;
      act.read      = wish_q.act.read && !(wish_q.rest && busy);
      act_o.axis[n] = (take_o && mine[n]) ? act : '0;
    end
  end

  assign act_o.aux_out = take_o && wish_q.aux_out;
  assign act_o.aux_in  = take_o && wish_q.aux_in;

  // ---- errors: order of the checks as in P2104-ERR-04/05 ------------------------------------------

  logic busy, decel_ok, initialised, error;  // states of the addressed axis
  cmd_error_e number;

  assign busy = wish_q.second ? state_i[2].busy : state_i[1].busy;
  assign decel_ok = wish_q.second ? state_i[2].decel_ok : state_i[1].decel_ok;
  assign initialised = wish_q.second ? state_i[2].setup.initialised : state_i[1].setup.initialised;

  always_comb begin
    number = wish_q.error;
    if (wish_q.stop) begin
      if (wish_q.act.decel && busy && !decel_ok) number = ErrDecel;
      else if (wish_q.abandons) number = ErrAbandoned;
      else if (!busy) number = initialised ? ErrStopped : ErrInitial;
    end else if (wish_q.error == ErrNone) begin
      if (wish_q.rest && busy) number = ErrBusy;
      else if (wish_q.operation && !initialised) number = ErrInitial;
      else if (wish_q.act.start && speed_i != ErrNone) number = speed_i;
      else if (wish_q.act.start && (refused & mine) != '0) number = ErrRefused;
    end
    error = number != ErrNone;
    taken = take_o && error;
    charge_o.number = number;
    charge_o.axis[1] = taken && (!wish_q.second || wish_q.anyone);
    charge_o.axis[2] = taken && wish_q.second && !wish_q.anyone;
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      awaited_q <= '0;
      code_q    <= '0;
      params_q  <= '0;
    end else if (take_o) begin
      if (command_i) begin
        awaited_q <= error ? '0 : wish_q.params;
        code_q    <= byte_i;
      end else begin
        if (awaited) awaited_q <= awaited_q - 1'b1;
        params_q <= params_o;
      end
    end
  end

`ifndef SYNTHESIS
  logic [AXES:1] starts, halts, acts, running;

  for (genvar n = 1; n <= AXES; n++) begin : g_check
    assign starts[n]  = act_o.axis[n].start;
    assign halts[n]   = act_o.axis[n].halt;
    assign acts[n]    = act_o.axis[n] != '0;
    assign running[n] = state_i[n].busy;
  end

  `PPMC_ASSERT(p2104_opr_01, (starts & running) == '0)
  `PPMC_ASSERT(p2104_opr_10, acts != '1)
  `PPMC_ASSERT(p2104_err_03, !taken || number == ErrAbandoned || act_o == '0)
  `PPMC_ASSERT(p2104_err_04,
               !take_o || error || act_o != '0 || wish_q.params != '0 || (!command_i && awaited_q > 1))
  `PPMC_ASSERT(p2104_stp_07, !(take_o && wish_q.act.halt && busy) || halts != '0)
`endif

endmodule

`default_nettype wire
