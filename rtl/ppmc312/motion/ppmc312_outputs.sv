// SPDX-License-Identifier: Apache-2.0
// ppmc312_outputs: drives the pins that instructions and motions switch: interlock, excitation, counter
//         clear, alarm clear, zero clamp, current reduction, generalized output. Also detects the end of
//         the abnormal status.
// Rules:  P312-CMD-20..26, P312-OUT-01..03, P312-INP-31/33, P312-MON-06.
// Timing: pins follow the inputs by one cycle. Clear pulses last 24.576 ms. The current is reduced 100 ms
//         after the end of the last motion; while alm_ni is low, it is reduced immediately.
`default_nettype none

module ppmc312_outputs #(
    parameter int unsigned ClkHz  = 16_000_000,
    parameter int unsigned XtalHz = 16_000_000
) (
    input  wire logic       clk_i,             // clock
    input  wire logic       rst_ni,            // reset, asynchronous
    // instructions: strobes
    input  wire logic       exc_on_i,          // excitation on
    input  wire logic       exc_off_i,         // excitation off
    input  wire logic       cclr_i,            // counter clear
    input  wire logic       aclr_i,            // alarm clear
    input  wire logic       clamp_i,           // zero clamp
    input  wire logic       aux_i,             // generalized output
    input  wire logic [5:0] aux_data_i,        // with aux_i; [n] = 1: pin n is low
    // state of the motor side
    input  wire logic       launch_i,          // strobe: a motion starts (t0)
    input  wire logic       output_end_i,      // strobe: pulse output has ended
    input  wire logic       abn_i,             // 1: abnormal status
    input  wire logic       lock_i,            // 1: interlock control is active
    input  wire logic       alm_ni,            // alarm, active low
    input  wire logic       end_ni,            // END, active low
    input  wire logic       coupled_inside_i,  // 1: coupled_i = 1, and the position is in range
    input  wire logic       coupled_i,         // 1: the in-position monitor controls the zero clamp
    output logic            abn_end_o,         // strobe: the abnormal status ends
    // pins, active low
    output logic            intlk_no,          // interlock
    output logic            exon_no,           // excitation
    output logic            cclr_no,           // counter clear
    output logic            aclr_no,           // alarm clear
    output logic            zclmp_no,          // zero clamp
    output logic            cd_no,             // current reduction
    output logic      [5:0] auxo_no            // generalized output
);

  localparam int unsigned ClearXtal = 393_216;
  localparam int unsigned CurrentXtal = 1_600_000;

  logic [1:0] clear_n, start, past;
  logic clearing_q, standstill_q, current_past;

  assign start = {aclr_i, cclr_i};
  assign {aclr_no, cclr_no} = clear_n;

  for (genvar n = 0; n < 2; n++) begin : g_pulse
    ppmc_delay #(
        .Ticks(ppmc_pkg::cyc(ClearXtal - 1, ClkHz, XtalHz))
    ) u_timer (
        .clk_i,
        .restart_i(start[n]),
        .tick_i   (1'b1),
        .past_o   (past[n])
    );

    always_ff @(posedge clk_i or negedge rst_ni) begin
      if (!rst_ni) clear_n[n] <= 1'b1;
      else if (start[n]) clear_n[n] <= 1'b0;
      else if (past[n]) clear_n[n] <= 1'b1;
    end
  end

  ppmc_delay #(
      .Ticks(ppmc_pkg::cyc(CurrentXtal - 1, ClkHz, XtalHz))
  ) u_rest (
      .clk_i,
      .restart_i(output_end_i),
      .tick_i   (1'b1),
      .past_o   (current_past)
  );

  // An alarm that ends during the alarm clear pulse was cleared by this pulse.
  assign abn_end_o = clearing_q && alm_ni;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      clearing_q   <= 1'b0;
      standstill_q <= 1'b0;
      intlk_no     <= 1'b1;
      exon_no      <= 1'b1;
      zclmp_no     <= 1'b1;
      cd_no        <= 1'b1;
      auxo_no      <= '1;
    end else begin
      if (aclr_i) clearing_q <= abn_i;
      else if (abn_end_o || aclr_no) clearing_q <= 1'b0;

      intlk_no <= !lock_i;

      if (exc_on_i) exon_no <= 1'b0;
      else if (exc_off_i) exon_no <= 1'b1;

      if (launch_i) zclmp_no <= 1'b1;
      else if (clamp_i || coupled_inside_i || (coupled_i && !end_ni)) zclmp_no <= 1'b0;

      if (output_end_i) standstill_q <= 1'b1;
      else if (launch_i) standstill_q <= 1'b0;
      if (!alm_ni || (standstill_q && current_past && !launch_i)) cd_no <= 1'b0;
      else if (launch_i) cd_no <= 1'b1;

      if (aux_i) auxo_no <= ~aux_data_i;
    end
  end

endmodule

`default_nettype wire
