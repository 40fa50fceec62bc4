// SPDX-License-Identifier: Apache-2.0
// station_bench: the ULX3S with a PPMC-2104, and an old host on its data bus. Both have tri-state drivers.
`default_nettype none

// Replacement of the PLL: `clk` is the oscillator, and the test bench drives the lock signal.
module ppmc_clock_ulx3s (
    input  wire logic clk_25m_i,
    output logic      clk_o,
    output logic      lock_o
);

  assign clk_o  = clk_25m_i;
  assign lock_o = station_bench.lock;

endmodule

module station_bench (
    input  wire logic       clk,
    input  wire logic       lock,
    input  wire logic       req_n,
    input  wire logic       uart_rxd,
    output logic            uart_txd,
    input  wire logic       cs_n,
    input  wire logic       a0,
    input  wire logic       busc,
    input  wire logic       ds_wrs_n,
    input  wire logic       rw_rds_n,
    input  wire logic [7:0] d_i,
    output logic      [7:0] d_o,
    output logic            d_oe,
    output logic            int_n,
    input  wire logic       errint_n,
    input  wire logic [2:1] run,
    input  wire logic [2:1] csel,
    input  wire logic [2:1] extck,
    input  wire logic [2:1] fl_n,
    input  wire logic [2:1] bl_n,
    input  wire logic [2:1] fhl_n,
    input  wire logic [2:1] bhl_n,
    input  wire logic [2:1] org_n,
    input  wire logic [2:1] alm_n,
    input  wire logic [1:0] auxi,
    output logic      [1:0] auxo,
    output logic            clk_o,
    output logic      [5:1] s1,
    output logic      [5:1] s2,
    output logic      [2:1] hold,
    output logic      [2:1] pout_n,
    output logic      [2:1] dir,
    output logic      [3:0] lamps
);

  wire [7:0] d;
  logic wifi_gpio0;

  // The host drives while the part does not drive.
  assign d   = d_oe ? 'z : d_i;
  assign d_o = d;

  board_ulx3s_ppmc2104 #(
      .HOST("BUS")
  ) u_top (
      .clk_25m   (clk),
      .btn_f1    (1'b0),
      .host_rst_n(req_n),
      .led       (lamps),
      .*
  );

endmodule

`default_nettype wire
