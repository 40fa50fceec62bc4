// SPDX-License-Identifier: Apache-2.0
// ppmc312_position: counts position and encoder position, ends interlock control at the interlock position,
//         and monitors positions.
// Rules:  P312-MOT-05, P312-MON-01..06, P312-OUT-03, P312-CMD-04/43/44.
// Timing: pos_o and counted_o follow count_i by one cycle. The monitors evaluate a position 3 cycles after it
//         is valid on pos_o or enc_o. The in-position monitor does not evaluate while pulses are output, nor
//         in the first 4 cycles after the end of pulse output.
`default_nettype none

module ppmc312_position
  import ppmc312_pkg::*;
(
    input wire logic clk_i,  // clock
    input wire logic rst_ni,  // reset, asynchronous
    // pulses
    input wire logic count_i,  // strobe: a pulse
    input wire logic ccw_i,  // 1: CCW, counts down
    input wire logic output_i,  // 1: pulses are being output
    // encoder, synchronous
    input wire logic epin_i,  // encoder pulse, counted at its rising edge
    input wire logic epdir_i,  // 0: up, 1: down
    // instructions
    input wire logic [31:0] value_i,  // new position in pulses or edges, two's complement
    input wire logic [31:0] lock_value_i,  // new interlock position
    input wire logic set_pos_i,  // strobe: set the position
    input wire logic set_enc_i,  // strobe: set the encoder position
    input wire logic set_lock_i,  // strobe: set the interlock position
    input wire logic toggle_lock_i,  // strobe: toggle interlock control
    input wire logic [1:0] set_window_i,  // strobes: latch flags and range
    input wire logic [2:0] window_flags_i,  // flags FO, RES, EN of the instruction
    input wire logic [15:0] window_range_i,  // range in pulses
    // positions
    output logic [31:0] pos_o,  // position in pulses
    output logic [31:0] enc_o,  // encoder position in edges
    output logic counted_o,  // strobe: a pulse has been counted in pos_o
    // interlock
    output logic lock_o,  // 1: interlock control is active
    output logic unlock_o,  // strobe: report E1, interlock control ends
    // monitors, [0]: in-position, [1]: encode
    output logic [1:0] window_on_o,  // monitor is enabled
    output logic [1:0] outside_o,  // monitor is enabled, and the position is outside its range
    output logic [1:0] pending_o,  // a report is pending
    output logic [1:0] value_o,  // contents of the report; 1: outside the range, 0: inside
    input wire logic [1:0] load_i,  // strobes: the report is being loaded
    input wire logic [1:0] read_i,  // strobes: the report has been read
    output logic coupled_inside_o,  // 1: coupled_o = 1, and the position is inside the in-position range
    output logic coupled_o  // 1: the in-position monitor is evaluated, and controls the zero clamp
);

  logic epin_q, couple_q, hit, settled;
  logic [31:0] lock_pos_q, diff_q;
  logic [15:0] size_q;
  logic negative_q, large_q;
  logic [1:0][16:0] margin;  // range - magnitude of the difference; bit 16 = 1: not negative
  logic [1:0][15:0] range_q;
  logic [1:0] inside_q, evaluate;
  logic [3:0] settle_q;

  assign hit = counted_o && lock_o && pos_o == lock_pos_q;
  assign settled = settle_q[3] && !output_i;
  assign evaluate = {1'b1, settled};
  assign coupled_o = couple_q && window_on_o[0] && settled;
  assign coupled_inside_o = coupled_o && inside_q[0];

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      pos_o      <= '0;
      enc_o      <= '0;
      counted_o  <= 1'b0;
      epin_q     <= 1'b1;  // so a pin that is high after reset is not an edge
      lock_pos_q <= '0;
      lock_o     <= 1'b0;
      unlock_o   <= 1'b0;
      couple_q   <= 1'b0;
      settle_q   <= '0;
    end else begin
      counted_o <= count_i;
      if (set_pos_i) pos_o <= value_i;
      else if (count_i) pos_o <= pos_o + {{31{ccw_i}}, 1'b1};

      epin_q <= epin_i;
      if (set_enc_i) enc_o <= value_i;
      else if (epin_i && !epin_q) enc_o <= enc_o + {{31{epdir_i}}, 1'b1};

      if (set_lock_i) lock_pos_q <= lock_value_i;
      unlock_o <= hit;
      if (hit) lock_o <= 1'b0;
      else if (toggle_lock_i) lock_o <= !lock_o;

      if (set_window_i[0]) couple_q <= window_flags_i[2];
      settle_q <= (output_i || set_window_i[0]) ? '0 : {settle_q[2:0], 1'b1};
    end
  end

  always_comb begin
    for (int unsigned n = 0; n < 2; n++) begin
      margin[n] = {1'b0, range_q[n]} + {1'b0, ~size_q} + 17'(!negative_q);
    end
  end

  // No reset: the ranges are set before use; the other registers follow their inputs.
  always_ff @(posedge clk_i) begin
    diff_q <= pos_o - enc_o;
    // size_q is the magnitude of the difference or, if the difference is negative, the magnitude - 1, because
    // the bits are only inverted. In both cases, `margin` is 2**16 + range - magnitude.
    negative_q <= diff_q[31];
    size_q <= diff_q[15:0] ^ {16{diff_q[31]}};
    large_q <= diff_q[31:16] != {16{diff_q[31]}};
    for (int unsigned n = 0; n < 2; n++) begin
      if (set_window_i[n]) range_q[n] <= window_range_i;
      inside_q[n] <= !large_q && margin[n][16];
    end
  end

  for (genvar n = 0; n < 2; n++) begin : g_window
    ppmc312_window_monitor u_window (
        .clk_i,
        .rst_ni,
        .set_i     (set_window_i[n]),
        .enable_i  (window_flags_i[0]),
        .repeat_i  (window_flags_i[1]),
        .evaluate_i(evaluate[n]),
        .inside_i  (inside_q[n]),
        .enabled_o (window_on_o[n]),
        .outside_o (outside_o[n]),
        .pending_o (pending_o[n]),
        .value_o   (value_o[n]),
        .load_i    (load_i[n]),
        .read_i    (read_i[n])
    );
  end

endmodule

`default_nettype wire
