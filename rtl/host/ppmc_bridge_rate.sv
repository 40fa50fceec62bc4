// SPDX-License-Identifier: Apache-2.0
// ppmc_bridge_rate: selects the line rate. Changes the rate after the answer to op RATE. Returns to the
//         initial rate after a break, or if no valid frame follows at the new rate.
// Rules:  UB-LIN-02, UB-LIN-03, UB-LIN-06, UB-LIN-07.
// Timing: step_o follows the code by one cycle. If no valid frame is received at a new rate, the initial
//         rate is selected again 1000 .. 1001 ms after the answer.
`default_nettype none

module ppmc_bridge_rate
  import ppmc_bridge_pkg::*;
#(
    parameter int unsigned ClkHz = 24_000_000,
    parameter int unsigned Baud  = 115_200,
    parameter int unsigned Width = 20           // bits of step_o
) (
    input  wire logic             clk_i,
    input  wire logic             rst_ni,
    input  wire logic             ms_i,        // strobe every millisecond
    input  wire logic             set_i,       // strobe: a script executes op RATE with an available code
    input  wire logic [      2:0] code_i,      // code of the new rate
    input  wire logic             answered_i,  // strobe: the last stop bit of the answer has ended
    input  wire logic             good_i,      // strobe: a valid frame was received
    input  wire logic             break_i,     // strobe: a break was received
    output logic      [Width-1:0] step_o       // phases per cycle
);

  localparam int unsigned TrialBits = $clog2(TRIAL_MS + 1);

  logic [2:0] code_q, next_q;
  logic change_q, trial_q;
  logic [TrialBits-1:0] left_q;
  logic [Width-1:0] steps[8];

  for (genvar code = 0; code < 8; code++) begin : g_step
    localparam int unsigned Rate = rate_hz(is_available(code, ClkHz, Baud) ? code : 0, Baud);
    assign steps[code] = Width'(phase_step(Rate, ClkHz, Width));
  end

  always_ff @(posedge clk_i) begin
    step_o <= steps[code_q];
    if (set_i) next_q <= code_i;
    if (answered_i) left_q <= TrialBits'(TRIAL_MS);
    else if (ms_i) left_q <= left_q - 1'b1;
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      code_q   <= '0;
      change_q <= 1'b0;
      trial_q  <= 1'b0;
    end else if (break_i) begin
      code_q   <= '0;
      change_q <= 1'b0;
      trial_q  <= 1'b0;
    end else if (answered_i) begin
      if (change_q) code_q <= next_q;
      trial_q  <= change_q;
      change_q <= 1'b0;
    end else begin
      if (set_i) change_q <= 1'b1;
      if (good_i) trial_q <= 1'b0;
      else if (trial_q && ms_i && left_q == '0) begin
        code_q  <= '0;
        trial_q <= 1'b0;
      end
    end
  end

endmodule

`default_nettype wire
