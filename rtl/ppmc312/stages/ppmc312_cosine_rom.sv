// SPDX-License-Identifier: Apache-2.0
// ppmc312_cosine_rom: weight of each stage of a ramp. Sigmoid ramp: raised cosine, round(65536 * (1 -
//         cos(pi * i / 126)) / 2). Linear ramp: i.
// Rules:  P312-TBL-01, which lists these values.
// Timing: latency 2 cycles.
`default_nettype none

module ppmc312_cosine_rom (
    input  wire logic        clk_i,     // clock
    input  wire logic        linear_i,  // 1: linear ramp, 0: sigmoid ramp
    input  wire logic [ 6:0] index_i,   // stage i, 0 .. 126
    output logic      [16:0] weight_o   // weight of stage i, two cycles later
);

  localparam int unsigned Half = 63;
  localparam logic [Half:0][15:0] Weights = {  // last value first
    16'd32768,
    16'd31951,
    16'd31135,
    16'd30319,
    16'd29505,
    16'd28694,
    16'd27884,
    16'd27078,
    16'd26275,
    16'd25476,
    16'd24682,
    16'd23893,
    16'd23109,
    16'd22332,
    16'd21561,
    16'd20797,
    16'd20040,
    16'd19291,
    16'd18550,
    16'd17819,
    16'd17097,
    16'd16384,
    16'd15682,
    16'd14990,
    16'd14309,
    16'd13640,
    16'd12983,
    16'd12337,
    16'd11705,
    16'd11086,
    16'd10480,
    16'd9888,
    16'd9310,
    16'd8747,
    16'd8199,
    16'd7666,
    16'd7149,
    16'd6648,
    16'd6162,
    16'd5694,
    16'd5242,
    16'd4807,
    16'd4390,
    16'd3990,
    16'd3609,
    16'd3245,
    16'd2900,
    16'd2573,
    16'd2265,
    16'd1976,
    16'd1706,
    16'd1456,
    16'd1225,
    16'd1013,
    16'd822,
    16'd650,
    16'd498,
    16'd366,
    16'd254,
    16'd163,
    16'd92,
    16'd41,
    16'd10,
    16'd0
  };

  (* rom_style = "block" *)
  logic [16:0] rom[256];
  logic [16:0] word_q;

  initial begin
    for (int unsigned i = 0; i < 128; i++)
    rom[i] = (i <= Half) ? 17'(Weights[6'(i)]) : 17'h10000 - 17'(Weights[6'(2*Half-i)]);
    for (int unsigned i = 0; i < 128; i++) rom[128+i] = 17'(i);
  end

  always_ff @(posedge clk_i) begin
    word_q   <= rom[{linear_i, index_i}];
    weight_o <= word_q;
  end

endmodule

`default_nettype wire
