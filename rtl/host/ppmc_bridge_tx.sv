// SPDX-License-Identifier: Apache-2.0
// ppmc_bridge_tx: puts messages into frames: flags, escapes, CRC.
// Rules:  UB-FRM-01 .. 03.
// Timing: a message begins in a cycle with start_i and idle_o. take_o consumes byte_i. more_i = 1: another
//         byte is available; more_i is sampled one character time after the previous take_o. idle_o is high
//         again when the last stop bit has ended.
`default_nettype none

module ppmc_bridge_tx
  import ppmc_bridge_pkg::*;
(
    input  wire logic       clk_i,
    input  wire logic       rst_ni,
    // message
    input  wire logic       start_i,  // begin a frame
    output logic            idle_o,   // no frame is being sent
    input  wire logic [7:0] byte_i,   // next byte of the frame
    input  wire logic       more_i,   // byte_i is valid; 0: the frame ends
    output logic            take_o,   // byte_i is accepted
    // transmitter
    output logic      [7:0] byte_o,   // character
    output logic            valid_o,  // byte_o is valid
    input  wire logic       ready_i   // byte_o is accepted
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
  logic [ 7:0] char_q;  // next character, before escaping
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

  // The next character is chosen when the transmitter is free again, which adds one cycle of idle line to a
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

  // The CRC uses one bit a cycle, so it is ready long before the next character.
  assign feedback = crc_q[15] ^ char_q[~bit_q[2:0]];

  always_ff @(posedge clk_i) begin
    if (take_o) bit_q <= '0;
    else if (!bit_q[3]) bit_q <= bit_q + 1'b1;
    if (state_q == StIdle) crc_q <= '1;
    else if (!bit_q[3]) crc_q <= {crc_q[14:0], 1'b0} ^ ({16{feedback}} & 16'h1021);
  end

endmodule

`default_nettype wire
