// SPDX-License-Identifier: Apache-2.0
// ppmc_wishbone_fv: proves the slave rules of Wishbone B4 classic cycles for any master that follows the
// rules for masters. Each access reaches the device once, and receives its response in time.
`include "ppmc_fv.svh"
`default_nettype none

module ppmc_wishbone_fv (
    input wire logic        clk_i,
    input wire logic        cyc_i,
    input wire logic        stb_i,
    input wire logic        we_i,
    input wire logic [ 1:0] adr_i,
    input wire logic [ 3:0] sel_i,
    input wire logic [31:0] dat_i,
    input wire logic [ 7:0] d_i,
    input wire logic        int_ni
);

  logic [31:0] dat_o;
  logic [ 7:0] d_o;
  logic ack_o, err_o, irq_o, cs_no, rd_no, wr_no, a_o, answer;

  `FV_RESET

  ppmc_wishbone dut (.*);

  assign answer = ack_o || err_o;

  // Rule 3.25: STB only within CYC. Rule 3.60: a request is stable until its response. However, a master
  // may abort.
  `FV_ASSUME(strobe_in_cycle, cyc_i || !stb_i)
  `FV_ASSUME(request_stands, !$past(rst_ni && stb_i && !answer)
             || !stb_i || {we_i, adr_i, sel_i, dat_i} == $past({we_i, adr_i, sel_i, dat_i}))

  logic [4:0] wait_q;  // cycles since the request became valid
  logic [1:0] cycles_q;  // strobe accesses that ended during the request, saturates at 3
  logic stood_q;  // 1: one cycle ago, the request was valid and had no response

  always_ff @(posedge clk_i)
    if (!rst_ni || !stb_i || answer) {wait_q, cycles_q} <= '0;
    else begin
      wait_q <= wait_q + 1'b1;
      if (dut.done && dut.waiting_q && cycles_q != '1) cycles_q <= cycles_q + 1'b1;
    end

  always_ff @(posedge clk_i) stood_q <= rst_ni && stb_i && !answer;

  logic as_asked;  // 1: the strobe matches the request
  assign as_asked = a_o == adr_i[0] && !adr_i[1] && wr_no != we_i && (!we_i || d_o == dat_i[7:0]);

  `FV_ASSERT(wb_rule_3_35_answer_to_a_strobe, !answer || (cyc_i && stb_i))
  `FV_ASSERT(wb_rule_3_45_one_answer, !(ack_o && err_o))
  `FV_ASSERT(answered_in_time, wait_q <= 5'd20)
  `FV_ASSERT(not_in_the_first_clk, !answer || stood_q)
  `FV_ASSERT(no_second_strobe, cycles_q == '0)
  `FV_ASSERT(error_for_the_reserved_alone, !err_o || (adr_i[1] && (we_i || adr_i[0])))
  `FV_ASSERT(own_register, !(ack_o && adr_i[1] && sel_i[0]) || dat_o[31:1] == '0)
  `FV_ASSERT(strobe_as_asked, cs_no || !dut.waiting_q || !stb_i || as_asked)
  `FV_COVER(seen_read, ack_o && !we_i && !adr_i[1] && sel_i[0] && dat_o == 32'hA5)
  `FV_COVER(seen_error, err_o)

endmodule

`default_nettype wire
