// SPDX-License-Identifier: Apache-2.0
// ppmc312_response_format: builds the response to an instruction from the result of its check or of its
//         execution.
// Rules:  docs/ppmc312/README.md, 6.1; docs/ppmc312/instructions.md; P312-OVR-04, P312-EVT-02,
//         P312-CMD-FC-1..4, P312-CMD-49.
// Timing: combinational.
`default_nettype none

module ppmc312_response_format
  import ppmc312_pkg::*;
  import ppmc312_link_pkg::*;
  import ppmc312_instr_pkg::*;
(
    input  wire block_t              block_i,         // the instruction
    input  wire check_e              check_i,         // result of the check
    input  wire logic          [7:0] error_i,         // error number of response F0; byte s of response F1
    input  wire status_e             status_i,        // status of the device
    // processing step of the instruction; at most one of these inputs is 1
    input  wire logic                at_boot_i,       // no instruction: report the reset by an instruction
    input  wire logic                at_act_i,        // the check is complete
    input  wire logic                at_setup_i,      // the set-up is in progress
    input  wire logic                at_copy_i,       // the instruction is being copied into the queue
    input  wire logic                at_move_i,       // a start or a rate change is in progress
    input  wire logic                fails_i,         // the triggered instruction cannot be executed
    input  wire logic                registers_i,     // the instruction is to be stored in the command FIFO
    input  wire logic                used_i,          // the other kind of trigger uses the event pin
    input  wire logic          [2:0] evt_count_i,     // entries of the event buffer, 0 .. 4
    // result
    input  wire result_data_t        result_data_i,   // data of the executed instruction
    input  wire setup_status_t       setup_status_i,  // status of the set-up; valid with at_setup_i
    input  wire move_status_t        move_status_i,   // result of the move; valid with at_move_i
    output response_t                response_o       // response to be written
);

  curve_progress_t progress;
  logic [7:0] code, flags;
  logic [1:0] fail_code;
  logic host, inner, starts_motion;

  assign progress = setup_status_i.progress;
  assign code = block_i.code;
  assign flags = block_i.par[0];
  assign host = block_i.source == SrcHost;
  assign inner = code == I_EVT_SET;
  assign starts_motion = !(code inside {I_RAMP, I_SPEED});

  always_comb begin
    fail_code = 2'd0;
    if (at_act_i && check_i == CheckStatus) fail_code = 2'd1;
    if (at_move_i) fail_code = move_status_i.at_limit ? 2'd2 : 2'd1;
  end

  always_comb begin
    response_o = '{
        head: {3'b000, block_i.source, 3'b011},
        code: code,
        extra: result_data_i.extra,
        data: result_data_i.data,
        tail: result_data_i.tail,
        echo: 1'b0
    };
    unique case (1'b1)
      at_boot_i: begin
        response_o.head  = 8'h03;
        response_o.code  = I_RESET;
        response_o.extra = 4'd0;
      end
      at_setup_i: begin
        response_o.code = I_FREE;
        response_o.tail = TailNone;
        if (block_i.head[1] || !host) begin  // initial setting
          response_o.code  = code;
          response_o.extra = 4'd0;
        end else if (progress.complete) begin
          response_o.extra   = 4'd7;
          response_o.data[0] = 8'h0f;
          response_o.tail    = TailSums;
        end else begin
          response_o.extra     = 4'd2;
          response_o.data[1:0] = {1'b0, progress.stages_left, 6'd0, progress.next_list};
        end
        if (setup_status_i.failed) begin
          response_o.code    = A_PARAM;
          response_o.extra   = 4'd1;
          response_o.data[0] = setup_status_i.error;
          response_o.tail    = TailNone;
          response_o.echo    = 1'b1;
        end
      end
      at_copy_i: begin
        response_o.code    = inner ? code : A_STORED;
        response_o.extra   = inner ? 4'd1 : 4'd0;
        response_o.data[0] = 8'h00;
      end
      at_move_i: begin
        response_o.extra   = (starts_motion && code != I_STEP) ? 4'd1 : 4'd0;
        response_o.data[0] = move_status_i.status_byte;
        if (move_status_i.rejected) begin
          response_o.code      = A_STATUS;
          response_o.extra     = 4'd2;
          response_o.data[1:0] = {2'b00, status_i, 8'h00};
        end
        if (move_status_i.at_limit) begin
          response_o.code  = A_LIMIT;
          response_o.extra = 4'd0;
        end
      end
      default: begin
        if (code == I_FREE) begin
          response_o.extra = 4'd2;
          response_o.data[1:0] = {
            (flags[4] && block_i.par[2] > block_i.par[1]) ? block_i.par[2] : block_i.par[1], 8'h00
          };
        end
        if (inner) begin
          response_o.extra   = 4'd1;
          response_o.data[0] = used_i ? 8'h01 : 8'h02;
          if (flags[1])
            response_o.data[0] = evt_count_i == '0 ? 8'h05 : (evt_count_i == 3'd1) ? 8'h04 : 8'h03;
        end
        if (registers_i) begin
          response_o.code    = A_FULL;
          response_o.extra   = 4'd1;
          response_o.data[0] = 8'(used_i);
        end
        if (code == I_TABLE && check_i == CheckOk) response_o.head[0] = 1'b0;  // data blocks follow
        if (check_i != CheckOk) response_o.tail = TailNone;
        unique case (check_i)
          CheckParam: begin
            response_o.code    = A_PARAM;
            response_o.extra   = 4'd1;
            response_o.data[0] = error_i;
            response_o.echo    = 1'b1;
          end
          CheckStatus: begin
            response_o.code      = A_STATUS;
            response_o.extra     = 4'd2;
            response_o.data[1:0] = {2'b00, status_i, error_i};
          end
          CheckCommand: begin
            response_o.code    = A_COMMAND;
            response_o.extra   = 4'd1;
            response_o.data[0] = code;
          end
          CheckSize: begin
            response_o.code    = A_SIZE;
            response_o.extra   = 4'd1;
            response_o.data[0] = block_i.len;
          end
          default: ;
        endcase
      end
    endcase
    if (fails_i) begin
      response_o.code    = (block_i.source == SrcEvent) ? A_EVENT : A_OVERRIDE;
      response_o.extra   = 4'd1;
      response_o.data[0] = (at_act_i && check_i == CheckCommand) ? 8'h05 : 8'(fail_code);
      response_o.tail    = TailNone;
      response_o.echo    = 1'b0;
    end
  end

  logic unused_bits;
  assign unused_bits = &{1'b0, block_i, flags, progress, setup_status_i, move_status_i};

endmodule

`default_nettype wire
