// SPDX-License-Identifier: Apache-2.0
// ppmc_bridge_decode: decodes the code of an operation (op). Outputs what the op needs first (op_need_e),
//         and whether the op may begin.
// Rules:  table of the ops in docs/uart_bridge.md; UB-ANS-02, UB-ANS-05.
// Timing: combinational.
`default_nettype none

module ppmc_bridge_decode
  import ppmc_bridge_pkg::*;
#(
    parameter int unsigned Axes = 1,  // number of pulse counters, 1 or 2
    parameter bit Recorder = 1'b0  // 1: the bridge has a recorder
) (
    input  wire logic [7:0] op_i,      // code of the op
    input  wire logic       full_i,    // 1: no space for another byte in the answer
    input  wire logic       full4_i,   // 1: no space for 4 bytes
    input  wire logic       full16_i,  // 1: no space for 16 bytes
    output op_need_e        need_o,    // first need of the op
    output result_e         fail_o,    // ResDone, or the reason why the op may not begin
    output logic            second_o,  // 1: the op is for axis 2
    output logic            ident_o,   // 1: the op begins a block of 16 bytes
    output logic            count_o,   // 1: the op begins a block of 4 bytes
    output block_e          block_o    // selected block of 16 bytes
);

  logic [3:0] group, low;
  logic is_known, full;

  assign group = op_i[7:4];
  assign low = op_i[3:0];
  assign second_o = Axes > 1 && (low == SysCount2 || low == SysZero2);
  assign block_o = low == SysVersion ? BlockVersion : low == SysRecorded ? BlockRecorded : BlockIdent;
  assign ident_o = group == OpSystem && need_o == NeedBlock && low != SysReset && !count_o;
  assign count_o = group == OpSystem && (low == SysCount || low == SysCount2);

  always_comb begin
    is_known = 1'b1;
    full = 1'b0;
    need_o = NeedNothing;
    unique case (group)
      OpSystem:
      unique case (low)
        SysNop, SysZero: need_o = NeedNothing;
        SysRate, SysEvents, SysTimeout, SysStraps: need_o = NeedOperand;
        SysReset, SysIdent, SysVersion: begin
          need_o = NeedBlock;
          full   = low != SysReset && full16_i;
        end
        SysCount, SysCount2: begin
          need_o = NeedBlock;
          full = full4_i;
          is_known = low == SysCount || second_o;
        end
        SysZero2: is_known = second_o;
        SysPins: begin
          need_o = NeedByte;
          full   = full_i;
        end
        SysRecord: begin
          need_o   = NeedOperand;
          is_known = Recorder;
        end
        SysRecorded: begin
          need_o = NeedBlock;
          full = full16_i;
          is_known = Recorder;
        end
        default: is_known = 1'b0;
      endcase
      OpReadN, OpPost, OpWait, OpWriteN: need_o = NeedOperand;
      OpFetch: begin
        need_o   = NeedOperand;
        is_known = Recorder && low == '0;
      end
      OpWrite, OpRead, OpCall, OpGet: need_o = NeedCheck;
      default: is_known = 1'b0;
    endcase
    fail_o = !is_known ? ResIllegal : full ? ResOverflow : ResDone;
  end

endmodule

`default_nettype wire
