// SPDX-License-Identifier: Apache-2.0
// ppmc_command_fv: proves that a byte is accepted only if it is available and the mailbox is open, and that
// this byte was decoded one cycle before.
`include "ppmc_fv.svh"
`default_nettype none

module ppmc_command_fv
  import ppmc_code_pkg::*;
(
    input wire logic             clk_i,
    input wire logic             wr_i,
    input wire logic             wr_a0_i,
    input wire logic       [7:0] wr_data_i,
    input wire logic             open_i,
    input wire logic             stops_only_i,
    input wire decoded_t         decoded_byte_i,
    input wire cmd_error_e       param_error_i,
    input wire logic             is_checked_i,
    input wire logic             ended_i,
    input wire logic             ramp_i,
    input wire logic             decelerating_i,
    input wire logic             initialised_i
);

  logic ready_i, command_i, take_o, busy_i;
  logic [7:0] byte_i, data_i, code_o, code_held_o, out;
  logic [31:0] params_o, params_held_o;
  logic [3:0] status_o;
  logic obf, fresh, ibf;
  decoded_t decoded_i;
  action_t  act_o;

  `FV_RESET

  ppmc_command dut (.*);

  // The proof includes the mailbox from which this block reads, and a motion that this block starts.
  ppmc_mailbox u_mailbox (
      .rd_done_i(1'b0),
      .out_o    (out),
      .obf_o    (obf),
      .new_o    (fresh),
      .ibf_o    (ibf),
      .ready_o  (ready_i),
      .command_o(command_i),
      .byte_o   (byte_i),
      .take_i   (take_o),
      .load_i   (1'b0),
      .answer_i (24'd0),
      .long_i   (1'b0),
      .*
  );

  assign data_i = byte_i;
  always_ff @(posedge clk_i) busy_i <= rst_ni && (act_o.start || (busy_i && !ended_i));

  // The outputs of the decoder depend only on the byte, so they are stable while the byte is stable.
  assign decoded_i = decoded_byte_i;
  `FV_ASSUME(decoder_stands, $past(byte_i) != byte_i || $past(command_i)
             != command_i || decoded_byte_i == $past(decoded_byte_i))
  `FV_ASSUME(known_kind, decoded_byte_i.kind <= CmdAuxOff && decoded_byte_i.params <= 3'd4)
  logic has_params;  // 1: a code of this kind may have parameters
  assign has_params = decoded_byte_i.kind inside {CmdInit, CmdOperation, CmdSwitching, CmdAuxOut};
  `FV_ASSUME(params_of_rest, decoded_byte_i.params == '0 || has_params)
  `FV_ASSUME(codes_with_parameters,
             decoded_byte_i.params == '0 || (decoded_byte_i.kind == CmdOperation) == byte_i[6])
  `FV_ASSUME(code_of_aux, decoded_byte_i.kind != CmdAuxOut || byte_i[7:6] == 2'b10)

  `FV_ASSERT(p104_hsk_03_takes_ready_bytes, !take_o || (ready_i && open_i))
  `FV_ASSERT(stops_alone, !(take_o && stops_only_i) || act_o == '0 || act_o.halt || act_o.decel)
  `FV_ASSERT(p104_opr_12_no_start_in_a_motion, !(act_o.start && busy_i))
  `FV_ASSERT(meaning_is_of_the_byte, !(take_o && command_i) || dut.dec_q == decoded_byte_i)
  `FV_ASSERT(p104_sta_04_status_moves_with_a_byte, $past(take_o || !rst_ni) || status_o == $past(status_o))
  // The converse: no available byte is left, and each accepted byte has its effect.
  logic is_stop;  // the byte is a stop command
  assign is_stop = command_i && dut.dec_q.kind inside {CmdHalt, CmdDecel};
  `FV_ASSERT(p104_hsk_03_accepts, take_o == (ready_i && open_i && (!stops_only_i || is_stop)))
  `FV_ASSERT(no_action_without_a_byte, take_o || act_o == '0)

  logic [31:0] params_q;  // the last four bytes that were accepted as data
  logic [7:0] command_q;  // the last command that was accepted
  logic known_q;  // a command has been accepted
  always_ff @(posedge clk_i) begin
    if (!rst_ni) known_q <= 1'b0;
    else if (take_o && command_i) known_q <= 1'b1;
    if (take_o && command_i) command_q <= byte_i;
    if (!rst_ni) params_q <= '0;
    else if (take_o && !command_i) params_q <= {data_i, params_q[31:8]};
  end

  `FV_ASSERT(code_held, !known_q || code_held_o == command_q)
  `FV_ASSERT(params_held, params_held_o == params_q)
  `FV_ASSERT(code_of_the_action, code_o == (command_i ? byte_i : code_held_o))
  `FV_ASSERT(params_of_the_action, params_o == {data_i, params_q[31:8]})
  `FV_ASSERT(error_or_action, !(take_o && act_o != '0) || !dut.parser.error)
  `FV_ASSERT(p104_sta_04_missing,
             !(take_o && command_i && !dut.parser.error) || dut.parser.number == decoded_byte_i.params)
  `FV_ASSERT(status_after_a_byte, !$past(rst_ni && take_o) || status_o == $past
             ({dut.parser.error, dut.parser.number}))
  `FV_COVER(seen_start_with_three, act_o.start && !command_i)
  `FV_COVER(seen_halt, act_o.halt)

endmodule

`default_nettype wire
