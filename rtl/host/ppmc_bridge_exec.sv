// SPDX-License-Identifier: Apache-2.0
// ppmc_bridge_exec: executes a script (list of operations, ops) on the bus of the device; stores the data.
// Rules:  table of the ops in docs/uart_bridge.md; UB-ANS-02 .. 05, UB-OPS-01, UB-WAIT-01.
// Timing: start_i begins a script of length_i bytes; resend_i sends the last answer again. Both occur only in
//         StIdle. answer_o is high until answered_i. A request byte is read two cycles after its address.
`include "ppmc_assert.svh"
`default_nettype none

module ppmc_bridge_exec
  import ppmc_bridge_pkg::*;
#(
    parameter int unsigned TopCode = 6,  // code of the highest line rate
    parameter int unsigned Axes = 1,  // number of pulse counters, 1 or 2
    parameter bit Recorder = 1'b0,  // 1: the bridge has a recorder
    parameter logic [127:0] Ident = '0,
    parameter logic [127:0] Build = '0  // data of op VERSION
) (
    input  wire logic                    clk_i,
    input  wire logic                    rst_ni,
    input  wire logic                    ms_i,          // strobe every millisecond
    // request
    input  wire logic                    start_i,       // strobe: begin a script
    input  wire logic                    resend_i,      // strobe: send the last answer again
    input  wire logic      [        7:0] length_i,      // length of the script in bytes
    output logic           [        7:0] raddr_o,       // address in the script
    input  wire logic      [        7:0] rdata_i,       // byte at raddr_o, two cycles later
    input  wire logic                    interrupt_i,   // 1: a byte was received after start_i
    // answer
    output logic                         script_o,      // 1: a script is running
    output logic                         answer_o,      // 1: the script has ended, its answer is being sent
    input  wire logic                    answered_i,    // strobe: the answer has been sent
    output script_result_t               result_o,      // result of the script
    output logic                         we_o,          // write enable of the answer buffer
    output logic           [        7:0] waddr_o,       // write address
    output logic           [        7:0] wdata_o,       // write data
    // settings
    output bridge_cmd_t                  bridge_cmd_o,  // settings made by scripts
    // recorder
    output logic                         rec_next_o,    // strobe: request the next byte of the recorder
    input  wire logic      [        7:0] rec_data_i,    // byte of the records
    input  wire logic      [       63:0] rec_info_i,    // data of op RECORDED
    // board
    input  wire logic      [        7:0] pins_i,        // pins for op PINS
    input  wire logic      [Axes*32-1:0] count_i,       // pulse counters; axis 1 is in bits 31:0
    output logic           [   Axes-1:0] count_zero_o,  // strobe: set the counter to 0
    output logic                         part_rst_no,   // reset of the device, active low
    // bus of the device
    output logic                         cs_no,         // chip select
    output logic                         rd_no,         // read strobe
    output logic                         wr_no,         // write strobe
    output logic           [        3:0] a_o,           // register
    output logic           [        7:0] d_o,           // write data
    input  wire logic      [        7:0] d_i            // read data
);

  typedef enum logic [3:0] {
    StIdle,
    StOp,        // accepts the next op
    StDecode,
    StArg,       // accepts the first operand
    StArg2,
    StCheck,     // checks the operands
    StLoop,      // begins the next byte of the op
    StPoll,      // begins a read access of a wait
    StCompare,   // checks the data of the read access
    StWrite,
    StWriteEnd,
    StRead,
    StReadEnd,
    StPut,       // stores a byte in the answer
    StPause,     // waits until RESET has ended or a block is stored
    StAnswer
  } state_e;

  state_e state_q;
  result_e result_q;
  logic [8:0] length;  // number of data bytes in the answer
  logic [7:0] pos_q;
  // n_q: operand 1, then remaining bytes of the op; left_q: remaining bytes of the script
  logic [7:0] op_q, n_q, value_q, left_q;
  logic [1:0] age_q;  // 00: a byte was just accepted or stored; 1x: two cycles later, its results are valid
  logic script_end_q, too_short_q, is_zero_q, bad_arg_q, hit_q, compare_q, timeout;
  logic first_q, written_q, has_read_q;
  logic [3:0] group, low;
  logic system, byte_valid, take;
  logic system_q, is_read_q, is_send_q, two_args_q, fetch_q;  // kind of the op; valid after StDecode

  assign {group, low} = op_q;
  assign system = group == OpSystem;
  assign byte_valid = age_q[1];

  // ---------------------------------------------------------------- bus

  logic req, ready, done;
  logic [3:0] addr;
  logic [7:0] bus_data;

  always_comb begin
    unique case (state_q)
      StPoll:  addr = group == OpWait ? low : 4'd1;
      StWrite: addr = group == OpCall ? {3'd0, first_q} : low;
      default: addr = group == OpGet ? 4'd0 : low;
    endcase
  end

  assign req = state_q == StPoll || state_q == StRead || (state_q == StWrite && byte_valid);

  ppmc_strobe_master #(
      .AddrBits(4)
  ) u_master (
      .clk_i,
      .rst_ni,
      .req_i  (req),
      .we_i   (state_q == StWrite),
      .addr_i (addr),
      .wdata_i(rdata_i),
      .ready_o(ready),
      .done_o (done),
      .rdata_o(bus_data),
      .cs_no,
      .rd_no,
      .wr_no,
      .a_o,
      .d_o,
      .d_i
  );

  // ---------------------------------------------------------------- answer

  logic ident, count, full, full4, full16, block, decode;
  logic second;  // 1: the op is for axis 2
  block_e block_kind;
  op_need_e need;
  result_e reject;

  assign decode   = state_q == StDecode && reject == ResDone;
  assign result_o = '{result: result_q, pos: pos_q, last: bus_data & {8{has_read_q}}, length: length};

  ppmc_bridge_decode #(
      .Axes    (Axes),
      .Recorder(Recorder)
  ) u_decode (
      .op_i    (op_q),
      .full_i  (full),
      .full4_i (full4),
      .full16_i(full16),
      .need_o  (need),
      .fail_o  (reject),
      .second_o(second),
      .ident_o (ident),
      .count_o (count),
      .block_o (block_kind)
  );

  ppmc_bridge_answer #(
      .Axes (Axes),
      .Ident(Ident),
      .Build(Build)
  ) u_answer (
      .clk_i,
      .rst_ni,
      .clear_i  (start_i),
      .put_i    (state_q == StPut),
      .data_i   (system_q ? pins_i : fetch_q ? rec_data_i : bus_data),
      .ident_i  (decode && ident),
      .block_i  (block_kind),
      .info_i   (rec_info_i),
      .count_i  (decode && count),
      .second_i (second),
      .counter_i(count_i),
      .busy_o   (block),
      .full_o   (full),
      .full4_o  (full4),
      .full16_o (full16),
      .length_o (length),
      .we_o,
      .waddr_o,
      .wdata_o
  );

  // ---------------------------------------------------------------- sequence

  state_e  next;
  result_e fail;  // other than ResDone: the script ends with this result

  always_comb begin
    next = state_q;
    fail = ResDone;
    take = 1'b0;
    unique case (state_q)
      StIdle: begin
        if (start_i) next = StOp;
        else if (resend_i) next = StAnswer;
      end
      StOp:
      if (byte_valid) begin
        take = !script_end_q;
        next = script_end_q ? StAnswer : StDecode;
      end
      StDecode: begin
        fail = reject;
        next = need == NeedOperand ? StArg : need == NeedCheck ? StCheck : need == NeedByte ? StPut :
               need == NeedBlock ? StPause : StOp;
      end
      StArg, StArg2:
      if (byte_valid) begin
        take = !script_end_q;
        if (script_end_q) fail = ResIllegal;
        else next = state_q == StArg && two_args_q ? StArg2 : StCheck;
      end
      StCheck:
      if (byte_valid) begin
        next = system_q ? StOp : group == OpWait ? StPoll : StLoop;
        if (system_q) begin
          if (bad_arg_q) fail = ResIllegal;
        end else if (group != OpWait && is_zero_q) fail = ResIllegal;
        else if (is_send_q && too_short_q) fail = ResIllegal;
        else if ((group == OpWait || group == OpCall) && full) fail = ResOverflow;
      end
      StLoop:
      if (byte_valid) begin
        if (is_zero_q) next = group == OpCall ? StPut : StOp;
        else if (is_read_q && full) fail = ResOverflow;
        else if (group == OpPost || group == OpCall || group == OpGet) next = StPoll;
        else next = fetch_q ? StPut : is_read_q ? StRead : StWrite;
      end
      StPoll: if (ready) next = StCompare;
      StCompare:
      if (compare_q) begin
        if (hit_q) begin
          if (group == OpWait) next = StPut;
          else if (group == OpGet) next = StRead;
          else if (!written_q) next = StWrite;
          else if (bus_data[7]) fail = ResRefused;
          else next = StLoop;
        end else if (interrupt_i) fail = ResInterrupted;
        else if (timeout) fail = ResTimeout;
        else next = StPoll;
      end
      StWrite:
      if (byte_valid && ready) begin
        take = 1'b1;
        next = StWriteEnd;
      end
      StWriteEnd: if (done) next = group == OpCall ? StPoll : StLoop;
      StRead: if (ready) next = StReadEnd;
      StReadEnd: if (done) next = StPut;
      StPut: next = is_read_q ? StLoop : StOp;
      StPause: if (low == SysReset ? n_q[7] : !block) next = StOp;
      default: if (answered_i) next = StIdle;  // StAnswer
    endcase
    if (fail != ResDone) next = StAnswer;
  end

  assign script_o   = state_q != StIdle && state_q != StAnswer;
  assign answer_o   = state_q == StAnswer;
  assign rec_next_o = Recorder && state_q == StPut && fetch_q;

  logic set, set_q;  // set: a valid op changes a setting; set_q follows one cycle later
  logic [7:0] straps_q;
  assign set = state_q == StCheck && byte_valid && system_q && !bad_arg_q;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      state_q      <= StIdle;
      result_q     <= ResDone;
      straps_q     <= '1;
      set_q        <= 1'b0;
      count_zero_o <= '0;
      part_rst_no  <= 1'b0;
    end else begin
      state_q <= next;
      if (start_i || fail != ResDone) result_q <= fail;
      set_q <= set;
      count_zero_o[0] <= state_q == StDecode && system && low == SysZero;
      if (Axes > 1) count_zero_o[Axes-1] <= state_q == StDecode && system && low == SysZero2;
      part_rst_no <= !(state_q == StPause && low == SysReset && n_q[4] && !n_q[7]);
      if (set && low == SysStraps) straps_q <= n_q;
    end
  end

  assign bridge_cmd_o = '{valid: set_q, op: sys_e'(low), arg: n_q[2:0], straps: straps_q};
  always_ff @(posedge clk_i) begin
    age_q <= take || start_i || state_q == StPut ? 2'b00 : {age_q[0], 1'b1};
    script_end_q <= left_q == '0;
    system_q <= system;
    fetch_q <= group == OpFetch;
    is_read_q <= group == OpRead || group == OpReadN || group == OpGet || group == OpFetch;
    is_send_q <= group == OpWrite || group == OpWriteN || group == OpPost || group == OpCall;
    two_args_q <= group == OpWait || (system && low == SysTimeout);
    too_short_q <= n_q > left_q;
    is_zero_q <= n_q == '0;
    bad_arg_q  <= (low == SysRate && n_q > 8'(TopCode)) || (low == SysEvents && n_q[7:1] != '0) ||
              (low == SysRecord && n_q > 8'(RECORD_REWIND));
    if (start_i) begin
      raddr_o <= '0;
      left_q  <= length_i;
    end else if (take) begin
      raddr_o <= raddr_o + 1'b1;
      left_q  <= left_q - 1'b1;
    end
    if (state_q == StOp && take) begin
      op_q  <= rdata_i;
      pos_q <= raddr_o;
    end
    unique case (state_q)
      StDecode: n_q <= system ? 8'd31 : group == OpWrite || group == OpRead ? 8'd1 : {4'd0, low};
      StArg: if (take) n_q <= rdata_i;
      StPause: n_q <= n_q - 1'b1;
      StWrite: if (take) n_q <= n_q - 1'b1;
      StReadEnd: if (done) n_q <= n_q - 1'b1;
      StPut: n_q <= n_q - 8'(fetch_q);
      default: ;
    endcase
    if (state_q == StArg2) value_q <= rdata_i;
    if (state_q == StDecode) first_q <= 1'b1;
    else if (state_q == StWriteEnd) first_q <= 1'b0;
    if (state_q == StLoop) written_q <= 1'b0;
    else if (state_q == StWriteEnd) written_q <= 1'b1;
  end

  // Time limit of waits.
  ppmc_bridge_wait u_wait (
      .clk_i,
      .ms_i,
      .start_i,
      .set_i    (state_q == StCheck && system_q && low == SysTimeout),
      .limit_i  ({value_q, n_q}),
      .waiting_i(state_q == StPoll || state_q == StCompare),
      .timeout_o(timeout)
  );

  always_ff @(posedge clk_i) begin
    compare_q <= done;
    unique case (group)
      OpWait:  hit_q <= (bus_data & n_q) == value_q;
      OpGet:   hit_q <= bus_data[0];
      default: hit_q <= !bus_data[1];
    endcase
    if (start_i) has_read_q <= 1'b0;
    else if (done && state_q != StWriteEnd) has_read_q <= 1'b1;
  end

`ifndef SYNTHESIS
  `PPMC_ASSERT(ub_exec_start_in_idle, !(start_i || resend_i) || state_q == StIdle)
`endif

endmodule

`default_nettype wire
