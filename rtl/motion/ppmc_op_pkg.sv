// SPDX-License-Identifier: Apache-2.0
// ppmc_op_pkg: operation numbers of the PPMC family (bits 2:0 of a code), and their conversion for
//         ppmc_axis.
// Rules:  P104-OPR-01, P104-CMD-01; P2104-CMD-01.
`default_nettype none

package ppmc_op_pkg;

  // A design uses only some of the items of this package.
  // verilator lint_off UNUSEDPARAM

  localparam logic [2:0] OP_SINGLE = 3'b010;
  localparam logic [2:0] OP_ACC_DEC = 3'b011;
  localparam logic [2:0] OP_CONSTANT = 3'b100;
  localparam logic [2:0] OP_CONT_CONSTANT = 3'b101;
  localparam logic [2:0] OP_CONT_HIGH = 3'b110;
  localparam logic [2:0] OP_ORIGIN = 3'b111;

  // Converts an operation to the form that the axis uses.
  function automatic ppmc_motion_pkg::op_t motion_op(logic pout_only, logic ccw, logic [2:0] op);
    return
    '{
        ramp: op inside {OP_ACC_DEC, OP_CONT_HIGH},
        single: op == OP_SINGLE,
        origin: op == OP_ORIGIN,
        pout_only: pout_only,
        ccw: ccw
    }
    ;
  endfunction

  // Returns the number of bytes that follow the code.
  function automatic logic [2:0] op_params(logic [2:0] op);
    unique case (op)
      OP_ACC_DEC:                  return 3'd3;
      OP_CONSTANT:                 return 3'd4;
      OP_CONT_CONSTANT, OP_ORIGIN: return 3'd1;
      default:                     return 3'd0;
    endcase
  endfunction

  // verilator lint_on UNUSEDPARAM

endpackage

`default_nettype wire
