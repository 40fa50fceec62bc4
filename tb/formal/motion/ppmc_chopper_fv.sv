// SPDX-License-Identifier: Apache-2.0
// ppmc_chopper_fv: proves that a phase lasts exactly base + UnitQuanta * units quanta, with the base time and
// units at the beginning of the phase. Proves that the first phase is ON.
`include "ppmc_fv.svh"
`default_nettype none

module ppmc_chopper_fv (
    input wire logic       clk_i,
    input wire logic       run_i,
    input wire logic       restart_i,
    input wire logic       quantum_i,
    input wire logic [1:0] on_base_i,
    input wire logic [1:0] off_base_i,
    input wire logic [1:0] on_units_i,
    input wire logic [1:0] off_units_i
);

  localparam logic [4:0] Unit = 5'd3;  // in quanta

  logic on_o;

  `FV_RESET

  ppmc_chopper #(
      .UnitQuanta(3),
      .BaseBits  (2),
      .UnitBits  (2)
  ) dut (
      .*
  );

  logic on_q, began_q;
  logic [1:0] phases_q;  // number of phases that have ended, saturates at 3
  logic [4:0] left_q;  // remaining quanta of this phase

  function automatic logic [4:0] whole(logic [1:0] base, logic [1:0] n);
    return 5'(base) + Unit * 5'(n);
  endfunction

  always_ff @(posedge clk_i)
    if (!rst_ni || restart_i || !run_i) phases_q <= '0;
    else if (quantum_i && left_q == 5'd1 && phases_q != '1) phases_q <= phases_q + 1'b1;

  always_ff @(posedge clk_i)
    if (!rst_ni) {on_q, began_q, left_q} <= {2'b10, 5'd0};
    else if (restart_i || !run_i) {on_q, began_q, left_q} <= {2'b11, whole(on_base_i, on_units_i)};
    else if (began_q && quantum_i) begin
      if (left_q != 5'd1) left_q <= left_q - 1'b1;
      else if (on_q) {on_q, left_q} <= {1'b0, whole(off_base_i, off_units_i)};
      else {on_q, left_q} <= {1'b1, whole(on_base_i, on_units_i)};
    end

  `FV_ASSUME(base_not_zero, on_base_i != '0 && off_base_i != '0)
  // The chopper is stopped until the device has been initialised.
  `FV_ASSUME(begins_with_a_restart, began_q || restart_i || !run_i)

  `FV_ASSERT(p104_sw_01_each_phase, !began_q || on_o == (on_q || !run_i))
  `FV_ASSERT(on_unless_it_chops, run_i || on_o)
  `FV_COVER(seen_second_off, phases_q == 2'd3 && !on_o && left_q == 5'd8)

endmodule

`default_nettype wire
