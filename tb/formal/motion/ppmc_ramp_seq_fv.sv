// SPDX-License-Identifier: Apache-2.0
// ppmc_ramp_seq_fv: for any table and any sequence of events, proves the number of pulses, the ramp level
// and the rates.
`include "ppmc_fv.svh"
`default_nettype none

module ppmc_ramp_seq_fv (
    input wire logic       clk_i,
    input wire logic [2:0] slow_i,
    input wire logic [2:0] fast_i,
    input wire logic [1:0] steps_i,
    input wire logic [2:0] lut_data_i,
    input wire logic       load_i,
    input wire logic [4:0] count_i,
    input wire logic       single_i,
    input wire logic [2:0] rate_i,
    input wire logic       ramp_i,
    input wire logic       pulse_i,
    input wire logic       forced_i
);

  logic [2:0] lut_addr_o, rate_o;
  logic lookup_busy_o, rising_o, last_o, final_o, top_o, at_start_rate_o, dec_o;
  logic [4:0] left_o;

  `FV_RESET

  ppmc_ramp_seq #(
      .CountBits(5),
      .RateBits (3),
      .StepBits (3),
      .LutBits  (3)
  ) dut (
      .*
  );

  // loaded_q: a motion was loaded; over_q: its last pulse was made; rated_q: its rate is valid
  logic loaded_q, over_q, rated_q;
  logic [5:0] due_q;  // pulses that are still to be made
  logic [2:0] gap_q;  // cycles since a load or a pulse, saturates at 7
  logic [2:0] addr1_q, addr2_q;  // addresses of the table, one and two cycles ago
  logic [2:0] constant_q;

  always_ff @(posedge clk_i)
    if (!rst_ni) {loaded_q, over_q, rated_q, due_q, gap_q, constant_q} <= '0;
    else begin
      gap_q <= (load_i || pulse_i) ? 3'd1 : (gap_q == '1) ? '1 : gap_q + 1'b1;
      if (load_i)
        {loaded_q, over_q, due_q, constant_q} <= {2'b10, single_i ? 6'd1 : {1'b0, count_i} + 6'd1, rate_i};
      else if (pulse_i) {over_q, due_q} <= {last_o, due_q - 1'b1};
    end

  always_ff @(posedge clk_i) {addr2_q, addr1_q} <= {addr1_q, lut_addr_o};

  logic first_q;  // 1: no pulse since the load
  always_ff @(posedge clk_i)
    if (!rst_ni || load_i) first_q <= 1'b1;
    else if (pulse_i) first_q <= 1'b0;

  logic top_q;
  always_ff @(posedge clk_i) top_q <= rst_ni && !load_i && (top_q || top_o);

  // Assumptions about the axis: the pulses of a motion are at least 3 cycles apart, and the first pulse is
  // at least 4 cycles after the start. No pulse occurs during a look-up or after the last pulse.
  `FV_ASSUME(
      pulses_apart,
      !(pulse_i && (load_i || gap_q < (first_q ? 3'd4 : 3'd3) || !loaded_q || over_q || lookup_busy_o)))
  // The builder writes no threshold above PA. The entry of the high-speed rate is PA.
  `FV_ASSUME(table_up_to_pa, lut_data_i <= 3'(steps_i) && (addr2_q != fast_i || lut_data_i == 3'(steps_i)))
  `FV_ASSUME(motion_steady, load_i || !loaded_q || {slow_i, fast_i, steps_i} == $past
             ({slow_i, fast_i, steps_i}))
  `FV_ASSUME(ramp_steady, load_i || $past(load_i) || !loaded_q || ramp_i == $past(ramp_i))
  `FV_ASSUME(first_rate, !$past(rst_ni && load_i) || !ramp_i || $past(rate_i == slow_i))
  `FV_ASSUME(legal_ramp, slow_i >= fast_i && steps_i != '0)
  // ppmc_stop_monitor deasserts forced_i only at the end of a motion. No pulse occurs after this.
  logic forced_q, taken_back_q;
  always_ff @(posedge clk_i)
    if (!rst_ni || load_i) {forced_q, taken_back_q} <= '0;
    else {forced_q, taken_back_q} <= {forced_i, taken_back_q || (forced_q && !forced_i)};
  `FV_ASSUME(forced_stays, !(pulse_i && !forced_i && forced_q) && !(pulse_i && taken_back_q))
  `FV_ASSUME(no_force_at_the_start, !load_i || !forced_i)

  `FV_ASSERT(p104_opr_02_exact_count, !(loaded_q && !over_q && gap_q >= 3'd3) || final_o == (due_q == 6'd1))
  `FV_ASSERT(p104_rd_07_left, !(loaded_q && !over_q) || left_o == 5'(due_q - 6'd1))
  `FV_ASSERT(p104_opr_02_never_too_many, !(loaded_q && !over_q) || due_q != '0)
  `FV_ASSERT(p104_fdc_03_last_by_count_or_force,
             !(pulse_i && last_o) || due_q == 6'd1 || (forced_i && ramp_i) || !ramp_i)
  `FV_ASSERT(p104_int_01_constant_rate,
             !(loaded_q && !over_q && !load_i && !ramp_i && gap_q >= 3'd3) || rate_o == constant_q)
  `FV_ASSERT(p104_pro_index_up_to_pa, !(pulse_i && ramp_i) || dut.ramp_level <= 3'(steps_i) + 3'd1)
  `FV_COVER(seen_plateau_and_down,
            loaded_q && pulse_i && last_o && final_o && dec_o && steps_i == 2'd2 && ramp_i && top_q)

endmodule

`default_nettype wire
