// SPDX-License-Identifier: Apache-2.0
// ppmc312_pins: every input pin of the motor side into the clock of the core, with the old chip's filters.
// Rules:  P312-GEN-01, P312-INP-01, P312-TIM-14.
// Timing: synchronised levels 2 clk after the pin; edges in the clk in which the level has become low. With
//         Datasheet a low level counts after 200 us, of the event pins after 25 ms; a high one at once.
`default_nettype none

module ppmc312_pins
  import ppmc312_link_pkg::*;
#(
    parameter int unsigned ClkHz     = 16_000_000,
    parameter int unsigned XtalHz    = 16_000_000,
    parameter bit          Datasheet = 1'b0
) (
    input  wire logic          clk_i,    // clock
    input  wire logic          rst_ni,   // reset, asynchronous
    // as on the pins; the names are those of inputs_t
    input  wire levels_t       pins_i,   // switches, drive, encoder index
    input  wire logic    [1:0] evt_ni,   // [n] is event pin n
    input  wire logic          run_i,    // 1: starts go ahead
    input  wire logic          epin_i,   // encoder: counts with its rising edge
    input  wire logic          epdir_i,  // 0 up, 1 down
    input  wire logic    [7:0] auxi_i,   // generalized input
    // inside
    output inputs_t            inputs_o  // synchronous
);

  localparam int unsigned Filtered = $bits(levels_t) + 2;
  localparam int unsigned Pins = Filtered + 11;
  localparam int unsigned LevelXtal = 3200;
  localparam int unsigned EventXtal = 400_000;

  logic [Pins-1:0] unused_meta;
  levels_t plain;
  logic run, epin, epdir;
  logic [1:0] evt_n;
  logic [7:0] auxi;
  logic [Filtered-1:0] asis, taken;
  logic [1:0] evt_q;

  ppmc_sync #(
      .Width(Pins)
  ) u_sync (
      .clk_i,
      .rst_ni,
      .d_i ({auxi_i, run_i, epin_i, epdir_i, evt_ni, pins_i}),
      .q1_o(unused_meta),
      .q2_o({auxi, run, epin, epdir, evt_n, plain})
  );

  assign asis = {evt_n, plain};

  if (Datasheet) begin : g_filter
    for (genvar n = 0; n < Filtered; n++) begin : g_pin
      localparam int unsigned Limit = (n < $bits(levels_t)) ? LevelXtal : EventXtal;
      logic past;

      // The part's reset is long enough for a synchronous one.
      ppmc_delay #(
          .Ticks(ppmc_pkg::cyc(Limit, ClkHz, XtalHz))
      ) u_timer (
          .clk_i,
          .restart_i(asis[n] || !rst_ni),
          .tick_i   (1'b1),
          .past_o   (past)
      );

      assign taken[n] = asis[n] || !past;
    end
  end else begin : g_plain
    localparam int unsigned Unused = ClkHz + XtalHz + LevelXtal + EventXtal;
    logic unused_times;

    assign unused_times = Unused[0];
    assign taken = asis;
  end

  assign inputs_o = '{
          plain: plain,
          levels: taken[$bits(levels_t)-1:0],
          evt_n: evt_n,
          fell: evt_q & ~taken[Filtered-1-:2],
          run: run,
          epin: epin,
          epdir: epdir,
          auxi: auxi
      };

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) evt_q <= '1;
    else evt_q <= taken[Filtered-1-:2];
  end

endmodule

`default_nettype wire
