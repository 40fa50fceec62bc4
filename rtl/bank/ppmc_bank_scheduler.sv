// SPDX-License-Identifier: Apache-2.0
// ppmc_bank_scheduler: selects the axis of each visit. In a round, each axis is visited once. The block
//         extends reset, GO and STOP to at least one round, so that they act on all axes.
// Rules:  BANK-GEN-01, BANK-GEN-05, BANK-GRP-02..04.
// Timing: axis 0 is in stage 0 in the first cycle after reset. clear_o is high during the first visit of
//         every axis. go_o rises one cycle after go_i and is high for one round. stop_o rises one cycle after
//         stop_i and is high for one round plus one cycle.
`default_nettype none

module ppmc_bank_scheduler #(
    parameter  int unsigned RoundBits = 5,
    parameter  int unsigned Stages    = 6,              // stages of a visit, numbered from 0
    localparam int unsigned Round     = 1 << RoundBits
) (
    input wire logic clk_i,
    input wire logic rst_ni,
    input wire logic go_i,  // strobe: GO is written at the next edge
    input wire logic stop_i,  // strobe: STOP is written at the next edge
    output logic [Stages-1:0][RoundBits-1:0] axis_o,  // axis of the visit in each stage
    output logic [Round-1:0] last_stage_o,  // [i]: axis i is in the last stage
    output logic [Stages:0] clear_o,  // [i]: reset the axis in stage i
    output logic go_o,  // 1: GO is active for the visits in this cycle
    output logic [RoundBits-1:0] go_left_o,  // number of further cycles for which go_o remains high
    output logic stop_o  // 1: end every running motion
);

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      axis_o <= '0;
      last_stage_o <= Round'(1) << (Round - Stages + 1);
      clear_o <= '1;
    end else begin
      axis_o <= {axis_o[Stages-2:0], axis_o[0] + 1'b1};
      last_stage_o <= {last_stage_o[Round-2:0], last_stage_o[Round-1]};
      clear_o <= {clear_o[Stages-1:0], clear_o[0] && axis_o[0] != '1};
    end
  end

  // Number of further cycles for which stop_o remains high. In total, stop_o is high for one round + 1 cycle,
  // because an operation that starts just before STOP is armed only at the end of this time.
  logic [RoundBits:0] stop_left_q;
  logic go_pending_q;  // GO was written again while go_o = 1

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {go_o, go_pending_q, stop_o} <= '0;
      {go_left_o, stop_left_q} <= '0;
    end else begin
      if (go_o && go_left_o != '0) begin
        go_pending_q <= go_pending_q || go_i;
        go_left_o    <= go_left_o - 1'b1;
      end else begin
        go_o         <= go_i || go_pending_q;
        go_pending_q <= go_i && go_pending_q;
        go_left_o    <= '1;
      end
      stop_o      <= stop_i || (stop_o && stop_left_q != '0);
      stop_left_q <= stop_i ? (RoundBits + 1)'(Round) : stop_left_q - 1'b1;
    end
  end

endmodule

`default_nettype wire
