// SPDX-License-Identifier: Apache-2.0
// ppmc_command_check: checks a byte of the host for a single-axis device. Returns the error number, the
//         actions, and the next state of the command unit.
// Rules:  P104-STA-04..06, P104-ERR-00..03, P104-HSK-07, P104-CMD-01..04, P104-INI-02..06, P104-STP-02..08,
//         P104-FSM-01..03; STMC-CMD-01..03, STMC-STP-01..05, STMC-FSM-01..04.
// Timing: combinational. The module that instantiates this block stores parser_o.
`default_nettype none

module ppmc_command_check
  import ppmc_code_pkg::*;
#(
    parameter bit Aux = 1'b1  // 1: during a motion, Excitation OFF acts as AUX ON; 0: it is rejected
) (
    input wire logic take_i,  // strobe: a byte is accepted
    input wire logic command_i,  // 1: byte_i was written as a command, 0: as data
    input wire logic [7:0] byte_i,  // byte from the host
    input wire logic [7:0] data_i,  // byte_i as a parameter, in the stored form
    input wire decoded_t decoded_i,  // byte_i decoded as a code
    input wire cmd_error_e param_error_i,  // error of the complete parameters; ErrUndefined: no error
    input wire logic is_checked_i,  // 1: param_error_i applies to the current code
    input wire logic busy_i,  // 1: a motion is in progress
    input wire logic ramp_i,  // 1: the running operation has a ramp
    input wire logic decelerating_i,  // 1: state DEC, or no pulse is left to output
    input wire logic initialised_i,  // 1: operations may start
    input wire parser_state_t parser_i,  // state before this byte
    output parser_state_t parser_o,  // state after this byte
    output action_t act_o,  // actions of this byte
    output logic stop_o  // 1: byte_i is a stop command, regardless of take_i
);

  logic allowed_busy, last_param, error;
  cmd_error_e number;
  logic unused_param;

  assign unused_param = ^parser_i.params[7:0];

  // P104-ERR-01 and P104-ERR-02 define the order of the checks.
  always_comb begin
    stop_o = decoded_i.kind inside {CmdHalt, CmdDecel};
    allowed_busy = decoded_i.kind inside {CmdAuxOut, CmdAuxOn, CmdAuxOff};
    if (Aux && decoded_i.kind == CmdExcOff) allowed_busy = 1'b1;
    last_param = !parser_i.error && parser_i.number == 3'd1;
    error = 1'b1;
    number = ErrUndefined;
    if (command_i) begin
      if (decoded_i.kind == CmdUndefined || (stop_o && !busy_i)) number = ErrUndefined;
      else if (busy_i && !stop_o && !allowed_busy) number = ErrBusy;
      else if (decoded_i.kind == CmdOperation && !initialised_i) number = ErrNotReady;
      else if (decoded_i.kind == CmdDecel && ramp_i && decelerating_i) number = ErrDecelAgain;
      else error = 1'b0;
    end else begin
      if (parser_i.error || parser_i.number == '0) number = busy_i ? ErrDataBusy : ErrData;
      else if (last_param && is_checked_i && param_error_i != ErrUndefined) number = param_error_i;
      else error = 1'b0;
    end
  end

  always_comb begin
    parser_o = parser_i;
    if (take_i) begin
      parser_o.error = error;
      if (error) parser_o.number = number;
      else parser_o.number = command_i ? decoded_i.params : parser_i.number - 1'b1;
      if (command_i) parser_o.code = byte_i;
      else parser_o.params = {data_i, parser_i.params[31:8]};
    end
  end

  // A code without parameters acts immediately. Any other code acts with its last parameter.
  always_comb begin
    act_o = '0;
    if (take_i && !error) begin
      if (command_i) begin
        act_o.start   = decoded_i.kind == CmdOperation && decoded_i.params == '0;
        act_o.halt    = decoded_i.kind == CmdHalt;
        act_o.decel   = decoded_i.kind == CmdDecel;
        act_o.exc_off = decoded_i.kind == CmdExcOff && !busy_i;
        act_o.aux_on  = decoded_i.kind == CmdAuxOn || (decoded_i.kind == CmdExcOff && busy_i);
        act_o.aux_off = decoded_i.kind == CmdAuxOff;
        act_o.read    = decoded_i.kind == CmdRead;
      end else if (last_param) begin
        act_o.init      = parser_i.code[7:6] == 2'b00;
        act_o.start     = parser_i.code[6];
        act_o.switching = parser_i.code[7:6] == 2'b10 && !parser_i.code[1];
        act_o.aux_out   = parser_i.code[7:6] == 2'b10 && parser_i.code[1];
      end
    end
  end

endmodule

`default_nettype wire
