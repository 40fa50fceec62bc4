// SPDX-License-Identifier: Apache-2.0
// ppmc_char_host: UART host interface for small FPGAs. For each access to the device, the PC sends one or two
//         characters and receives one as the answer. This block executes no scripts (docs/uart_bridge.md);
//         software on the PC does.
// Rules:  docs/char_host.md.
// Timing: rxd_i is synchronised in this block. A strobe begins 2 cycles after the last character of its
//         request was received, and lasts 8 cycles. The answer begins 2 cycles after the last strobe cycle.
// Assumes: d_i is stable from the end of a read strobe to the next read strobe. The PC waits for the answer
//         before it sends the next request.
`default_nettype none

module ppmc_char_host
  import ppmc_bridge_pkg::phase_step;
#(
    parameter int unsigned ClkHz     = 12_000_000,  // at least 40 * Baud
    parameter int unsigned XtalHz    = 16_000_000,  // crystal in Hz; only reported in info bytes
    parameter int unsigned Baud      = 115_200,     // line rate, fixed
    parameter int unsigned Part      = 104,         // part number in the info bytes
    parameter bit          Datasheet = 1'b0         // 1: the info bytes report DATASHEET timing
) (
    input  wire logic       clk_i,
    input  wire logic       rst_ni,
    input  wire logic       rxd_i,        // line from the PC, asynchronous
    output logic            txd_o,        // line to the PC
    // bus of the device
    output logic            cs_no,        // chip select
    output logic            rd_no,        // read strobe
    output logic            wr_no,        // write strobe
    output logic      [3:0] a_o,          // register
    output logic      [7:0] d_o,          // write data
    input  wire logic [7:0] d_i,          // read data
    output logic            part_rst_no,  // reset of the device, active low
    // board
    output logic      [6:0] straps_o,     // strap outputs
    input  wire logic [7:0] pins_i,       // levels of info byte 15, may be asynchronous
    output logic            active_o      // 1: an answer is being sent; for the link LED
);

  if (ClkHz < 40 * Baud) begin : g_check
    $fatal(1, "ppmc_char_host: ClkHz must be at least 40 * Baud");
  end

  // The step of the phase accumulators is at least 100, so rounding changes the rate by at most 0.5 %.
  localparam int unsigned Width = $clog2(100 * (ClkHz / Baud + 1));
  localparam logic [Width-1:0] Step = Width'(phase_step(Baud, ClkHz, Width));

  localparam logic [7:0] Mark = 8'h43;
  localparam logic [7:0] Version = 8'd1;
  // Info bytes, byte 0 in the lowest bits. Byte 15 is replaced by pins_i. "32'd0 |" is necessary: see
  // ppmc_uart_bridge.
  localparam logic [127:0] Info = {
    24'd0, 32'd0 | ClkHz, 32'd0 | XtalHz, 7'd0, Datasheet, Part[15:0], Version, Mark
  };

  // First character of a request. The second character of a write has data bits 6:0 in its bits 6:0.
  typedef struct packed {
    logic       first;   // 1: first character, 0: second character
    logic       write;
    logic       own;     // 1: info byte or control byte of this block, 0: register of the device
    logic [3:0] addr;
    logic       data_7;  // write: data bit 7
  } head_t;

  // ---- requests ------------------------------------------------------------------------------------

  head_t head, head_q;
  logic [7:0] char;
  logic received, error, is_break, unused;
  logic second_q;  // 1: the second character of a write is expected
  logic start_q;  // strobe: the last character has completed a request

  ppmc_uart_rx #(
      .Width(Width)
  ) u_rx (
      .clk_i,
      .rst_ni,
      .step_i (Step),
      .wrap_i ('0),
      .rxd_i,
      .byte_o (char),
      .valid_o(received),
      .error_o(error),
      .break_o(is_break)
  );

  assign head   = char;
  assign unused = ^{is_break, head_q.first};

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      second_q <= 1'b0;
      start_q  <= 1'b0;
    end else begin
      start_q <= received && (head.first ? !head.write : second_q);
      if (received || error) second_q <= received && head.first && head.write;
    end
  end

  always_ff @(posedge clk_i) if (received && head.first) head_q <= head;

  // ---- accesses ------------------------------------------------------------------------------------

  logic [3:0] strobe_q;  // 0: no strobe; otherwise counts from 8 to 15
  logic [7:0] control_q;  // bit 7: reset of the device, active low; bits 6:0: strap outputs

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      strobe_q    <= '0;
      control_q   <= '1;
      part_rst_no <= 1'b0;
    end else begin
      if (start_q && !head_q.own) strobe_q <= 4'd8;
      else if (strobe_q != '0) strobe_q <= strobe_q + 1'b1;
      if (start_q && head_q.own && head_q.write) control_q <= d_o;
      part_rst_no <= control_q[7];
    end
  end

  assign cs_no    = !strobe_q[3];
  assign rd_no    = !strobe_q[3] || head_q.write;
  assign wr_no    = !strobe_q[3] || !head_q.write;
  assign a_o      = head_q.addr;
  assign d_o      = {head_q.data_7, char[6:0]};
  assign straps_o = control_q[6:0];

  // ---- answers -------------------------------------------------------------------------------------

  // pins_i needs no synchroniser: the transmitter samples each bit in one flip-flop, and sends it at least
  // one bit time later.
  logic [7:0] info;
  logic answer_q, ready;

  assign info     = head_q.addr == '1 ? pins_i : Info[{head_q.addr, 3'b000}+:8];
  assign active_o = answer_q || !ready;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) answer_q <= 1'b0;
    else answer_q <= strobe_q == '1 || (start_q && head_q.own) || (answer_q && !ready);
  end

  ppmc_uart_tx #(
      .Width(Width)
  ) u_tx (
      .clk_i,
      .rst_ni,
      .step_i (Step),
      .byte_i (head_q.write ? d_o : head_q.own ? info : d_i),
      .valid_i(answer_q),
      .ready_o(ready),
      .txd_o
  );

endmodule

`default_nettype wire
