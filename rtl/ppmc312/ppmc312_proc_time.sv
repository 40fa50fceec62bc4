// SPDX-License-Identifier: Apache-2.0
// ppmc312_proc_time: with Datasheet = 1, delays the effect of an instruction by the processing time of the
//         old chip.
// Rules:  P312-TIM-02..13, P312-TIM-20.
// Timing: elapsed_o is high when the time of block_i has passed, counted from the last cycle in which idle_i
//         is high. With Datasheet = 0, elapsed_o is always high.
// Note:   the processing time of a start ends at pulse 1. Pulse 1 occurs one pulse width (TW) after t0, the
//         start of the motion.
`default_nettype none

module ppmc312_proc_time
  import ppmc312_pkg::*;
  import ppmc312_link_pkg::*;
#(
    parameter int unsigned ClkHz     = 16_000_000,
    parameter int unsigned XtalHz    = 16_000_000,
    parameter bit          Datasheet = 1'b0
) (
    input  wire logic         clk_i,     // clock
    input  wire logic         rst_ni,    // reset, asynchronous
    input  wire logic         idle_i,    // 1: no instruction is being processed
    input  wire block_t       block_i,   // the instruction; its time starts when idle_i falls
    input  wire logic   [7:0] kind_i,    // status byte of a planned operation; 0: trapezoidal
    output logic              elapsed_o  // the processing time has passed
);

  localparam int unsigned Width = 22;

  if (Datasheet) begin : g_datasheet
    // Times in crystal periods. The latency from the end of idle_i to this block, about 1 us, is neglected.
    localparam int unsigned PerUs = 16;
    localparam int unsigned Lead = WIDTH_XTAL + 8;

    logic past, elapsed_q, rate_given;
    logic [Width-1:0] limit, limit_q;

    function automatic logic [Width-1:0] us(int unsigned n);
      return Width'(PerUs * n - 8);
    endfunction

    function automatic logic [Width-1:0] pulse_us(int unsigned n);
      return Width'(PerUs * n - Lead);
    endfunction

    assign rate_given = {block_i.par[1], block_i.par[2]} != '0;

    always_comb begin
      limit = '0;
      unique case (block_i.code)
        I_INIT: begin
          unique case ({
            block_i.par[0][3], block_i.par[0][4]
          })
            2'b00:   limit = us(115_000);
            2'b01:   limit = us(200_000);
            2'b10:   limit = us(175_000);
            default: limit = us(260_000);
          endcase
        end
        I_MOVE: begin
          if (rate_given) limit = (kind_i == '0) ? pulse_us(900) : pulse_us(1400);
          else limit = (kind_i == '0) ? pulse_us(100) : pulse_us(700);
        end
        I_CONST, I_CONT: limit = pulse_us(400);
        I_HIGH, I_ZERO:  limit = rate_given ? pulse_us(400) : pulse_us(60);
        I_ORIGIN, I_STEP: limit = pulse_us(500);
        // A halt at a position has no processing time: the position comparison stops the pulses.
        I_HALT:    limit = (block_i.source == SrcOverride && !block_i.par[0][0]) ? '0 : us(350);
        I_AUX_OUT: limit = us(300);
        default:   ;
      endcase
    end

    // limit_q follows limit by one cycle. elapsed_q requires that limit was unchanged for two cycles.
    always_ff @(posedge clk_i or negedge rst_ni) begin
      if (!rst_ni) begin
        limit_q   <= '0;
        elapsed_q <= 1'b0;
      end else begin
        limit_q   <= limit;
        elapsed_q <= past && limit == limit_q;
      end
    end

    ppmc_xtal_timer #(
        .ClkHz (ClkHz),
        .XtalHz(XtalHz),
        .Width (Width)
    ) u_timer (
        .clk_i,
        .rst_ni,
        .restart_i(idle_i),
        .limit_i  (limit_q),
        .past_o   (past)
    );

    assign elapsed_o = elapsed_q;
  end else begin : g_fast
    localparam int unsigned Unused = ClkHz + XtalHz + Width;
    logic unused_bits;

    assign unused_bits = &{1'b0, Unused[0], clk_i, rst_ni, idle_i, block_i, kind_i};
    assign elapsed_o   = 1'b1;
  end

  logic unused_block;
  assign unused_block = &{1'b0, block_i};

endmodule

`default_nettype wire
