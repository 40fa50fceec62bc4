// SPDX-License-Identifier: Apache-2.0
// pmc006_stall: detects a stall: at constant speed, length_i consecutive samples of the back EMF are below
//         limit_i.
// Rules:  P006-STA-03/14, P006-STL-01..06.
// Timing: a sample is compared at the edge that ends the cycle of sample_i.valid. It is counted in the next
//         cycle c. stall_o is set at the end of c. stop_o is combinational and already asserted in c, so
//         that no step is made after the position of the stall is stored.
`default_nettype none

module pmc006_stall
  import pmc006_pkg::sample_t;
(
    input  wire logic          clk_i,
    input  wire logic          rst_ni,
    input  wire sample_t       sample_i,  // sample of the back EMF
    input  wire logic    [2:0] config_i,  // STCFG; [0]: detect, [1]: stop, [2]: drive GPO5
    input  wire logic    [6:0] length_i,  // STLEN in samples; 0 has the effect of 1
    input  wire logic    [8:0] limit_i,   // STLVL; a sample below limit_i is low
    input  wire logic          busy_i,    // 1: a motion is in progress
    input  wire logic          steady_i,  // 1: constant speed above 0; valid with busy_i
    input  wire logic          start_i,   // strobe: a motion starts
    input  wire logic          clear_i,   // strobe: clear STALL
    output logic               stop_o,    // 1: stop the motion immediately
    output logic               mark_o,    // strobe: store the position of the stall
    output logic               stall_o    // register STALL
);

  logic sample_q, low_q, low_counted;
  logic [6:0] count_q;
  logic [7:0] count_next;

  assign count_next = {1'b0, count_q} + 1'b1;
  assign low_counted = low_q && config_i[0] && !stall_o && busy_i && steady_i;
  assign mark_o = sample_q && low_counted && count_next >= {1'b0, length_i};
  assign stop_o = config_i[1] && busy_i && (stall_o || mark_o);

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      sample_q <= 1'b0;
      stall_o  <= 1'b0;
    end else begin
      sample_q <= sample_i.valid;
      stall_o  <= mark_o || (stall_o && !clear_i && !start_i);
    end
  end

  always_ff @(posedge clk_i) begin
    if (sample_i.valid) low_q <= sample_i.level < {1'b0, limit_i};
    if (!busy_i) count_q <= '0;  // each motion begins with a count of 0
    else if (sample_q) count_q <= low_counted ? count_next[6:0] | {7{count_next[7]}} : '0;  // saturates
  end

  logic unused_config;
  assign unused_config = &{1'b0, config_i};

endmodule

`default_nettype wire
