// SPDX-License-Identifier: Apache-2.0
// ppmc312_reset: generates the resets from the reset pin and from the reset instruction. Latches mode, line
//         speed and station number when a reset ends.
// Rules:  P312-GEN-01, P312-PRT-02/03, P312-CMD-FF, P312-TIM-01.
// Timing: two cycles after the release of the reset (Datasheet = 1: 1.6 ms), ready_o is asserted and the
//         core leaves reset. The host side leaves reset one cycle after the release. The latched levels are
//         those of the pins two cycles earlier.
`default_nettype none

module ppmc312_reset #(
    parameter int unsigned ClkHz     = 16_000_000,
    parameter int unsigned XtalHz    = 16_000_000,
    parameter bit          Datasheet = 1'b0
) (
    input wire logic clk_i,  // clock
    input wire logic rst_ni,  // reset pin, asynchronous
    input wire logic reset_i,  // strobe: reset by an instruction
    input wire logic mode_i,  // pin, 1: parallel, 0: serial
    input wire logic [2:0] mod_i,  // pins: line speed
    input wire logic [3:0] adr_i,  // pins: station number
    output logic rst_core_no,  // reset of the core, active low
    output logic rst_host_no,  // reset of the host-side registers, active low
    output logic rst_bus_no,  // reset of the bus strobes, active low; only the pin asserts it
    output logic boot_o,  // 1: a reset instruction caused this reset of the core
    output logic ready_o,  // 1: the reset has ended
    output logic open_o,  // 1: the bus accepts instructions; 0 until 3 cycles after a reset instruction
    output logic serial_o,  // 1: serial, 0: parallel
    output logic [2:0] mod_o,  // latched line speed
    output logic [3:0] adr_o  // latched station number
);

  localparam int unsigned StartXtal = 25_600;

  // rst_pin_n resets flip-flops and is also used as data, because it restarts the delay.
  // verilator lint_off SYNCASYNCNET
  logic rst_pin_n;
  // verilator lint_on SYNCASYNCNET
  logic rst_core_nq, rst_host_nq, started;
  logic [1:0] boot_q;
  logic [7:0] pins, unused_meta;

  ppmc_reset u_reset (
      .clk_i,
      .rst_ni,
      .rst_no(rst_pin_n)
  );

  if (Datasheet) begin : g_start
    ppmc_delay #(
        .Ticks(ppmc_pkg::cyc(StartXtal, ClkHz, XtalHz))
    ) u_start (
        .clk_i,
        .restart_i(!rst_pin_n),
        .tick_i   (1'b1),
        .past_o   (started)
    );
  end else begin : g_fast
    localparam int unsigned Unused = StartXtal + ClkHz + XtalHz;
    logic unused_start;

    assign unused_start = Unused[0];
    always_ff @(posedge clk_i or negedge rst_pin_n) begin
      if (!rst_pin_n) started <= 1'b0;
      else started <= 1'b1;
    end
  end

  // Levels that were sampled before the end of the reset are latched, so this synchroniser has no reset.
  ppmc_sync #(
      .Width(8)
  ) u_pins (
      .clk_i,
      .rst_ni(1'b1),
      .d_i   ({mode_i, mod_i, adr_i}),
      .q1_o  (unused_meta),
      .q2_o  (pins)
  );

  always_ff @(posedge clk_i or negedge rst_pin_n) begin
    if (!rst_pin_n) begin
      rst_core_nq              <= 1'b0;
      rst_host_nq              <= 1'b0;
      boot_o                   <= 1'b0;
      boot_q                   <= '0;
      ready_o                  <= 1'b0;
      {serial_o, mod_o, adr_o} <= {1'b1, 7'd0};  // serial at speed 0: no front end is active
    end else begin
      ready_o     <= started;
      rst_core_nq <= started && !reset_i;
      rst_host_nq <= !reset_i;
      boot_o      <= reset_i || (boot_o && !rst_core_nq);
      boot_q      <= {boot_q[0], boot_o};
      if (!rst_host_nq) {serial_o, mod_o, adr_o} <= {!pins[7], pins[6:0]};
    end
  end

  // The reset pin resets all blocks immediately, because it bypasses the reset registers.
  assign rst_core_no = rst_core_nq && rst_pin_n;
  assign rst_host_no = rst_host_nq && rst_pin_n;
  assign rst_bus_no  = rst_pin_n;
  // open_o follows a reset instruction by 3 cycles, so that a read strobe that began during the reset still
  // returns "busy".
  assign open_o      = ready_o && !boot_o && boot_q == '0;

endmodule

`default_nettype wire
