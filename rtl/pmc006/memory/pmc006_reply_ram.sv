// SPDX-License-Identifier: Apache-2.0
// pmc006_reply_ram: copy of the parameter registers in a block RAM, which supplies the data of replies.
// Rules:  P006-CMD-50/52, P006-BAD-08; factory values: docs/pmc006/README.md, 4.
// Timing: a written value can be read in the next cycle. value_o follows sample_i by one cycle and is
//         stable until the next sample_i. A reset fills the RAM with the factory values, which takes 32
//         cycles.
// Assumes: write_i and sample_i are low during these 32 cycles.
`include "ppmc_assert.svh"
`default_nettype none

module pmc006_reply_ram
  import pmc006_pkg::*;
(
    input  wire logic             clk_i,
    input  wire logic             rst_ni,
    input  wire logic             write_i,   // strobe: write data_i to reg_id_i
    input  wire register_e        reg_id_i,  // register to be written or read
    input  wire logic      [13:0] data_i,    // value; valid with write_i
    input  wire logic             sample_i,  // strobe: read reg_id_i into value_o
    output logic           [13:0] value_o    // value of reg_id_i at the last sample_i; RegNone: 0
);

  function automatic logic [13:0] factory_value(logic [4:0] reg_id);
    unique case (reg_id)
      RegMstep:   return 14'(SETTINGS_RESET.mstep);
      RegCurrent: return 14'(SETTINGS_RESET.cur);
      RegAcc:     return 14'(SETTINGS_RESET.acc);
      RegDec:     return 14'(SETTINGS_RESET.dec);
      RegAutodec: return 14'(SETTINGS_RESET.autodec);
      RegAtt:     return 14'(SETTINGS_RESET.att);
      RegVstart:  return 14'(SETTINGS_RESET.vstart);
      RegVstop:   return 14'(SETTINGS_RESET.vstop);
      RegCcomp:   return 14'(SETTINGS_RESET.ccomp);
      RegScomp:   return 14'(SETTINGS_RESET.scomp);
      RegVmax:    return SETTINGS_RESET.vmax;
      RegDir:     return 14'(SETTINGS_RESET.dir);
      RegFree:    return 14'(SETTINGS_RESET.free);
      RegAddr:    return 14'(CONTROL_RESET.addr);
      RegTrigger: return 14'(CONTROL_RESET.trigm);
      RegExten:   return 14'(CONTROL_RESET.exten);
      RegOffline: return 14'(CONTROL_RESET.offline);
      RegStlen:   return 14'(CONTROL_RESET.stlen);
      RegStcfg:   return 14'(CONTROL_RESET.stcfg);
      RegStlvl:   return 14'(CONTROL_RESET.stlvl);
      default:    return '0;
    endcase
  endfunction

  // The upper half stores the factory values and is never written. A reset copies it to the lower half;
  // each value is written one cycle after it is read. Therefore the value of register n is stored at
  // address 32 + n - 1.
  function automatic logic [63:0][13:0] init_words();
    logic [63:0][13:0] table_words;
    table_words = '0;
    for (int unsigned i = 0; i < 31; i++) table_words[6'(32+i)] = factory_value(5'(i + 1));
    return table_words;
  endfunction

  localparam logic [63:0][13:0] InitWords = init_words();

  (* ram_style = "block", no_rw_check *)
  logic [13:0] words[64];
  logic [5:0] count_q;
  logic filling;

  initial for (int unsigned i = 0; i < 64; i++) words[i] = InitWords[6'(i)];

  assign filling = !count_q[5];

  // A reset fills the entries from 2 on, regardless of the previous RAM contents. Entries 0 and 1 are never
  // read.
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) count_q <= 6'd1;
    else if (filling) count_q <= count_q + 1'b1;
  end

  always_ff @(posedge clk_i) begin
    if (filling || write_i) words[{1'b0, filling?count_q[4:0] : reg_id_i}] <= filling ? value_o : data_i;
    if (filling || sample_i) value_o <= words[{filling, filling?count_q[4:0] : reg_id_i}];
  end

`ifndef SYNTHESIS
  `PPMC_ASSERT(reply_ram_filled_in_time, !filling || !(write_i || sample_i))
`endif

endmodule

`default_nettype wire
