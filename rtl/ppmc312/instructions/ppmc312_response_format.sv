// SPDX-License-Identifier: Apache-2.0
// ppmc312_response_format: selects the kind of the response to an instruction from the result of its check or
//         of its execution.
// Rules:  docs/ppmc312/README.md, 6.1; docs/ppmc312/instructions.md; P312-OVR-04, P312-EVT-02,
//         P312-CMD-FC-1..4, P312-CMD-49.
// Timing: combinational.
`default_nettype none

module ppmc312_response_format
  import ppmc312_pkg::*;
  import ppmc312_link_pkg::*;
  import ppmc312_instr_pkg::*;
(
    input  wire block_t               block_i,         // the instruction
    input  wire check_e               check_i,         // result of the check
    input  wire logic           [7:0] error_i,         // error number of response F0; byte s of response F1
    input  wire status_e              status_i,        // status of the device
    // processing step of the instruction; at most one of these inputs is 1
    input  wire logic                 at_boot_i,       // no instruction: report the reset by an instruction
    input  wire logic                 at_act_i,        // the check is complete
    input  wire logic                 at_setup_i,      // the set-up is in progress
    input  wire logic                 at_copy_i,       // the instruction is being copied into the queue
    input  wire logic                 at_move_i,       // a start or a rate change is in progress
    input  wire logic                 fails_i,         // the triggered instruction cannot be executed
    input  wire logic                 registers_i,     // the instruction is to be stored in the command FIFO
    input  wire logic                 used_i,          // the other kind of trigger uses the event pin
    input  wire logic           [2:0] evt_count_i,     // entries of the event buffer, 0 .. 4
    // result
    input  wire response_kind_e       result_kind_i,   // response to an executed instruction
    input  wire setup_status_t        setup_status_i,  // status of the set-up; valid with at_setup_i
    input  wire move_status_t         move_status_i,   // result of the move; valid with at_move_i
    output response_t                 response_o       // response to be written
);

  curve_progress_t progress;
  response_kind_e kind;
  logic [7:0] number;
  logic host, inner;

  assign progress = setup_status_i.progress;
  assign host = block_i.source == SrcHost;
  assign inner = block_i.code == I_EVT_SET;

  always_comb begin
    kind   = result_kind_i;
    number = 8'h00;
    unique case (1'b1)
      at_boot_i: kind = KindBoot;
      at_setup_i: begin
        if (setup_status_i.failed) begin
          kind   = KindParam;
          number = setup_status_i.error;
        end else if (block_i.head[1] || !host) kind = KindCode;  // initial setting
        else if (progress.complete) kind = KindSums;
        else begin
          kind   = KindProgress;
          number = 8'(progress.next_list);
        end
      end
      at_copy_i: kind = inner ? KindNumber : KindStored;
      at_move_i: begin
        number = move_status_i.status_byte;
        if (move_status_i.rejected) begin
          kind   = KindStatus;
          number = 8'h00;
        end
        if (move_status_i.at_limit) kind = KindLimit;
      end
      default: begin
        number = error_i;  // 0 unless the response contains it
        unique case (check_i)
          CheckParam:   kind = KindParam;
          CheckStatus:  kind = KindStatus;
          CheckCommand: kind = KindCommand;
          CheckSize:    kind = KindSize;
          default: begin
            if (registers_i) begin
              kind   = KindFull;
              number = 8'(used_i);
            end
            if (inner) begin
              number = used_i ? 8'h01 : 8'h02;
              if (block_i.par[0][1])
                number = evt_count_i == '0 ? 8'h05 : (evt_count_i == 3'd1) ? 8'h04 : 8'h03;
            end
          end
        endcase
      end
    endcase
    if (fails_i) begin
      kind   = (block_i.source == SrcEvent) ? KindFailEvent : KindFailOverride;
      number = 8'h00;
      if (at_act_i && check_i == CheckCommand) number = 8'h05;
      if (at_act_i && check_i == CheckStatus) number = 8'h01;
      if (at_move_i) number = move_status_i.at_limit ? 8'h02 : 8'h01;
    end
  end

  assign response_o = '{kind: kind, number: number, status: status_i};

  logic unused_bits;
  assign unused_bits = &{1'b0, block_i, progress, setup_status_i, move_status_i};

endmodule

`default_nettype wire
