// SPDX-License-Identifier: Apache-2.0
// ppmc_command: accepts the bytes of the host in the single-axis devices. Checks them, collects parameters,
//         and outputs the actions.
// Rules:  P104-STA-01..07, P104-ERR-00..03, P104-HSK-03/07, P104-CMD-01..04, P104-INI-02..06,
//         P104-STP-02..08, P104-FSM-01..03; STMC-CMD-01..03, STMC-STP-01..05, STMC-FSM-01..04.
// Timing: take_o marks the C-event, which is the acceptance of a byte. act_o and the state of this block take
//         effect at the edge that ends the cycle of take_o. decoded_i and param_error_i are combinational
//         functions of the byte. This block registers them and uses them one cycle later. data_i and
//         is_checked_i are used in the same cycle.
`include "ppmc_assert.svh"
`default_nettype none

module ppmc_command
  import ppmc_code_pkg::*;
(
    input wire logic clk_i,
    input wire logic rst_ni,
    // mailbox
    input wire logic ready_i,  // 1: a byte is available
    input wire logic command_i,  // 1: byte_i was written as a command, 0: as data
    input wire logic [7:0] byte_i,  // byte from the host
    input wire logic open_i,  // 1: a byte may be accepted
    input wire logic stops_only_i,  // 1: only stop commands may be accepted
    output logic take_o,  // strobe: the byte is accepted at the next edge
    // meaning of the byte in this device
    input wire decoded_t decoded_i,  // byte_i decoded as a code
    input wire logic [7:0] data_i,  // byte_i as a parameter, in the stored form
    input wire cmd_error_e param_error_i,  // error in params_o; ErrUndefined: no error
    input wire logic is_checked_i,  // 1: param_error_i applies to the current code
    // state of the core
    input wire logic busy_i,  // 1: a motion is in progress
    input wire logic ramp_i,  // 1: the running operation has a ramp
    input wire logic decelerating_i,  // 1: state DEC, or no pulse is left to output
    input wire logic initialised_i,  // 1: operations may start
    // result
    output logic [3:0] status_o,  // status bits ERR and NUM
    output action_t act_o,  // actions of the accepted byte
    output logic [7:0] code_o,  // code of the action
    output logic [31:0] params_o,  // parameters of code_o; the last one is in bits 31:24
    output logic [7:0] code_held_o,  // code_o of the last C-event; valid until the next byte is accepted
    output logic [31:0] params_held_o  // parameters of code_held_o
);

  decoded_t   dec_q;  // decoded_i, delayed by one cycle
  cmd_error_e param_error_q;  // param_error_i, delayed by one cycle, in which the byte is stable
  parser_state_t parser_q, parser;
  logic stop;

  assign status_o = {parser_q.error, parser_q.number};
  assign params_o = {data_i, parser_q.params[31:8]};
  assign params_held_o = parser_q.params;
  assign code_held_o = parser_q.code;
  assign code_o = command_i ? byte_i : parser_q.code;
  assign take_o = ready_i && open_i && (!stops_only_i || (command_i && stop));

  ppmc_command_check u_check (
      .take_i   (take_o),
      .command_i,
      .byte_i,
      .data_i,
      .decoded_i(dec_q),
      .param_error_i  (param_error_q),
      .is_checked_i,
      .busy_i,
      .ramp_i,
      .decelerating_i,
      .initialised_i,
      .parser_i (parser_q),
      .parser_o (parser),
      .act_o,
      .stop_o   (stop)
  );

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      dec_q    <= '0;
      param_error_q  <= ErrUndefined;
      parser_q <= '0;
    end else begin
      dec_q    <= decoded_i;
      param_error_q  <= param_error_i;
      parser_q <= parser;
    end
  end

`ifndef SYNTHESIS
  `PPMC_ASSERT(p104_opr_12, !(act_o.start && busy_i))
  `PPMC_ASSERT(p104_err_03, !(take_o && parser.error) || act_o == '0)
`endif

endmodule

`default_nettype wire
