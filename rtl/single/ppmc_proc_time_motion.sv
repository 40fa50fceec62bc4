// SPDX-License-Identifier: Apache-2.0
// ppmc_proc_time_motion: implements the long processing times of the old chip (DATASHEET) for
//         initialisation, the time before pulse 1, and the end of a motion. Only one of these times runs at a
//         time, so they share one counter.
// Rules:  P104-DS-02, P104-DS-04..08; STMC-DS-01..14.
// Timing: a time starts at the edge of init_i, start_i or stop_i, or one cycle after the edge of pulse_i
//         with last_i. The delayed event occurs one cycle after the nominal time.
// How:    a part of some times is proportional to a number: 209 crystal cycles per step of PA, or 123/16
//         crystal cycles per pulse of a triangular profile. This part is subtracted from the count in
//         portions, at most one portion per cycle, as soon as the count is large enough. The subtraction
//         always keeps up with the count.
//         number_i is PA one cycle after init_i, which is early enough for the first portion.
`include "ppmc_assert.svh"
`default_nettype none

module ppmc_proc_time_motion #(
    parameter int unsigned ClkHz = 16_000_000,
    parameter int unsigned XtalHz = 16_000_000,
    parameter int unsigned StepsMin = 4,  // smallest PA
    parameter int unsigned StepsMax = 11_220,  // largest PA
    parameter bit RampTimes = 1'b1  // 1: extra time for a stop in a ramp and for a triangular profile
) (
    input  wire logic        clk_i,
    input  wire logic        rst_ni,
    input  wire logic        init_i,        // strobe: an initialisation is accepted
    input  wire logic        start_i,       // strobe: an operation is accepted
    input  wire logic        triangular_i,  // with start_i: the profile is triangular (no plateau)
    input  wire logic [15:0] number_i,      // with start_i: pulses minus 1; one cycle after init_i: PA
    input  wire logic        ramp_i,        // 1: the running operation has a ramp
    input  wire logic        single_i,      // 1: the running operation is a single step
    input  wire logic        stop_i,        // strobe: immediate end at the next edge
    input  wire logic        pulse_i,       // strobe: pulse event at the next edge
    input  wire logic        last_i,        // with pulse_i: it is the last pulse
    input  wire logic        final_i,       // with pulse_i: the count is complete
    output logic             ready_o,       // strobe: the initialisation is complete
    output logic             go_o,          // 1: pulse 1 may occur; valid only while the operation runs
    output logic             end_delay_o,   // 1: the motion must not end yet
    output logic             closed_o       // 1: no byte may be accepted, because a motion ends
);

  // Times in crystal cycles.
  localparam int unsigned InitBaseXtal = 264_000;
  localparam int unsigned InitStepXtal = 209;
  localparam int unsigned PulseXtal = 7;  // whole crystal cycles per pulse of a triangular profile
  localparam int unsigned PulseSixteenths = 11;  // sixteenths added to PulseXtal
  // Times in units of 16 crystal cycles (1 us at 16 MHz).
  localparam logic [7:0] FirstConstantUnits = 8'd194;
  localparam logic [7:0] FirstRampUnits = 8'd200;
  localparam logic [7:0] FirstSingleUnits = 8'd86;
  localparam logic [7:0] EndBusyUnits = 8'd26;
  localparam logic [7:0] EndOpenUnits = 8'd156;
  localparam logic [7:0] EndRampUnits = 8'd200;

  localparam int unsigned CountBits = 19;
  localparam int unsigned PortionBits = ppmc_pkg::cnt_width(
      (RampTimes && StepsMax < 32_767) ? 32_767 : StepsMax
  );

  typedef enum logic [2:0] {
    StRest,
    StInit,
    StFirst,   // waits for pulse 1
    StEnding,  // waits for the fall of BUSY
    StClosed   // waits for the opening of the mailbox
  } state_e;

  (* fsm_encoding = "none" *)
  state_e state_q;
  logic ramp_end_q, no_closed_q;  // ramp_end_q: the end takes EndRampUnits; no_closed_q: StClosed is skipped
  logic last_q;  // 1: the end delay starts in this cycle, in which the pins change
  logic init_q;  // init_i, delayed by one cycle
  logic restart, past, full, portion, more;
  logic [1:0] cycles;
  logic [CountBits-1:0] count_q, increment;
  logic [7:0] limit;
  logic unused_bits;
  logic [PortionBits:0] portions_q;  // remaining portions, minus 1; negative: no portion remains
  logic [3:0] sixteenths_q;  // sixteenths of a crystal cycle

  assign unused_bits = &{1'b0, number_i};

  assign ready_o     = state_q == StInit && past;
  assign go_o        = past;
  assign end_delay_o = (state_q == StEnding && !past) || last_q;
  assign closed_o    = state_q inside {StEnding, StClosed};

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      state_q <= StRest;
      ramp_end_q <= 1'b0;
      no_closed_q <= 1'b0;
      last_q <= 1'b0;
      init_q <= 1'b0;
    end else begin
      last_q <= pulse_i && last_i;
      init_q <= init_i;
      if (init_i) state_q <= StInit;
      else if (start_i) state_q <= StFirst;
      else if (stop_i || (pulse_i && last_i)) begin
        state_q <= StEnding;
        ramp_end_q <= stop_i ? ramp_i : !final_i;
        no_closed_q <= stop_i ? ramp_i : !final_i || single_i;
      end else if (pulse_i) state_q <= StRest;
      else if (past && !last_q) begin
        unique case (state_q)
          StEnding: state_q <= no_closed_q ? StRest : StClosed;
          StFirst:  ;
          default:  state_q <= StRest;
        endcase
      end
    end
  end

  // ---- count ---------------------------------------------------------------------------------------

  assign restart = init_i || start_i || stop_i || last_q;

  ppmc_xtal_cycles #(
      .ClkHz (ClkHz),
      .XtalHz(XtalHz)
  ) u_cycles (
      .clk_i,
      .rst_ni,
      .restart_i(restart),
      .cycles_o (cycles)
  );

  always_comb begin
    unique case (state_q)
      StEnding: limit = ramp_end_q ? EndRampUnits : EndBusyUnits;
      StClosed: limit = EndOpenUnits;
      default: begin
        limit = FirstConstantUnits;
        if (ramp_i) limit = FirstRampUnits;
        if (single_i) limit = FirstSingleUnits;
      end
    endcase
    past = count_q[12] || !ppmc_pkg::less(32'(count_q[11:4]), 32'(limit));
    if (state_q == StInit) past = count_q >= CountBits'(InitBaseXtal - (StepsMin + 1) * InitStepXtal);
    if (more) past = 1'b0;
  end

  // full = 1: all times except that of an initialisation have passed. The count then stops, because pulse 1
  // may wait for a clock indefinitely.
  assign full = count_q[12] && state_q != StInit;

  assign more    = !portions_q[PortionBits];
  assign portion = more && count_q[8];  // the count is below 512 while portions remain

  logic [4:0] sixteenths;

  assign sixteenths = {1'b0, sixteenths_q} + 5'(PulseSixteenths);

  always_comb begin
    increment = CountBits'(cycles);
    if (portion) begin
      increment = CountBits'(cycles) - CountBits'(InitStepXtal);
      if (state_q != StInit)
        increment = CountBits'(cycles) - CountBits'(PulseXtal) - CountBits'(sixteenths[4]);
    end
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      count_q <= '0;
      portions_q <= '1;
      sixteenths_q <= '0;
    end else begin
      if (restart) count_q <= '0;
      else if (!full) count_q <= count_q + increment;

      if (init_q || restart) portions_q <= {!init_q && !(start_i && triangular_i), PortionBits'(number_i)};
      else if (portion) portions_q <= portions_q - 1'b1;

      if (restart) sixteenths_q <= '0;
      else if (portion) sixteenths_q <= sixteenths[3:0];
    end
  end

`ifndef SYNTHESIS
  `PPMC_ASSERT(p104_ds_02_portions_in_time, !more || count_q[CountBits-1:9] == '0)
`endif

endmodule

`default_nettype wire
