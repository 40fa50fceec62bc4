// SPDX-License-Identifier: Apache-2.0
// ppmc312_arbiter: selects whether the next instruction is from a trigger or from the host.
// Rules:  P312-OVR-10, P312-RSP-20.
// Timing: combinational.
// How:    triggered instructions have priority. However, after a triggered instruction, a pending
//         instruction of the host is next. Among triggered instructions, the order is position, event 0,
//         event 1.
`default_nettype none

module ppmc312_arbiter
  import ppmc312_pkg::*;
  import ppmc312_link_pkg::*;
  import ppmc312_instr_pkg::*;
(
    input  wire logic          clk_i,           // clock
    input  wire logic          rst_ni,          // reset, asynchronous
    input  wire logic          idle_i,          // 1: the next instruction can be accepted
    input  wire logic          occupied_i,      // 1: a response is unread or not yet stored
    input  wire logic          host_i,          // an instruction of the host is pending
    input  wire queue_status_t queue_status_i,  // contents of the instruction queue
    output logic               start_o,         // strobe: an instruction is accepted
    output source_e            source_o,        // source of this instruction
    output logic               n_o,             // event buffer of this instruction
    output logic               missed_o         // strobe: a triggered instruction cannot be executed
);

  logic any, host_turn_q, fifo, n;

  always_comb begin
    n    = !queue_status_i.events_triggered[0];
    fifo = queue_status_i.fifo_triggered;
    if (queue_status_i.fifo_triggered && queue_status_i.fifo_trig[0]) begin
      if (queue_status_i.events_triggered[0]) fifo = 1'b0;
      if (queue_status_i.events_triggered[1] && queue_status_i.fifo_trig[1]) fifo = 1'b0;
    end
  end

  assign any = (queue_status_i.fifo_triggered || queue_status_i.events_triggered != '0)
               && !(host_turn_q && host_i);
  assign missed_o = idle_i && any && occupied_i;
  assign start_o = idle_i && (any ? !occupied_i : host_i);
  assign n_o = n;

  always_comb begin
    source_o = SrcHost;
    if (any) source_o = fifo ? SrcOverride : SrcEvent;
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) host_turn_q <= 1'b0;
    else if (start_o) host_turn_q <= any;
  end

  logic unused_bits;
  assign unused_bits = &{1'b0, queue_status_i};

endmodule

`default_nettype wire
