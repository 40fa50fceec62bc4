// SPDX-License-Identifier: Apache-2.0
// ppmc_finish_status: stores the finish status of a motion in a single-axis device. Outputs the interrupt and
//         the data of the read commands.
// Rules:  P104-RD-01..08, P104-END-01/04/07, P104-STP-07; STMC-FIN-01/04/05, STMC-MOT-09/10, STMC-INP-01,
//         STMC-OUT-01, STMC-REM-01.
// Timing: finish status and int_no change at the edge that ends the cycle of done_i. answer_o is
//         combinational.
`default_nettype none

module ppmc_finish_status
  import ppmc_code_pkg::*;
#(
    parameter bit UnreadFlag = 1'b1  // 1: bit 7 of the status is 1 until the status is read; 0: always 1
) (
    input  wire logic            clk_i,
    input  wire logic            rst_ni,
    input  wire logic            start_i,      // strobe: an operation starts
    input  wire op_code_t        op_code_i,    // code of the operation; valid with start_i
    input  wire logic            done_i,       // strobe: the operation ends
    input  wire logic     [ 3:0] cause_i,      // causes {stop, alarm, limit, slow}; stable at standstill
    input  wire logic            read_i,       // strobe: a read command is executed
    input  wire logic     [ 2:0] select_i,     // data that the read command selects
    input  wire logic     [23:0] remaining_i,  // remaining pulses, in the format of SEL_REMAINING
    input  wire logic     [ 7:0] inputs_i,     // pin levels, in the format of SEL_INPUTS
    input  wire logic     [ 7:0] outputs_i,    // pin levels, in the format of SEL_OUTPUTS
    input  wire logic     [ 3:0] auxi_i,       // pin levels, in the format of SEL_AUX_IN
    output logic          [23:0] answer_o,     // data of the read command; first byte in bits 7:0
    output logic                 int_no        // low: a motion has ended
);

  logic unread_q, silent_q;  // unread_q: status is unread; silent_q: no interrupt requested
  logic [2:0] op_q;
  logic unused_bits;

  assign unused_bits = &{1'b0, op_code_i};

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      int_no   <= 1'b1;
      unread_q <= 1'b0;
      silent_q <= 1'b0;
      op_q     <= '0;
    end else begin
      if (start_i) begin
        silent_q <= op_code_i.silent;
        op_q     <= op_code_i.op;
      end
      if (done_i) begin
        unread_q <= 1'b1;
        if (!silent_q) int_no <= 1'b0;
      end
      if (read_i && select_i == SEL_FINISH) begin
        unread_q <= 1'b0;
        int_no   <= 1'b1;
      end
    end
  end

  // The causes are valid until the next operation starts. While an operation runs, read commands are
  // rejected.
  always_comb begin
    answer_o = remaining_i;  // only SEL_REMAINING has more than one byte
    unique case (select_i)
      SEL_FINISH:  answer_o[7:0] = {unread_q || !UnreadFlag, cause_i, op_q};
      SEL_INPUTS:  answer_o[7:0] = inputs_i;
      SEL_OUTPUTS: answer_o[7:0] = outputs_i;
      SEL_AUX_IN:  answer_o[7:0] = {4'b0000, auxi_i};
      default:     ;
    endcase
  end

endmodule

`default_nettype wire
