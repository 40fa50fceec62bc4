// SPDX-License-Identifier: Apache-2.0
// stmc_pkg: codes, limits and functions that only the J105 STMC has.
// Rules:  docs/stmc/README.md, 6.1 (codes); STMC-INI-02, STMC-MOT-03, STMC-MOV-04, STMC-BAD-05/07.
// Note:   hosts of this device send a divisor, but the core counts rate + 1 base clocks. Therefore a
//         divisor is stored minus 1 (0 .. 254); a divisor of 0 is stored as 255.
`default_nettype none

package stmc_pkg;

  // A design uses only some of the items of this package.
  // verilator lint_off UNUSEDPARAM

  import ppmc_code_pkg::*;
  import ppmc_op_pkg::*;

  localparam int unsigned RATE_BITS = 8;
  localparam int unsigned STEP_BITS = 32'd16;

  localparam int unsigned STEPS_MAX = 32'd65_535;  // largest number of acceleration steps PA
  localparam logic [RATE_BITS-1:0] RATE_NONE = '1;  // stored form of divisor 0

  localparam int unsigned STEP_XTAL = 1_280;  // period of the internal step clock in crystal cycles

  // Returns the data that read code `number` selects, numbered 0, 1, 2, 3 as in related devices. sheet_map =
  // 1: `number` is 0, 2, 3 or 4, as in the headings of the data sheet.
  function automatic logic [2:0] read_select(logic sheet_map, logic [2:0] number);
    return (sheet_map && number != 3'd0) ? number - 3'd1 : number;
  endfunction

  function automatic decoded_t decode(logic sheet_map, logic [7:0] code);
    decoded_t d;
    d = '{kind: CmdUndefined, params: 3'd0};
    if (code[7:6] == 2'b00) begin
      if (code[1:0] != 2'b00) d = '{kind: CmdInit, params: 3'd4};
    end else if (code[7:6] == 2'b01) begin
      unique case (code[2:0])
        3'b000:  d.kind = CmdHalt;
        3'b001:  d.kind = CmdDecel;
        default: d = '{kind: CmdOperation, params: op_params(code[2:0])};
      endcase
    end else if (code[6:3] == '0 && read_select(sheet_map, code[2:0]) <= SEL_REMAINING) begin
      if (!sheet_map || code[2:0] != 3'd1) d.kind = CmdRead;
    end
    return d;
  endfunction

  // Returns 1 if a data byte is a divisor. operation = 1: the data belong to operation number op, 0: to an
  // initialisation. left: missing data bytes, including this byte.
  function automatic logic is_divisor(logic operation, logic [2:0] op, logic [2:0] left);
    if (operation) return op inside {OP_CONT_CONSTANT, OP_ORIGIN} || (op == OP_CONSTANT && left == 3'd4);
    return left inside {3'd3, 3'd4};
  endfunction

  // Checks the complete data of a code; returns the error number. The first, second and last byte may be
  // divisors.
  function automatic cmd_error_e check_params(logic operation, logic [2:0] op, logic [7:0] first,
                                              logic [7:0] second, logic [7:0] last_byte);
    logic is_bad;
    unique case (op)
      OP_CONSTANT:                 is_bad = first == RATE_NONE;
      OP_CONT_CONSTANT, OP_ORIGIN: is_bad = last_byte == RATE_NONE;
      default:                     is_bad = 1'b0;
    endcase
    if (!operation) is_bad = first == RATE_NONE || second > first;
    return is_bad ? ErrRates : ErrUndefined;
  endfunction

  // Converts the data of an initialisation for the core. There is no ramp if PA is 0 or if both rates are
  // equal. Then both rates become the high-speed rate, and PA becomes 0.
  function automatic logic [31:0] normalise_rates(logic [31:0] data);
    logic [31:0] out;
    out = data;
    if (data[31:16] == '0) out[7:0] = data[15:8];
    if (data[15:8] == data[7:0]) out[31:16] = '0;
    return out;
  endfunction

  // verilator lint_on UNUSEDPARAM

endpackage

`default_nettype wire
