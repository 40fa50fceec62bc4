// SPDX-License-Identifier: Apache-2.0
// ppmc312_settings: stores the motion settings that instructions change. These are the high-speed limit, and
//         whether END and RUN are monitored.
// Rules:  P312-CMD-05/06/45, P312-CMD-00, P312-GEN-12.
// Timing: outputs follow execute_i and built_i by one cycle.
`default_nettype none

module ppmc312_settings
  import ppmc312_pkg::*;
(
    input  wire logic        clk_i,            // clock
    input  wire logic        rst_ni,           // reset, asynchronous
    input  wire logic        execute_i,        // strobe: execute the instruction
    input  wire logic [ 7:0] code_i,           // instruction code
    input  wire logic [15:0] value_i,          // first two parameters
    input  wire logic        built_i,          // strobe: a new table is active
    input  wire logic [15:0] high_rate_i,      // high-speed rate of the table
    output logic      [15:0] limit_rate_o,     // rate limit HSL in base clocks
    output logic             end_monitored_o,  // 1: END is monitored
    output logic             run_ignored_o     // 1: RUN is not monitored
);

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      limit_rate_o <= '1;
      end_monitored_o  <= 1'b0;
      run_ignored_o    <= 1'b0;
    end else begin
      if (built_i) limit_rate_o <= high_rate_i;
      else if (execute_i && code_i == I_LIMIT) limit_rate_o <= value_i;
      if (execute_i && code_i == I_END) end_monitored_o <= value_i[8];
      if (execute_i && code_i == I_SYNC) run_ignored_o <= !run_ignored_o;
    end
  end

endmodule

`default_nettype wire
