// SPDX-License-Identifier: Apache-2.0
// ppmc_bridge_tx: sends messages as frames with flags, escapes and CRC.
// Rules:  UB-FRM-01 .. 03.
// Timing: a message begins in a cycle in which start_i and idle_o are high. more_i is sampled one character
//         time after the previous take_o. If more_i is high, take_o accepts byte_i; otherwise the CRC and
//         the end flag follow. idle_o rises when the last stop bit has ended.
`default_nettype none

module ppmc_bridge_tx
  import ppmc_bridge_pkg::*;
(
    input  wire logic       clk_i,
    input  wire logic       rst_ni,
    // message
    input  wire logic       start_i,  // strobe: begin a frame
    output logic            idle_o,   // 1: no frame is being sent
    input  wire logic [7:0] byte_i,   // next byte of the frame
    input  wire logic       more_i,   // 1: byte_i is valid, 0: the frame ends
    output logic            take_o,   // strobe: byte_i is accepted
    // transmitter
    output logic      [7:0] byte_o,   // character to be sent
    output logic            valid_o,  // 1: byte_o is valid
    input  wire logic       ready_i   // 1: byte_o is accepted
);

  typedef enum logic [2:0] {
    StIdle,
    StContent,
    StCrcHigh,
    StCrcLow,
    StFlag
  } state_e;

  state_e state_q;
  logic full_q, plain_q, escaped_q;
  logic special, accepted;
  logic [ 7:0] char_q;  // next character, not escaped
  logic [15:0] crc_q;
  logic [ 3:0] bit_q;  // bit of char_q that the CRC uses next; 8: no bit
  logic        feedback;

  // A byte that must be escaped is sent as two characters.
  assign special  = !plain_q && !escaped_q && (char_q == FLAG || char_q == ESCAPE);
  assign byte_o   = special ? ESCAPE : char_q ^ (8'(escaped_q) << ESCAPE_BIT);
  assign valid_o  = full_q;
  assign accepted = full_q && ready_i;
  assign take_o   = state_q == StContent && !full_q && ready_i && more_i;
  assign idle_o   = state_q == StIdle && !full_q && ready_i;

  // The next character is selected when the transmitter is free again. This adds one idle cycle to each
  // character.
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      state_q <= StIdle;
      full_q  <= 1'b0;
    end else if (accepted) begin
      full_q <= special;
    end else if (!full_q && ready_i) begin
      unique case (state_q)
        StIdle:
        if (start_i) begin
          state_q <= StContent;
          full_q  <= 1'b1;
        end
        StContent: begin
          if (!more_i) state_q <= StCrcHigh;
          full_q <= more_i;
        end
        StCrcHigh: begin
          state_q <= StCrcLow;
          full_q  <= 1'b1;
        end
        StCrcLow: begin
          state_q <= StFlag;
          full_q  <= 1'b1;
        end
        default: begin  // StFlag
          state_q <= StIdle;
          full_q  <= 1'b1;
        end
      endcase
    end
  end

  always_ff @(posedge clk_i) begin
    if (accepted) begin
      escaped_q <= special;
    end else if (!full_q && ready_i) begin
      plain_q   <= state_q == StIdle || state_q == StFlag;
      escaped_q <= 1'b0;
      unique case (state_q)
        StContent: char_q <= byte_i;
        StCrcHigh: char_q <= crc_q[15:8];
        StCrcLow:  char_q <= crc_q[7:0];
        default:   char_q <= FLAG;  // StIdle, StFlag
      endcase
    end
  end

  // The CRC uses one bit per cycle, so it is complete long before the next character.
  assign feedback = crc_q[15] ^ char_q[~bit_q[2:0]];

  always_ff @(posedge clk_i) begin
    if (take_o) bit_q <= '0;
    else if (!bit_q[3]) bit_q <= bit_q + 1'b1;
    if (state_q == StIdle) crc_q <= '1;
    else if (!bit_q[3]) crc_q <= {crc_q[14:0], 1'b0} ^ ({16{feedback}} & 16'h1021);
  end

endmodule

`default_nettype wire
