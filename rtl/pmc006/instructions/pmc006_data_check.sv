// SPDX-License-Identifier: Apache-2.0
// pmc006_data_check: checks the data of an instruction against its limits, regardless of the state of the
//         motor. Also selects the register of the instruction.
// Rules:  P006-CMD-51/57, P006-BAD-08/09/14/17; accepted data: docs/pmc006/README.md, 4 and 13.
// Timing: access_o is read from a block RAM and valid one cycle after read_i. ok_o is registered: it
//         results from cmd_i and from the limits in the previous cycle.
`default_nettype none

module pmc006_data_check
  import pmc006_pkg::*;
(
    input  wire logic            clk_i,
    input  wire logic            read_i,     // 1: read limits and register of op_i
    input  wire logic            program_i,  // with read_i; 1: op_i is a program code, 0: a frame code
    input  wire logic      [7:0] op_i,       // with read_i: instruction code
    input  wire exec_cmd_t       cmd_i,      // instruction with code op_i, from the cycle after read_i on
    output reg_access_t          access_o,   // register of op_i at the last read_i
    output logic                 ok_o        // 1: the data of cmd_i are accepted
);

  typedef struct packed {
    logic                has_limits;  // 1: low and high are the limits of the instruction
    logic [8:0]          low;
    logic [13:0]         high;
    reg_access_t access;
  } data_limits_t;

  function automatic reg_access_t reg_access(logic [7:0] op);
    unique case (op)
      I_MSTEP:        return '{write: 1'b1, reg_id: RegMstep};
      I_CURRENT:      return '{write: 1'b1, reg_id: RegCurrent};
      I_ACC:          return '{write: 1'b1, reg_id: RegAcc};
      I_DEC:          return '{write: 1'b1, reg_id: RegDec};
      I_AUTODEC:      return '{write: 1'b1, reg_id: RegAutodec};
      I_ATT:          return '{write: 1'b1, reg_id: RegAtt};
      I_VSTART:       return '{write: 1'b1, reg_id: RegVstart};
      I_VSTOP:        return '{write: 1'b1, reg_id: RegVstop};
      I_CCOMP:        return '{write: 1'b1, reg_id: RegCcomp};
      I_SCOMP:        return '{write: 1'b1, reg_id: RegScomp};
      I_VMAX:         return '{write: 1'b1, reg_id: RegVmax};
      I_DIR:          return '{write: 1'b1, reg_id: RegDir};
      I_FREE:         return '{write: 1'b1, reg_id: RegFree};
      I_ADDR:         return '{write: 1'b1, reg_id: RegAddr};
      I_TRIGGER:      return '{write: 1'b1, reg_id: RegTrigger};
      I_EXTEN:        return '{write: 1'b1, reg_id: RegExten};
      I_OFFLINE:      return '{write: 1'b1, reg_id: RegOffline};
      I_STLEN:        return '{write: 1'b1, reg_id: RegStlen};
      I_STCFG:        return '{write: 1'b1, reg_id: RegStcfg};
      I_STLVL:        return '{write: 1'b1, reg_id: RegStlvl};
      I_MSTEP_READ:   return '{write: 1'b0, reg_id: RegMstep};
      I_CURRENT_READ: return '{write: 1'b0, reg_id: RegCurrent};
      I_ACC_READ:     return '{write: 1'b0, reg_id: RegAcc};
      I_DEC_READ:     return '{write: 1'b0, reg_id: RegDec};
      I_ATT_READ:     return '{write: 1'b0, reg_id: RegAtt};
      I_VMAX_READ:    return '{write: 1'b0, reg_id: RegVmax};
      I_TRIGGER_READ: return '{write: 1'b0, reg_id: RegTrigger};
      default:        return '{write: 1'b0, reg_id: RegNone};
    endcase
  endfunction

  function automatic data_limits_t data_limits(logic is_program, logic [7:0] op);
    data_limits_t lim;
    lim = '{has_limits: 1'b1, low: 9'd0, high: 14'd1, access : reg_access(op)};
    unique case (op)
      I_OFFLINE, I_RUN, I_AUTODEC, I_DIR, I_FREE: lim.high = 14'd1;
      I_POINTER: lim.high = 14'd199;
      I_TRIGGER: lim.high = 14'd3;
      I_EXTEN: lim.high = is_program ? 14'd1 : 14'd3;
      I_VSTART, I_VSTOP: begin
        lim.low  = 9'd65;
        lim.high = 14'd3000;
      end
      I_CCOMP: begin
        lim.low  = 9'd100;
        lim.high = 14'd1200;
      end
      I_SCOMP: begin
        lim.low  = 9'd300;
        lim.high = 14'd2000;
      end
      I_ATT: begin
        lim.low  = 9'd1;
        lim.high = 14'd4;
      end
      I_STLEN: lim.high = 14'd63;
      I_STCFG: lim.high = 14'd7;
      I_STLVL: lim.high = 14'd511;
      I_CURRENT: begin
        lim.low  = 9'd400;
        lim.high = 14'd4000;
      end
      I_MSTEP: lim.high = 14'd128;
      I_DEC: lim.high = 14'd5;
      I_ACC: lim.high = is_program ? 14'd6 : 14'd5;
      I_VMAX: begin
        lim.low  = is_program ? 9'd0 : 9'd1;
        lim.high = 14'd16_000;
      end
      I_ADDR: begin
        lim.low  = 9'd1;
        lim.high = 14'd120;
      end
      P_JMP, P_JNE, P_JEQ, P_RESET_EN: lim.high = 14'd99;
      default: begin
        lim.has_limits = 1'b0;
        lim.high = 14'h3fff;
      end
    endcase
    return lim;
  endfunction

  // The table is one constant, because synthesis evaluates the branches of data_limits wrongly in an
  // initial block.
  function automatic data_limits_t [511:0] limits_table();
    data_limits_t [511:0] words;
    for (int unsigned i = 0; i < 512; i++) words[9'(i)] = data_limits(i >= 256, 8'(i));
    return words;
  endfunction

  localparam data_limits_t [511:0] LimitsTable = limits_table();

  (* rom_style = "block" *)
  data_limits_t rom[512];
  data_limits_t limits_q;
  logic [31:0] data;
  logic other_ok, always_ok;
  // above_q: data >= low; below_q: data <= high; other_ok_q: the other conditions are true; always_ok_q:
  // the data are accepted regardless of these three
  logic above_q, below_q, other_ok_q, always_ok_q;

  initial for (int unsigned i = 0; i < 512; i++) rom[i] = LimitsTable[9'(i)];

  always_ff @(posedge clk_i) if (read_i) limits_q <= rom[{program_i, op_i}];

  assign access_o = limits_q.access;
  assign data = cmd_i.data;

  // An instruction without limits has the limits 0 and 3FFFh, which accept any value of bits 13:0.
  always_comb begin
    other_ok  = !limits_q.has_limits || data[31:14] == '0;
    always_ok = 1'b0;
    unique case (cmd_i.op)
      I_STEP: other_ok = !data[31] && data[30:0] != '0;
      // Accepted: at most one bit of the byte is set, and bit 0 is not set.
      I_MSTEP: if (data[0] || (data[7:0] & (data[7:0] - 1'b1)) != '0) other_ok = 1'b0;
      I_ADDR: always_ok = cmd_i.source == FromBoot && data[15:0] == 16'h00ff;
      I_VMAX, P_RESET_EN, P_PAUSE_EN: if (cmd_i.option > 4'd1) other_ok = 1'b0;
      P_OUT: other_ok = cmd_i.option inside {[4'd1 : 4'd5]};
      P_WAIT, P_CMP: other_ok = cmd_i.option inside {[4'd1 : 4'd9]};
      default: ;
    endcase
  end

  always_ff @(posedge clk_i) begin
    above_q <= data[13:0] >= 14'(limits_q.low);
    below_q <= data[13:0] <= limits_q.high;
    other_ok_q <= other_ok;
    always_ok_q <= always_ok;
  end

  assign ok_o = (above_q && below_q && other_ok_q) || always_ok_q;

endmodule

`default_nettype wire
