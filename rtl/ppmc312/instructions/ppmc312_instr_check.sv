// SPDX-License-Identifier: Apache-2.0
// ppmc312_instr_check: checks whether a block may be executed. The order of the checks is size, header,
//         code, status, length, values.
// Rules:  P312-BLK-01, P312-STA-01, P312-CMD-8L/8V, P312-EVT-03; docs/ppmc312/README.md, 6.1 (error numbers).
// Timing: check_o is valid three cycles after block_i is valid.
`default_nettype none

module ppmc312_instr_check
  import ppmc312_pkg::*;
  import ppmc312_link_pkg::*;
  import ppmc312_instr_pkg::*;
  import ppmc312_stage_pkg::*;
(
    input  wire logic              clk_i,       // clock
    input  wire logic              rst_ni,      // reset, asynchronous
    input  wire block_t            block_i,     // the instruction
    input  wire instr_info_t       info_i,      // properties of block_i.code
    input  wire logic              hold_i,      // 1: check_o keeps its value
    input  wire status_e           status_i,    // status of the device
    input  wire logic              end_wait_i,  // a motion waits for END
    input  wire logic              transfer_i,  // a free-curve transfer is open
    input  wire table_t            table_i,     // active table
    output check_e                 check_o,     // result of the check
    output logic             [7:0] error_o,     // error number of response F0; byte s of response F1
    output logic                   ov_o         // 1: store the instruction in the command FIFO
);

  logic host, ov, le, trig_pos, size_bad, len_bad, len_is_long, huge, accepted, is_table_read, table_q;
  logic [4:0] few;  // size / 2
  logic [4:0] fits;  // length that matches the size
  logic [7:0] flags, inner, value_error, size_error;
  logic [15:0] rate, range, start_rate, stop_rate, high_rate, bound;
  logic [16:0] above_q;  // a rate minus its bound
  logic [1:0] turn_q, above_turn_q;  // turn_q: number of this comparison; above_turn_q: of that in above_q
  logic above, near, slow_bad_q, fast_bad_q, given_q, acc_slowest_q;
  logic [1:0] order_q, near_q;
  logic [31:0] count;
  logic rate_bad_q, count_bad_q, init_rate_q, value_bad;
  logic event_q, embedded_bad;
  check_e check;
  logic [7:0] error;

  assign host = block_i.source == SrcHost;
  assign flags = block_i.par[0];
  assign ov = info_i.has_ov && flags[2] && host;  // a triggered instruction is executed, not stored
  assign le = flags[4];
  assign trig_pos = !flags[0];
  assign rate = {block_i.par[1], block_i.par[2]};
  assign range = rate;
  assign count = {block_i.par[3], block_i.par[4], block_i.par[5], block_i.par[6]};
  assign is_table_read = block_i.code == I_TABLE;

  // One subtractor makes four comparisons in sequence. The first two compare the start-up rate and the stop
  // rate of an initialisation with its high-speed rate (`near`: the difference is below 128). The other two
  // compare the rate of an instruction with the fastest and the slowest rate of the table. All results are
  // valid long before the block is complete.
  assign start_rate = rate;
  assign stop_rate = {block_i.par[3], block_i.par[4]};
  assign high_rate = {block_i.par[5], block_i.par[6]};
  assign above = !above_q[16] && above_q[15:0] != '0;
  assign near = above_q[15:7] == '0;

  always_comb begin
    bound = high_rate;
    if (turn_q == 2'd2) bound = table_i.high_rate;
    if (turn_q == 2'd3) bound = acc_slowest_q ? table_i.rate_acc : table_i.rate_dec;
  end

  always_ff @(posedge clk_i) begin
    acc_slowest_q <= ppmc_pkg::less(32'(table_i.first_acc), 32'(table_i.first_dec));
    given_q <= rate != '0;
    rate_bad_q <= (given_q || !info_i.zero_is_rh) && (fast_bad_q || slow_bad_q);
    count_bad_q <= count == '0;
    init_rate_q <= high_rate[15:1] == '0 || high_rate[15:4] == '1 || below_17(
        start_rate
    ) || below_17(
        stop_rate
    );
    above_q <= {1'b0, (turn_q == 2'd1) ? stop_rate : start_rate} - {1'b0, bound};
    above_turn_q <= turn_q;
    unique case (above_turn_q)
      2'd0: {order_q[0], near_q[0]} <= {!above, near};
      2'd1: {order_q[1], near_q[1]} <= {!above, near};
      2'd2: fast_bad_q <= above_q[16];
      default: slow_bad_q <= above;
    endcase
    event_q <= block_i.source == SrcEvent &&
        ((info_i.has_ov && flags[2]) || block_i.code inside {I_FREE, I_TABLE, I_EVT_SET});
    table_q <= table_i.valid;
  end

  // ---- size and length ----------------------------------------------------------------------------

  // Bit patterns are used, because a comparison with a constant would be a carry chain.
  assign few = block_i.size[5:1];
  assign huge = block_i.len[7:5] != '0 || block_i.len[4:0] == '1;  // 31 or more
  // fits = size - 2. A size of 0 or 1 is an error regardless of this result.
  assign fits = {
    few[3] ^ (few[2:0] == '0), few[2] ^ (few[1:0] == '0), few[1] ^ !few[0], !few[0], block_i.size[0]
  };
  assign size_bad = host && (few == '0 || block_i.len == '0 || huge || block_i.len[4:0] != fits);
  assign size_error = (few != '0 && huge) ? E_FREE_LONG : E_FREE_SIZE;
  assign len_is_long = block_i.len == 8'(info_i.len_long);
  // The length of the embedded block is 1 .. 14. The length of the outer block is greater by 4.
  assign inner = block_i.par[2];
  assign embedded_bad = block_i.par[1] != 8'h03 || inner == '0 || inner[7:4] != '0 || inner[3:0] == '1 ||
      block_i.len != {3'd0, inner[3] && inner[2], inner[3] ^ inner[2], !inner[2], inner[1:0]};

  always_comb begin
    len_bad = block_i.len != 8'(info_i.len_long) && block_i.len != 8'(info_i.len_short);
    if (block_i.code == I_INIT && le) len_bad = block_i.len != 8'd14;
    if (block_i.code == I_EVT_SET) len_bad = flags[1] ? block_i.len != 8'd2 : embedded_bad;
  end

  // ---- status -------------------------------------------------------------------------------------

  assign accepted = ((ov ? info_i.states_ov1 : info_i.states_ov0) & status_i) != '0
                    || (block_i.code == I_END && end_wait_i);

  // ---- values -------------------------------------------------------------------------------------

  always_comb begin
    value_bad   = 1'b1;
    value_error = E_OPERAND;
    unique case (block_i.code)
      I_INIT: begin
        if (init_rate_q) value_error = E_RATE;
        else if (order_q != '0) value_error = E_ORDER;
        else if (near_q == '1) value_error = E_SPREAD;
        else if (near_q != '0) value_error = E_CLOSE;
        else value_bad = 1'b0;
      end
      I_FREE: begin
        value_error = (block_i.head == 8'h03) ? E_FREE_HEADER : E_FREE_STAGES;
        value_bad = block_i.head == 8'h03 || stages_bad(block_i.par[1][7:1]) ||
            (le && (stages_bad(block_i.par[2][7:1]) || block_i.len == 8'd3));
      end
      I_INPOS: begin
        value_error = E_INPOS_ZERO;
        value_bad   = flags[0] && range == '0;
      end
      I_ENCODE: begin
        value_error = E_ENCODE_ZERO;
        value_bad   = flags[0] && range == '0;
      end
      I_LIMIT: begin
        value_error = E_RATE_RANGE;
        value_bad   = flags == '0 && block_i.par[1][7:1] == '0;
      end
      I_END, I_POS, I_POS_SET: value_bad = flags[7:1] != '0;
      I_EVT_READ: begin
        value_error = E_EVT_NUMBER;
        value_bad   = flags[7:1] != '0;
      end
      default: begin
        value_bad = 1'b0;
        if (ov && trig_pos) begin
          // Only stops and rate changes can wait for a position, and only if the block contains a position.
          value_bad   = !(block_i.code inside {I_HALT, I_DECEL, I_RAMP, I_SPEED}) || !len_is_long;
          value_error = (block_i.code inside {I_HALT, I_DECEL, I_RAMP, I_SPEED}) ? E_OPERAND : E_TRIGGER;
        end else if (!ov && info_i.has_count && count_bad_q) begin
          value_bad = 1'b1;
        end else if (!ov && info_i.has_rate && rate_bad_q) begin
          value_bad   = 1'b1;
          value_error = E_RATE_RANGE;
        end
      end
    endcase
  end

  function automatic logic stages_bad(logic [7:1] n);  // n: bits 7:1 of the number of stages
    return n[7] || n[6:1] == '0;  // below 2 or above 127
  endfunction

  function automatic logic below_17(logic [15:0] r);
    return r[15:5] == '0 && !(r[4] && r[3:0] != '0);  // below 17
  endfunction

  function automatic logic [7:0] len_error(logic [7:0] code, logic [7:0] head);
    unique case (code)
      I_INIT:    return E_INIT_LEN;
      I_FREE:    return (head == 8'h03) ? E_FREE_HEADER : E_FREE_STAGES;
      I_EVT_SET: return E_EVT_LEN;
      default:   return E_OPERAND;
    endcase
  endfunction

  // ---- result, in the order of the rules ----------------------------------------------------------

  always_comb begin
    check = CheckOk;
    error = 8'h00;
    if (size_bad && transfer_i) {check, error} = {CheckParam, size_error};
    else if (size_bad) check = CheckSize;
    else if (host && transfer_i) begin
      if (block_i.head[7:1] != '0) {check, error} = {CheckStatus, 8'h02};
      else check = CheckData;
    end else if (host && !(block_i.head inside {8'h02, 8'h03})) {check, error} = {CheckStatus, 8'h01};
    else if (!info_i.is_known) check = CheckCommand;
    else if (event_q) check = CheckParam;
    else if (host && block_i.head == 8'h02 && block_i.code != I_FREE) {check, error} = {CheckStatus, 8'h01};
    else if (!accepted || (is_table_read && !table_q)) check = CheckStatus;
    else if (len_bad) {check, error} = {CheckParam, len_error(block_i.code, block_i.head)};
    else if (value_bad) {check, error} = {CheckParam, value_error};
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      turn_q  <= '0;
      check_o <= CheckOk;
      error_o <= '0;
      ov_o    <= 1'b0;
    end else begin
      turn_q <= turn_q + 1'b1;
      if (!hold_i) begin
        check_o <= check;
        error_o <= error;
        ov_o    <= ov;
      end
    end
  end

  logic unused_bits;
  assign unused_bits = &{1'b0, block_i, table_i, info_i};

endmodule

`default_nettype wire
