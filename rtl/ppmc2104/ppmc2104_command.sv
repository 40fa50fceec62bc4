// SPDX-License-Identifier: Apache-2.0
// ppmc2104_command: accepts bytes from the host, checks them, collects data bytes, and issues the actions.
// Rules:  P2104-HSK-03/04/08, P2104-CMD-01..04, P2104-INI-02/03, P2104-STP-02..07, P2104-AUX-04,
//         P2104-ERR-01..05, P2104-LIM-06, P2104-FSM-01..05.
// Timing: take_o marks the C-event, which is the acceptance of a byte. act_o, error_report_o and the state of
//         this block take effect at the edge that ends the cycle of take_o. The byte is decoded, and its
//         values are checked, one cycle earlier. The states and pins of the axes are sampled in the cycle of
//         take_o.
`include "ppmc_assert.svh"
`default_nettype none

module ppmc2104_command
  import ppmc2104_pkg::*;
  import ppmc_op_pkg::*;
(
    input wire logic clk_i,
    input wire logic rst_ni,
    // mailbox
    input wire logic ready_i,  // 1: byte_i is valid
    input wire logic command_i,  // 1: byte_i was written as a code, 0: as data
    input wire logic [7:0] byte_i,  // byte from the host
    input wire logic open_i,  // 1: a byte may be accepted
    output logic take_o,  // strobe: the byte is accepted at the next rising edge
    // state of the axes
    input wire axis_summary_t [AXES:1] state_i,  // states of both axes
    input wire pin_levels_t [AXES:1] levels_i,  // inputs of both axes, synchronised
    input wire logic [AXES:1] building_i,  // 1: the ramp table is being built; codes that need the table wait
    // rate limits (ppmc2104_speed)
    input wire cmd_error_e speed_i,  // rate-limit error of code_o with params_o
    // result
    output logic [AXES:1] collecting_o,  // 1: more data bytes are expected
    output action_t act_o,  // actions of the accepted byte
    output error_report_t error_report_o,  // errors of the accepted byte
    output logic [7:0] code_o,  // code of the action
    output logic [31:0] params_o,  // data bytes of code_o, the last in the high bits
    output logic [7:0] code_held_o,  // code_o of the last C-event
    output logic [31:0] params_held_o  // data bytes of code_held_o
);

  logic [2:0] params_left_q;  // data bytes that are still expected
  logic [7:0] code_q;
  logic [31:0] params_q;
  logic collecting;

  assign collecting = params_left_q != '0;
  assign params_o = {byte_i, params_q[31:8]};
  assign params_held_o = params_q;
  assign code_held_o = code_q;
  assign code_o = command_i ? byte_i : code_q;
  assign collecting_o = {collecting && code_q[5], collecting && !code_q[5]};

  // ---- check of the values when the last data byte arrives ----------------------------------------

  cmd_error_e value;
  logic external, operation;
  setup_t setup;  // settings of the axis that the code addresses
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
      // The rate is the first of four data bytes, or the only data byte.
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

  // ---- decoding of the byte, one cycle before it is accepted --------------------------------------

  typedef struct packed {
    axis_action_t act;             // actions, if the state of the axis allows them
    logic         aux_out;
    logic         aux_in;
    cmd_error_e   error;           // error of the byte, regardless of the state of the axis
    logic         stop;            // the byte is a stop instruction
    logic         cancels_params;  // stop instruction while data bytes are expected
    logic         needs_idle;      // the byte is an error while the axis is busy
    logic         needs_init;      // the byte is an error while the axis is not initialised
    logic         needs_table;     // the instruction waits while the ramp table is being built
    logic         no_axis;         // errors are reported for axis 1, regardless of `second`
    logic         second;          // the instruction is for axis 2
    logic         ccw;
    logic         origin;
    logic [2:0]   params;          // number of data bytes that follow
  } byte_request_t;

  decoded_t dec;
  op_code_t op_now;
  byte_request_t request, request_q;

  assign op_now = op_code_t'(code_o);
  assign dec = decode(byte_i);

  always_comb begin
    request        = '0;
    request.second = op_now.second;
    request.ccw    = op_now.ccw;
    request.origin = op_now.op == OP_ORIGIN;
    if (command_i) begin
      request.stop           = dec.kind inside {CmdHalt, CmdDecel};
      request.cancels_params = collecting && request.stop;
      request.needs_idle     = !request.stop && !(dec.kind inside {CmdAuxOut, CmdAuxIn, CmdErrorRead});
      request.needs_init     = dec.kind == CmdOperation;
      request.needs_table    = !collecting && dec.kind inside {CmdInit, CmdOperation, CmdExcOff};
      request.no_axis        = dec.kind inside {CmdAuxOut, CmdAuxIn};
      request.params         = dec.params;
      if (collecting && !request.stop) request.error = ErrAbandoned;
      else if (dec.kind == CmdUndefined) request.error = ErrUndefined;
      else if (dec.params == '0) begin
        request.act.start   = dec.kind == CmdOperation;
        request.act.halt    = dec.kind == CmdHalt;
        request.act.decel   = dec.kind == CmdDecel;
        request.act.exc_off = dec.kind == CmdExcOff;
        request.act.read    = dec.kind inside {CmdRead, CmdErrorRead};
        request.aux_out     = dec.kind == CmdAuxOut;
        request.aux_in      = dec.kind == CmdAuxIn;
      end
    end else if (!collecting) begin
      request.error   = ErrData;
      request.no_axis = 1'b1;
    end else if (params_left_q == 3'd1) begin
      request.error = value;
      if (value == ErrNone) begin
        request.act.start      = operation;
        request.act.init       = !operation && !code_q[7];
        request.act.switching  = !operation && code_q[7] && !code_q[0];
        request.act.hold_delay = !operation && code_q[7] && code_q[0];
      end
    end
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) request_q <= '0;
    else request_q <= request;
  end

  // ---- check against the state of the axes --------------------------------------------------------

  logic [AXES:1] addressed, refused;
  logic waits_for_table, error_stored;
  logic unused_bits;

  assign waits_for_table = request_q.needs_table && (building_i & addressed) != '0;
  assign take_o = ready_i && open_i && !waits_for_table;
  assign unused_bits = &{1'b0, op_now, init_code, setup, state_i, levels_i};

  for (genvar n = 1; n <= AXES; n++) begin : g_axis
    axis_action_t act;
    logic busy, limit, can_start;

    assign busy         = state_i[n].busy;
    assign addressed[n] = request_q.second == (n == 2);
    assign limit        = request_q.ccw ? !levels_i[n].bl : !levels_i[n].fl;
    assign refused[n]   = limit || !levels_i[n].alm || (request_q.origin && !levels_i[n].org);
    assign can_start    = state_i[n].setup.initialised && !refused[n] && speed_i == ErrNone;

    always_comb begin
      act           = request_q.act;
      act.start     = request_q.act.start && !busy && can_start;
      act.halt      = request_q.act.halt && busy;
      act.decel     = request_q.act.decel && state_i[n].decel_ok;
      act.exc_off   = request_q.act.exc_off && !busy;
      act.read      = request_q.act.read && !(request_q.needs_idle && busy);
      act_o.axis[n] = (take_o && addressed[n]) ? act : '0;
    end
  end

  assign act_o.aux_out = take_o && request_q.aux_out;
  assign act_o.aux_in  = take_o && request_q.aux_in;

  // ---- errors: the checks have the order of P2104-ERR-04/05 ----------------------------------------

  logic busy, decel_ok, initialised, error;  // state of the addressed axis
  cmd_error_e number;

  assign busy = request_q.second ? state_i[2].busy : state_i[1].busy;
  assign decel_ok = request_q.second ? state_i[2].decel_ok : state_i[1].decel_ok;
  assign initialised = request_q.second ? state_i[2].setup.initialised : state_i[1].setup.initialised;

  always_comb begin
    number = request_q.error;
    if (request_q.stop) begin
      if (request_q.act.decel && busy && !decel_ok) number = ErrDecel;
      else if (request_q.cancels_params) number = ErrAbandoned;
      else if (!busy) number = initialised ? ErrStopped : ErrInitial;
    end else if (request_q.error == ErrNone) begin
      if (request_q.needs_idle && busy) number = ErrBusy;
      else if (request_q.needs_init && !initialised) number = ErrInitial;
      else if (request_q.act.start && speed_i != ErrNone) number = speed_i;
      else if (request_q.act.start && (refused & addressed) != '0) number = ErrRefused;
    end
    error = number != ErrNone;
    error_stored = take_o && error;
    error_report_o.number = number;
    error_report_o.axis[1] = error_stored && (!request_q.second || request_q.no_axis);
    error_report_o.axis[2] = error_stored && request_q.second && !request_q.no_axis;
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      params_left_q <= '0;
      code_q    <= '0;
      params_q  <= '0;
    end else if (take_o) begin
      if (command_i) begin
        params_left_q <= error ? '0 : request_q.params;
        code_q    <= byte_i;
      end else begin
        if (collecting) params_left_q <= params_left_q - 1'b1;
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
  `PPMC_ASSERT(p2104_err_03, !error_stored || number == ErrAbandoned || act_o == '0)
  `PPMC_ASSERT(p2104_err_04,
               !take_o || error || act_o != '0 || request_q.params != '0 || (!command_i && params_left_q > 1))
  `PPMC_ASSERT(p2104_stp_07, !(take_o && request_q.act.halt && busy) || halts != '0)
`endif

endmodule

`default_nettype wire
