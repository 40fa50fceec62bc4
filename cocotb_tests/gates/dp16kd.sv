// SPDX-License-Identifier: Apache-2.0
// DP16KD: simulation model of the block RAM of the ECP5, in the modes that this project uses. The model
//         library of yosys has only its ports. Any other mode ends the elaboration with an error.
// Rules:  two ports of 1 to 18 bits, without an output register. INITVAL contains 18 bits in each 20 bits, in
//         the order of their addresses. The lowest bit of the word address is AD5 (36 bits), AD4 (18 bits),
//         AD3 (9 bits), AD2 (4 bits), AD1 (2 bits) or AD0 (1 bit). AD0 to AD3 (36 bits), or AD0 and AD1
//         (18 bits), enable the bytes of a write. With 36 bits, port A only writes (DIB, DIA) and port B only
//         reads: a word of 36 bits is output on DOB and DOA, a narrower word on DOB only.
// Timing: read data is valid after the rising edge of the clock. During a write, the output of the port does
//         not change (NORMAL), or is the new word (WRITETHROUGH) or the old word (READBEFOREWRITE).
`default_nettype none

// Macros for the parameters INITVAL_00 .. INITVAL_3F, and for a concatenation of sixteen of them.
`define INITVAL(name) parameter logic [319:0] INITVAL_``name = '0
`define INITVALS(digit) `INITVAL(digit``0), `INITVAL(digit``1), `INITVAL(digit``2), `INITVAL(digit``3), \
    `INITVAL(digit``4), `INITVAL(digit``5), `INITVAL(digit``6), `INITVAL(digit``7), `INITVAL(digit``8), \
    `INITVAL(digit``9), `INITVAL(digit``A), `INITVAL(digit``B), `INITVAL(digit``C), `INITVAL(digit``D), \
    `INITVAL(digit``E), `INITVAL(digit``F)
`define SIXTEEN(digit) INITVAL_``digit``F, INITVAL_``digit``E, INITVAL_``digit``D, INITVAL_``digit``C, \
    INITVAL_``digit``B, INITVAL_``digit``A, INITVAL_``digit``9, INITVAL_``digit``8, INITVAL_``digit``7, \
    INITVAL_``digit``6, INITVAL_``digit``5, INITVAL_``digit``4, INITVAL_``digit``3, INITVAL_``digit``2, \
    INITVAL_``digit``1, INITVAL_``digit``0

module DP16KD #(
    parameter int DATA_WIDTH_A = 18,
    parameter int DATA_WIDTH_B = 18,
    parameter REGMODE_A = "NOREG",
    parameter REGMODE_B = "NOREG",
    parameter RESETMODE = "SYNC",
    parameter ASYNC_RESET_RELEASE = "SYNC",
    parameter CSDECODE_A = "0b000",
    parameter CSDECODE_B = "0b000",
    parameter string WRITEMODE_A = "NORMAL",
    parameter string WRITEMODE_B = "NORMAL",
    parameter CLKAMUX = "CLKA",
    parameter CLKBMUX = "CLKB",
    parameter GSR = "ENABLED",
    `INITVALS(0), `INITVALS(1), `INITVALS(2), `INITVALS(3)
) (
    input  wire logic DIA17, DIA16, DIA15, DIA14, DIA13, DIA12, DIA11, DIA10, DIA9,
    input  wire logic DIA8, DIA7, DIA6, DIA5, DIA4, DIA3, DIA2, DIA1, DIA0,
    input  wire logic ADA13, ADA12, ADA11, ADA10, ADA9, ADA8, ADA7, ADA6, ADA5, ADA4, ADA3, ADA2, ADA1, ADA0,
    input  wire logic CEA, OCEA, CLKA, WEA, RSTA, CSA2, CSA1, CSA0,
    output logic      DOA17, DOA16, DOA15, DOA14, DOA13, DOA12, DOA11, DOA10, DOA9,
    output logic      DOA8, DOA7, DOA6, DOA5, DOA4, DOA3, DOA2, DOA1, DOA0,
    input  wire logic DIB17, DIB16, DIB15, DIB14, DIB13, DIB12, DIB11, DIB10, DIB9,
    input  wire logic DIB8, DIB7, DIB6, DIB5, DIB4, DIB3, DIB2, DIB1, DIB0,
    input  wire logic ADB13, ADB12, ADB11, ADB10, ADB9, ADB8, ADB7, ADB6, ADB5, ADB4, ADB3, ADB2, ADB1, ADB0,
    input  wire logic CEB, OCEB, CLKB, WEB, RSTB, CSB2, CSB1, CSB0,
    output logic      DOB17, DOB16, DOB15, DOB14, DOB13, DOB12, DOB11, DOB10, DOB9,
    output logic      DOB8, DOB7, DOB6, DOB5, DOB4, DOB3, DOB2, DOB1, DOB0
);

  if (!(DATA_WIDTH_A inside {1, 2, 4, 9, 18, 36}) || !(DATA_WIDTH_B inside {1, 2, 4, 9, 18, 36})) begin : g_check_width
    $fatal(1, "DP16KD model: DATA_WIDTH must be 1, 2, 4, 9, 18 or 36");
  end
  if (DATA_WIDTH_B == 36 && DATA_WIDTH_A != 36) begin : g_check_wide
    $fatal(1, "DP16KD model: port B reads 36 bits only if port A writes 36 bits");
  end
  if (REGMODE_A != "NOREG" || REGMODE_B != "NOREG") begin : g_check_reg
    $fatal(1, "DP16KD model: REGMODE must be NOREG");
  end
  if (CLKAMUX != "CLKA" || CLKBMUX != "CLKB") begin : g_check_clk
    $fatal(1, "DP16KD model: the clocks must not be inverted");
  end
  if (CSDECODE_A != "0b000" || CSDECODE_B != "0b000") begin : g_check_cs
    $fatal(1, "DP16KD model: CSDECODE must be 0b000");
  end
  localparam logic [64*320-1:0] Content = {`SIXTEEN(3), `SIXTEEN(2), `SIXTEEN(1), `SIXTEEN(0)};
  localparam bit Wide = DATA_WIDTH_A == 36;

  // Both ports can write, so two processes drive the memory.
  // verilator lint_off MULTIDRIVEN
  logic [35:0] mem[512];
  // verilator lint_on MULTIDRIVEN
  logic [17:0] d[2];
  wire logic [35:0] q[2];
  logic [13:0] ad[2];
  logic [1:0] we, ce, clk, rst;

  initial for (int i = 0; i < 512; i++) mem[i] = {Content[40*i+20+:18], Content[40*i+:18]};

  assign d[0] = {DIA17, DIA16, DIA15, DIA14, DIA13, DIA12, DIA11, DIA10, DIA9,
                 DIA8, DIA7, DIA6, DIA5, DIA4, DIA3, DIA2, DIA1, DIA0};
  assign d[1] = {DIB17, DIB16, DIB15, DIB14, DIB13, DIB12, DIB11, DIB10, DIB9,
                 DIB8, DIB7, DIB6, DIB5, DIB4, DIB3, DIB2, DIB1, DIB0};
  assign ad[0] = {ADA13, ADA12, ADA11, ADA10, ADA9, ADA8, ADA7, ADA6, ADA5, ADA4, ADA3, ADA2, ADA1, ADA0};
  assign ad[1] = {ADB13, ADB12, ADB11, ADB10, ADB9, ADB8, ADB7, ADB6, ADB5, ADB4, ADB3, ADB2, ADB1, ADB0};
  assign {DOA17, DOA16, DOA15, DOA14, DOA13, DOA12, DOA11, DOA10, DOA9,
          DOA8, DOA7, DOA6, DOA5, DOA4, DOA3, DOA2, DOA1, DOA0} = Wide ? q[1][17:0] : q[0][17:0];
  assign {DOB17, DOB16, DOB15, DOB14, DOB13, DOB12, DOB11, DOB10, DOB9,
          DOB8, DOB7, DOB6, DOB5, DOB4, DOB3, DOB2, DOB1, DOB0} = q[1][DATA_WIDTH_B == 36 ? 18 : 0 +: 18];
  assign clk = {CLKB, CLKA};
  assign we  = {WEB, WEA};
  assign rst = {RSTB, RSTA};
  assign ce  = {CEB && {CSB2, CSB1, CSB0} == '0, CEA && {CSA2, CSA1, CSA0} == '0};

  for (genvar p = 0; p < 2; p++) begin : g_port
    localparam int Width = p == 0 ? DATA_WIDTH_A : DATA_WIDTH_B;
    localparam string Mode = p == 0 ? WRITEMODE_A : WRITEMODE_B;
    logic [35:0] data, word, fresh, out, written;
    logic [3:0] bytes;
    logic [5:0] place;  // lowest bit of the port's word in the word of 36 bits

    initial out = '0;
    assign q[p] = out;

    always_comb begin
      if (Width == 36) begin
        place = '0;
        bytes = ad[p][3:0];
        data  = {d[1], d[0]};
      end else if (Width == 18) begin
        place = ad[p][4] ? 6'd18 : '0;
        bytes = ad[p][4] ? {ad[p][1:0], 2'b0} : {2'b0, ad[p][1:0]};
        data  = {2{d[p]}};
      end else begin
        place = 6'd9 * 6'(ad[p][4:3]);
        bytes = 4'b1 << ad[p][4:3];
        data  = {4{d[p][8:0]}};
        if (Width < 9) begin  // words of 4 bits or less do not use the ninth bit
          place = place + 6'(int'(ad[p][2:0]) & (8 - Width));
          data  = 36'(d[p]) << place;
        end
      end
      for (int i = 0; i < 36; i++) written[i] = bytes[i/9];
      if (Width < 9) written = ((36'd1 << Width) - 36'd1) << place;
      word = mem[ad[p][13:5]];
      if (we[p] && Mode == "WRITETHROUGH") word = (word & ~written) | (data & written);
      fresh = (word >> place) & (36'hF_FFFF_FFFF >> (36 - Width));
    end

    always_ff @(posedge clk[p]) begin
      for (int i = 0; i < 36; i++) begin
        if (ce[p] && we[p] && written[i]) mem[ad[p][13:5]][i] <= data[i];
      end
      if (Wide && p == 1 && ce[p] && we[p]) $fatal(1, "DP16KD model: with 36 bits port B must not write");
    end

    if (RESETMODE == "ASYNC") begin : g_async
      always_ff @(posedge clk[p], posedge rst[p]) begin
        if (rst[p]) out <= '0;
        else if (ce[p] && !(we[p] && Mode == "NORMAL")) out <= fresh;
      end
    end else begin : g_sync
      always_ff @(posedge clk[p]) begin
        if (rst[p]) out <= '0;
        else if (ce[p] && !(we[p] && Mode == "NORMAL")) out <= fresh;
      end
    end
  end

endmodule

`default_nettype wire
