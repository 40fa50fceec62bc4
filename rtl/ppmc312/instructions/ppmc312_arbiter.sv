// SPDX-License-Identifier: Apache-2.0
// ppmc312_arbiter: which instruction is next: one that has been triggered, or the host's.
// Rules:  P312-OVR-10, P312-RSP-20.
// Timing: combinational. Triggered ones go first, but after one of them a waiting host goes next; among them
//         position before event 0 before event 1.
`default_nettype none

module ppmc312_arbiter
  import ppmc312_pkg::*;
  import ppmc312_link_pkg::*;
  import ppmc312_instr_pkg::*;
(
    input  wire logic    clk_i,       // clock
    input  wire logic    rst_ni,      // reset, asynchronous
    input  wire logic    idle_i,      // the next one can be taken
    input  wire logic    occupied_i,  // an answer waits to be read or stored
    input  wire logic    host_i,      // the host's waits
    input  wire stored_t stored_i,    // instructions that wait for a trigger
    output logic         start_o,     // one is taken
    output source_e      source_o,    // from here
    output logic         n_o,         // event buffer
    output logic         lost_o       // a triggered one cannot be executed
);

  logic any, host_turn_q, fifo, n;

  always_comb begin
    n    = !stored_i.events[0];
    fifo = stored_i.due;
    if (stored_i.due && stored_i.due_trig[0]) begin
      if (stored_i.events[0]) fifo = 1'b0;
      if (stored_i.events[1] && stored_i.due_trig[1]) fifo = 1'b0;
    end
  end

  assign any = (stored_i.due || stored_i.events != '0) && !(host_turn_q && host_i);
  assign lost_o = idle_i && any && occupied_i;
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
  assign unused_bits = &{1'b0, stored_i};

endmodule

`default_nettype wire
