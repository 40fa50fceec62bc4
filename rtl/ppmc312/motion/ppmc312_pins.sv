// SPDX-License-Identifier: Apache-2.0
// ppmc312_pins: synchronises the input pins of the motor side and, with Datasheet = 1, filters them.
// Rules:  P312-GEN-01, P312-INP-01, P312-TIM-14.
// Timing: the levels in inputs_o follow the pins by 2 cycles. inputs_o.evt_fall is high in the first cycle
//         in which the level is low. With Datasheet = 1, a low level is accepted after 200 us (event pins:
//         25 ms); a high level is accepted immediately.
`default_nettype none

module ppmc312_pins
  import ppmc312_link_pkg::*;
#(
    parameter int unsigned ClkHz     = 16_000_000,
    parameter int unsigned XtalHz    = 16_000_000,
    parameter bit          Datasheet = 1'b0
) (
    input  wire logic                clk_i,    // clock
    input  wire logic                rst_ni,   // reset, asynchronous
    // pins; the names are those of inputs_t
    input  wire motor_inputs_t       pins_i,   // switches, drive, encoder index
    input  wire logic          [1:0] evt_ni,   // [n]: event pin n
    input  wire logic                run_i,    // 0: RUN holds starts
    input  wire logic                epin_i,   // encoder, counted at its rising edge
    input  wire logic                epdir_i,  // 0: up, 1: down
    input  wire logic          [7:0] auxi_i,   // generalized input
    // core side
    output inputs_t                  inputs_o  // all inputs, synchronised
);

  localparam int unsigned Filtered = $bits(motor_inputs_t) + 2;
  localparam int unsigned Pins = Filtered + 11;
  localparam int unsigned LevelXtal = 3200;
  localparam int unsigned EventXtal = 400_000;

  logic [Pins-1:0] unused_meta;
  motor_inputs_t unfiltered;
  logic run, epin, epdir;
  logic [1:0] evt_n;
  logic [7:0] auxi;
  logic [Filtered-1:0] direct, filtered;
  logic [1:0] evt_q;

  ppmc_sync #(
      .Width(Pins)
  ) u_sync (
      .clk_i,
      .rst_ni,
      .d_i ({auxi_i, run_i, epin_i, epdir_i, evt_ni, pins_i}),
      .q1_o(unused_meta),
      .q2_o({auxi, run, epin, epdir, evt_n, unfiltered})
  );

  assign direct = {evt_n, unfiltered};

  if (Datasheet) begin : g_filter
    for (genvar n = 0; n < Filtered; n++) begin : g_pin
      localparam int unsigned Limit = (n < $bits(motor_inputs_t)) ? LevelXtal : EventXtal;
      logic past;

      // The reset of the device lasts long enough to restart the timers synchronously.
      ppmc_delay #(
          .Ticks(ppmc_pkg::cyc(Limit, ClkHz, XtalHz))
      ) u_timer (
          .clk_i,
          .restart_i(direct[n] || !rst_ni),
          .tick_i   (1'b1),
          .past_o   (past)
      );

      assign filtered[n] = direct[n] || !past;
    end
  end else begin : g_plain
    localparam int unsigned Unused = ClkHz + XtalHz + LevelXtal + EventXtal;
    logic unused_times;

    assign unused_times = Unused[0];
    assign filtered = direct;
  end

  assign inputs_o = '{
          unfiltered: unfiltered,
          filtered: filtered[$bits(motor_inputs_t)-1:0],
          evt_n: evt_n,
          evt_fall: evt_q & ~filtered[Filtered-1-:2],
          run: run,
          epin: epin,
          epdir: epdir,
          auxi: auxi
      };

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) evt_q <= '1;
    else evt_q <= filtered[Filtered-1-:2];
  end

endmodule

`default_nettype wire
