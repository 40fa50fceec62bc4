// SPDX-License-Identifier: Apache-2.0
// pmc006_settings_fv: proves that a write changes only its register, and that a reply reads this register
// from the RAM.
`include "ppmc_fv.svh"
`include "common/ppmc_lemma.svh"
`default_nettype none

module pmc006_settings_fv
  import pmc006_pkg::*;
(
    input wire logic        clk_i,
    input wire logic        power_i,
    input wire exec_cmd_t   cmd_i,
    input wire reg_access_t access_i,
    input wire logic        write_i,
    input wire logic        sample_i
);

  motor_settings_t settings_o;
  control_settings_t control_o;
  logic [13:0] value_o;

  `FV_RESET
  `FV_ANY_START(power_i)

  pmc006_settings dut (
      .rst_ni(rst_dut_n),
      .*
  );

  localparam int unsigned First = 32'(RegMstep), None = 32'(RegNone);

  // Value of each register; 0: no register.
  function automatic logic [None:0][13:0] values(motor_settings_t s, control_settings_t c);
    values             = '0;
    values[RegMstep]   = 14'(s.mstep);
    values[RegCurrent] = 14'(s.cur);
    values[RegAcc]     = 14'(s.acc);
    values[RegDec]     = 14'(s.dec);
    values[RegAutodec] = 14'(s.autodec);
    values[RegAtt]     = 14'(s.att);
    values[RegVstart]  = 14'(s.vstart);
    values[RegVstop]   = 14'(s.vstop);
    values[RegCcomp]   = 14'(s.ccomp);
    values[RegScomp]   = 14'(s.scomp);
    values[RegVmax]    = s.vmax;
    values[RegDir]     = 14'(s.dir);
    values[RegFree]    = 14'(s.free);
    values[RegAddr]    = 14'(c.addr);
    values[RegTrigger] = 14'(c.trigm);
    values[RegExten]   = 14'(c.exten);
    values[RegOffline] = 14'(c.offline);
    values[RegStlen]   = 14'(c.stlen);
    values[RegStcfg]   = 14'(c.stcfg);
    values[RegStlvl]   = 14'(c.stlvl);
  endfunction

  localparam logic [None:0][13:0] Ones = values('1, '1);
  localparam logic [None:0][13:0] Factory = values(SETTINGS_RESET, CONTROL_RESET);

  logic [None:0][13:0] now, last_q, words;  // words: contents of the RAM
  logic [None:0] copies, fills, wrong;
  logic [13:0] data, sampled_q;
  logic write, write_q, fresh_q, kept_q;  // kept_q: no reset since the last cycle
  reg_access_t access_q;
  logic [13:0] data_q;
  logic [4:0] count;
  logic filling;

  assign now = values(settings_o, control_o);
  assign write = write_i && access_i.write;
  assign count = dut.u_reply_ram.count_q[4:0];
  assign filling = dut.u_reply_ram.filling;
  for (genvar n = 0; n <= None; n++) begin : g_words
    assign words[n] = dut.u_reply_ram.words[n];
  end

  always_comb begin
    data = cmd_i.data[13:0];
    if (cmd_i.op == I_ACC && data == 14'd6) data = 14'd5;
    if (cmd_i.op == I_EXTEN && cmd_i.source != FromFrame) data[1] = data[0];
  end

  // The upper half of the RAM, which fills the lower half after a reset.
  logic [31:0] source;
  for (genvar n = 0; n < 32; n++) begin : g_source
    if (n >= First - 1 && n < None) assign source[n] = dut.u_reply_ram.words[32+n] == Factory[n+1];
    else assign source[n] = n > None - 1 && n < 31 ? dut.u_reply_ram.words[32+n] == '0 : 1'b1;
  end

  always_comb
    for (int unsigned n = 0; n <= None; n++) begin
      copies[n] = n < First || words[n] == now[n];
      fills[n]  = n < First || n >= 32'(count) || words[n] == now[n];
    end

  always_ff @(posedge clk_i) begin
    {last_q, write_q, access_q, data_q} <= {now, write, access_i, data};
    if (sample_i) sampled_q <= now[access_i.reg_id];
  end
  always_ff @(posedge clk_i or negedge rst_dut_n)
    if (!rst_dut_n) {fresh_q, kept_q} <= '0;
    else {fresh_q, kept_q} <= {sample_i || fresh_q, 1'b1};

  // verilog_format: off
  `FV_ASSUME(
      a_register,
      access_i.reg_id inside {[5'(First) : 5'(None)]} && (access_i.reg_id != RegNone || !access_i.write))
  `FV_ASSUME(
      legal_data,
      !write || ((data & ~Ones[access_i.reg_id]) == '0 && (cmd_i.op != I_ACC || data <= 14'd6)))
  `FV_ASSUME(
      register_of_op,
      !write || ((cmd_i.op == I_ACC) == (access_i.reg_id == RegAcc) && (cmd_i.op == I_EXTEN)
          == (access_i.reg_id == RegExten)))
  // verilog_format: on
  `FV_ASSUME(filled_in_time, !filling || !(write_i || sample_i))

  `FV_LEMMA(lemma_source, source == '1)
  // verilog_format: off
  `FV_LEMMA(
      lemma_filling,
      !filling || (!fresh_q && now == Factory && fills == '1 && (count < 5'(First) || count > 5'(None)
          || value_o == Factory[count])))
  // verilog_format: on
  `FV_LEMMA(lemma_count, !filling || count != '0)
  `FV_LEMMA(lemma_copies, filling || copies == '1)

  always_comb
    for (int unsigned n = 0; n <= None; n++)
      wrong[n] = now[n] != ((write_q && 5'(n) == access_q.reg_id) ? data_q : last_q[n]);

  `FV_LEMMA(write_changes_one, !kept_q || wrong == '0)
  `FV_LEMMA(reply_of_the_register, !fresh_q || value_o == sampled_q)
  `FV_COVER(seen_reply, fresh_q && value_o == 14'd9 && write_q)

endmodule

`default_nettype wire
