// SPDX-License-Identifier: Apache-2.0
// ppmc_command: takes the bytes of the host, judges them, collects parameters and says what to do; for the parts
// with one axis.
// Rules:  P104-STA-01..07, P104-ERR-00..03, P104-HSK-03/07, P104-CMD-01..04, P104-INI-02..06,
//         P104-STP-02..08, P104-FSM-01..03; STMC-CMD-01..03, STMC-STP-01..05, STMC-FSM-01..04.
// Timing: take_o is the C-event: everything this block changes, and act_o, belongs to the edge that ends that
//         cycle. decoded_i, data_i and value_i are combinational; they are used a clk later.
`include "ppmc_assert.svh"
`default_nettype none

module ppmc_command
  import ppmc_code_pkg::*;
(
    input wire logic clk_i,
    input wire logic rst_ni,
    // mailbox
    input wire logic ready_i,  // a byte is there
    input wire logic command_i,  // it was written as a command
    input wire logic [7:0] byte_i,  // the byte
    input wire logic open_i,  // bytes may be taken
    input wire logic stops_only_i,  // of those, stop commands only
    output logic take_o,  // it is taken at the coming edge
    // what the bytes mean in this part
    input wire decoded_t decoded_i,  // byte_i as a code
    input wire logic [7:0] data_i,  // byte_i as a parameter is kept
    input wire error_e value_i,  // what is wrong with params_o; ErrUndefined: nothing
    input wire logic judged_i,  // value_i counts for the code at hand; used at once
    // state of the part
    input wire logic busy_i,  // a motion is under way
    input wire logic ramp_i,  // running operation has a ramp
    input wire logic decelerating_i,  // DEC, or pulses over
    input wire logic initialised_i,  // operations may start
    // result
    output logic [3:0] status_o,  // ERR, NUM
    output action_t act_o,  // what the taken byte makes happen
    output logic [7:0] code_o,  // code the action belongs to
    output logic [31:0] params_o,  // its parameter bytes, the last one in the high bits
    output logic [7:0] code_held_o,  // the same after the C-event, while no byte is taken
    output logic [31:0] params_held_o  // parameters of code_held_o
);

  decoded_t dec_q;  // of byte_i, a clk behind it
  error_e   value_q;  // as dec_q: the byte stands still for a clk before it is taken
  asking_t asking_q, asking;
  logic stop;

  assign status_o = {asking_q.error, asking_q.number};
  assign params_o = {data_i, asking_q.params[31:8]};
  assign params_held_o = asking_q.params;
  assign code_held_o = asking_q.code;
  assign code_o = command_i ? byte_i : asking_q.code;
  assign take_o = ready_i && open_i && (!stops_only_i || (command_i && stop));

  ppmc_judge u_judge (
      .take_i   (take_o),
      .command_i,
      .byte_i,
      .data_i,
      .decoded_i(dec_q),
      .value_i  (value_q),
      .judged_i,
      .busy_i,
      .ramp_i,
      .decelerating_i,
      .initialised_i,
      .asking_i (asking_q),
      .asking_o (asking),
      .act_o,
      .stop_o   (stop)
  );

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      dec_q    <= '0;
      value_q  <= ErrUndefined;
      asking_q <= '0;
    end else begin
      dec_q    <= decoded_i;
      value_q  <= value_i;
      asking_q <= asking;
    end
  end

`ifndef SYNTHESIS
  `PPMC_ASSERT(p104_opr_12, !(act_o.start && busy_i))
  `PPMC_ASSERT(p104_err_03, !(take_o && asking.error) || act_o == '0)
`endif

endmodule

`default_nettype wire
