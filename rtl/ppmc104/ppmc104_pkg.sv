// SPDX-License-Identifier: Apache-2.0
// ppmc104_pkg: codes, limits and functions that only the PPMC-104BFP has.
// Rules:  P104-CMD-01..04, P104-INI-02/03, P104-SW-04.
`default_nettype none

package ppmc104_pkg;

  // A design uses only some of the items of this package.
  // verilator lint_off UNUSEDPARAM

  import ppmc_code_pkg::*;
  import ppmc_op_pkg::*;
  import ppmc_single_pkg::*;

  localparam int unsigned STEP_BITS = 32'd14;

  localparam int unsigned STEPS_MIN = 32'd4;  // smallest number of acceleration pulses PA
  localparam int unsigned STEPS_MAX = 32'd11_220;

  localparam int unsigned QUANTUM_XTAL = 32'd4;  // crystal cycles per quantum
  localparam int unsigned FAST_QUANTA = 32'd8;  // quanta per period of the 500 kHz base clock
  localparam int unsigned SLOW_QUANTA = 32'd32;  // quanta per period of the 125 kHz base clock
  localparam int unsigned EXTRA_QUANTA = 32'd30;  // extra time of an interval in quanta, 7.5 us
  localparam int unsigned HOLD_QUANTA = 32'd136_000;  // quanta from standstill to HOLD, 34 ms

  // Chopper times in quanta (P104-SW-04).
  localparam int unsigned CHOP_UNIT = 32'd12;
  localparam int unsigned CHOP_ON_DEFAULT = 260;
  localparam int unsigned CHOP_OFF_DEFAULT = 435;
  localparam int unsigned CHOP_ON_VSEL_H = 108;
  localparam int unsigned CHOP_OFF_VSEL_H = 132;
  localparam int unsigned CHOP_ON_VSEL_L = 100;
  localparam int unsigned CHOP_OFF_VSEL_L = 115;

  localparam part_cfg_t PART_CFG = '{
      step_bits: STEP_BITS,
      steps_min: STEPS_MIN,
      steps_max: STEPS_MAX,
      quantum_xtal: QUANTUM_XTAL,
      fast_quanta: FAST_QUANTA,
      slow_quanta: SLOW_QUANTA,
      extra_quanta: EXTRA_QUANTA,
      hold_quanta: HOLD_QUANTA,
      hold_rest_cycles: 0,
      chop_unit: CHOP_UNIT,
      chop_bits: 9,
      stmc_stop_rules: 1'b0
  };

  // Bits 2:0 of the codes 10 000 xxx that are not read commands.
  localparam logic [2:0] SEL_SWITCHING = 3'b100;
  localparam logic [2:0] SEL_AUX_OUT = 3'b110;

  function automatic decoded_t decode(logic [7:0] code);
    decoded_t d;
    d = '{kind: CmdUndefined, params: 3'd0};
    unique case (code[7:6])
      2'b10:
      if (code[5:3] == 3'b000) begin
        unique case (code[2:0])
          SEL_SWITCHING: d = '{kind: CmdSwitching, params: 3'd2};
          SEL_AUX_OUT:   d = '{kind: CmdAuxOut, params: 3'd1};
          3'b111:        ;
          default:       d.kind = CmdRead;
        endcase
      end
      2'b11:
      unique case (code[2:0])
        3'b000:                   d.kind = CmdExcOff;
        3'b001:                   d.kind = CmdAuxOn;
        3'b010:                   d.kind = CmdAuxOff;
        OP_ACC_DEC, OP_CONT_HIGH: d = '{kind: CmdOperation, params: op_params(code[2:0])};
        default:                  ;
      endcase
      2'b01: begin
        if (code[2:0] == 3'b000) d.kind = CmdHalt;
        else if (code[2:0] == 3'b001) d.kind = CmdDecel;
        else d = '{kind: CmdOperation, params: op_params(code[2:0])};
      end
      default: if (code[1:0] != 2'b00) d = '{kind: CmdInit, params: 3'd4};
    endcase
    return d;
  endfunction

  // Checks the complete parameters of an initialisation; returns the error number.
  function automatic cmd_error_e check_params(logic [31:0] params);
    if (params[31:16] > 16'(STEPS_MAX)) return ErrStepsHigh;
    if (ppmc_pkg::less(32'(params[7:0]), 32'(params[15:8])) || params[31:16] < 16'(STEPS_MIN))
      return ErrRates;
    return ErrUndefined;
  endfunction

  // verilator lint_on UNUSEDPARAM

endpackage

`default_nettype wire
