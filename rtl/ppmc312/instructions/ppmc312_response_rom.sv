// SPDX-License-Identifier: Apache-2.0
// ppmc312_response_rom: layouts of all responses: for each kind of response, the source of each byte.
// Rules:  docs/ppmc312/README.md, 6.1; docs/ppmc312/instructions.md; P312-OVR-04, P312-EVT-02,
//         P312-CMD-FC-1..4, P312-CMD-49.
// Timing: latency 2 cycles, because the slow block RAM has an output register.
`default_nettype none

module ppmc312_response_rom
  import ppmc312_pkg::*;
  import ppmc312_instr_pkg::*;
#(
    parameter logic [7:0] Version = 8'h12  // value that the version instruction returns
) (
    input wire logic clk_i,  // clock
    input wire response_kind_e kind_i,  // kind of the response
    input wire logic [3:0] at_i,  // byte of the response: 1: length, 2: code; 15: also any later byte
    output logic [12:0] source_o  // byte_source_e of this byte, two cycles later
);

  localparam int unsigned Kinds = 32;

  localparam logic [5:0][12:0] Sums = {ByteSum5, ByteSum4, ByteSum3, ByteSum2, ByteSum1, ByteSum0};

  typedef logic [15:0][12:0] layout_t;

  function automatic logic [12:0] lit(logic [7:0] value);
    return {value, 5'd0};
  endfunction

  // Bytes of a response from its code on; the first byte is on the right.
  function automatic layout_t bytes(response_kind_e kind);
    unique case (kind)
      KindCode:         return layout_t'(ByteCode);
      KindNumber:       return layout_t'({ByteNumber, ByteCode});
      KindPar:          return layout_t'({BytePar, ByteCode});
      KindFlag:         return layout_t'({ByteFlag, ByteCode});
      KindAuxi:         return layout_t'({ByteAuxi, ByteCode});
      KindPins:         return layout_t'({BytePins1, BytePins0, ByteCode});
      KindVersion:      return layout_t'({lit(Version), ByteCode});
      KindPos:          return layout_t'({BytePos3, BytePos2, BytePos1, BytePos0, BytePar, ByteCode});
      KindEntries:      return layout_t'({{4{ByteEntry}}, ByteNext, ByteCount, ByteCode});
      KindState:        return layout_t'({ByteState2, ByteState1, ByteState0, ByteCode});
      KindTable:        return layout_t'({Sums, ByteUsed2, ByteUsed1, ByteUsed0, ByteCode});
      KindProgress:     return layout_t'({ByteLeft, ByteNumber, lit(I_FREE)});
      KindSums:         return layout_t'({Sums, lit(8'h0f), lit(I_FREE)});
      KindBoot:         return layout_t'(lit(I_RESET));
      KindStored:       return layout_t'(lit(A_STORED));
      KindLimit:        return layout_t'(lit(A_LIMIT));
      KindFull:         return layout_t'({ByteNumber, lit(A_FULL)});
      KindParam:        return layout_t'({{12{ByteEcho}}, ByteNumber, lit(A_PARAM)});
      KindStatus:       return layout_t'({ByteStatus, ByteNumber, lit(A_STATUS)});
      KindCommand:      return layout_t'({ByteCode, lit(A_COMMAND)});
      KindSize:         return layout_t'({ByteLen, lit(A_SIZE)});
      KindFailEvent:    return layout_t'({ByteNumber, lit(A_EVENT)});
      KindFailOverride: return layout_t'({ByteNumber, lit(A_OVERRIDE)});
      default:          return '0;
    endcase
  endfunction

  // The same from the header on: two more bytes, of which the ROM contains the length.
  function automatic layout_t layout(response_kind_e kind);
    layout_t b;
    logic [7:0] len;
    b   = layout_t'({bytes(kind), 26'd0});
    len = 8'd0;
    for (int unsigned i = 2; i < 16; i++) if (b[i] != ByteNone) len++;
    b[1] = (kind == KindParam) ? ByteEchoLen : lit(len);
    return b;
  endfunction

  // The table is a constant, because synthesis evaluates the branches of `bytes` wrongly in an initial block.
  function automatic layout_t [Kinds-1:0] every_kind();
    layout_t [Kinds-1:0] words;
    for (int unsigned n = 0; n < Kinds; n++) words[n] = layout(response_kind_e'(5'(n)));
    return words;
  endfunction

  localparam layout_t [Kinds-1:0] Words = every_kind();

  (* rom_style = "block" *)
  logic [12:0] rom[16*Kinds];
  logic [12:0] word_q;

  initial for (int unsigned i = 0; i < 16 * Kinds; i++) rom[i] = Words[5'(i/16)][4'(i)];

  always_ff @(posedge clk_i) begin
    word_q   <= rom[{kind_i, at_i}];
    source_o <= word_q;
  end

endmodule

`default_nettype wire
