// SPDX-License-Identifier: Apache-2.0
// ppmc_bridge_decode_fv: proves that an op may begin if and only if the table contains it and the answer
// has space for the bytes that the op returns immediately. Proves that ident_o and count_o are high
// for exactly the ops that return a block of this kind.
`include "ppmc_fv.svh"
`default_nettype none

module ppmc_bridge_decode_fv
  import ppmc_bridge_pkg::*;
(
    input wire logic       clk_i,
    input wire logic [7:0] op_i,
    input wire logic       full_i,
    input wire logic       full4_i,
    input wire logic       full16_i
);

  op_need_e need_o;
  result_e  fail_o;
  logic second_o, ident_o, count_o;
  block_e block_o;

  `FV_RESET

  ppmc_bridge_decode #(
      .Axes    (1),
      .Recorder(1'b1)
  ) dut (
      .*
  );

  // Independent copy of the table of docs/uart_bridge.md for one axis and a recorder.
  logic known, gives16, gives4;
  assign known = op_i[7] ? op_i[7:4] == 4'd8 || op_i == 8'h90 : op_i[6:4] != 3'd0 || op_i[3:0] <= 4'd9 ||
                 (op_i[3:0] >= 4'd12 && op_i[3:0] <= 4'd14);
  assign gives16 = op_i inside {8'h01, 8'h0C, 8'h0E};
  assign gives4 = op_i == 8'h08;

  `FV_ASSERT(ub_ans_02_unknown, (fail_o == ResIllegal) == !known)
  logic full;  // 1: no space for the bytes that the op returns immediately
  assign full = (gives16 && full16_i) || (gives4 && full4_i) || (op_i == 8'h06 && full_i);

  `FV_ASSERT(ub_ans_05_room, !known || (fail_o == ResOverflow) == full)
  `FV_ASSERT(blocks, !known || (ident_o == gives16 && count_o == gives4))
  `FV_COVER(seen_record, op_i == 8'h0D && fail_o == ResDone && need_o == NeedOperand)

endmodule

`default_nettype wire
