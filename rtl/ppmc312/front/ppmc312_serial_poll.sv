// SPDX-License-Identifier: Apache-2.0
// ppmc312_serial_poll: selects the reply to a poll. The reply is the first pending report or, if no report
//         is pending, "busy" or "ready".
// Rules:  P312-SER-20, P312-SER-30.
// Timing: combinational.
`default_nettype none

module ppmc312_serial_poll
  import ppmc312_pkg::*;
  import ppmc312_link_pkg::*;
  import ppmc312_serial_pkg::*;
(
    input  wire poll_result_t poll_result_i,  // report for this poll
    input  wire status_e      status_i,       // status of the device
    output reply_t            reply_o         // reply to the poll
);

  logic [7:0] code;

  always_comb begin
    unique case (poll_result_i.report_class)
      4'd1:    code = 8'h46;
      4'd2: begin
        unique case (poll_result_i.trigger_result)
          FailEvent:    code = 8'h4a;
          FailOverride: code = 8'h4b;
          DoneOverride: code = 8'h28;
          default:      code = 8'h29;
        endcase
      end
      4'd3:    code = 8'h22;
      4'd4:    code = 8'h23;
      4'd5:    code = end_code(poll_result_i.cause);
      4'd6:    code = 8'h2a;
      4'd7:    code = {7'h13, poll_result_i.outside};
      default: code = {7'h12, poll_result_i.outside};
    endcase
    reply_o = '{
        kind: (poll_result_i.report_class == 4'd5) ? ReplyData : ReplySpecific,
        count: (poll_result_i.report_class == 4'd6) ? 3'd3 : 3'd1,
        from_response: 1'b0,
        data: {poll_result_i.data, 7'd0, poll_result_i.discarded, code}
    };
    if (poll_result_i.report_class == 4'd0) begin
      reply_o.kind  = (status_i inside {StatusAcc, StatusFix, StatusWrn}) ? ReplyBusy : ReplyReady;
      reply_o.count = 3'd0;
    end
  end

endmodule

`default_nettype wire
