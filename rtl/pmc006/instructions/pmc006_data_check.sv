// SPDX-License-Identifier: Apache-2.0
// pmc006_data_check: checks which data each instruction accepts, regardless of the state of the motor, and selects
// its register.
// Rules:  section 3.1 (accepted D), sections 12.3 and 13.2 (user program, EEPROM), P006-CMD-51/57,
//         P006-BAD-08/09.
// Timing: ok_o belongs to order_i of the cycle before. The limits are read from a block RAM, one cycle after
//         take_i.
`default_nettype none

module pmc006_data_check
  import pmc006_pkg::*;
(
    input  wire logic         clk_i,
    input  wire logic         take_i,     // read the limits of op_i
    input  wire logic         program_i,  // with take_i: instruction of the user program
    input  wire logic   [7:0] op_i,       // with take_i: instruction code
    input  wire order_t       order_i,    // instruction op_i, from the next cycle on
    output access_t           access_o,   // register of the instruction
    output logic              ok_o        // the data are accepted
);

  typedef struct packed {
    logic            listed;  // the instruction has limits
    logic [8:0]      low;
    logic [13:0]     high;
    access_t access;
  } limits_t;

  function automatic access_t access_of(logic [7:0] op);
    unique case (op)
      I_MSTEP:        return '{write: 1'b1, which: RegMstep};
      I_CURRENT:      return '{write: 1'b1, which: RegCurrent};
      I_ACC:          return '{write: 1'b1, which: RegAcc};
      I_DEC:          return '{write: 1'b1, which: RegDec};
      I_AUTODEC:      return '{write: 1'b1, which: RegAutodec};
      I_ATT:          return '{write: 1'b1, which: RegAtt};
      I_VSTART:       return '{write: 1'b1, which: RegVstart};
      I_VSTOP:        return '{write: 1'b1, which: RegVstop};
      I_CCOMP:        return '{write: 1'b1, which: RegCcomp};
      I_SCOMP:        return '{write: 1'b1, which: RegScomp};
      I_VMAX:         return '{write: 1'b1, which: RegVmax};
      I_DIR:          return '{write: 1'b1, which: RegDir};
      I_FREE:         return '{write: 1'b1, which: RegFree};
      I_ADDR:         return '{write: 1'b1, which: RegAddr};
      I_TRIGGER:      return '{write: 1'b1, which: RegTrigger};
      I_EXTEN:        return '{write: 1'b1, which: RegExten};
      I_OFFLINE:      return '{write: 1'b1, which: RegOffline};
      I_STLEN:        return '{write: 1'b1, which: RegStlen};
      I_STCFG:        return '{write: 1'b1, which: RegStcfg};
      I_STLVL:        return '{write: 1'b1, which: RegStlvl};
      I_MSTEP_READ:   return '{write: 1'b0, which: RegMstep};
      I_CURRENT_READ: return '{write: 1'b0, which: RegCurrent};
      I_ACC_READ:     return '{write: 1'b0, which: RegAcc};
      I_DEC_READ:     return '{write: 1'b0, which: RegDec};
      I_ATT_READ:     return '{write: 1'b0, which: RegAtt};
      I_VMAX_READ:    return '{write: 1'b0, which: RegVmax};
      I_TRIGGER_READ: return '{write: 1'b0, which: RegTrigger};
      default:        return '{write: 1'b0, which: RegNone};
    endcase
  endfunction

  function automatic limits_t limits_of(logic program_op, logic [7:0] op);
    limits_t l;
    l = '{listed: 1'b1, low: 9'd0, high: 14'd1, access : access_of(op)};
    unique case (op)
      I_OFFLINE, I_RUN, I_AUTODEC, I_DIR, I_FREE: l.high = 14'd1;
      I_POINTER: l.high = 14'd199;
      I_TRIGGER: l.high = 14'd3;
      I_EXTEN: l.high = program_op ? 14'd1 : 14'd3;
      I_VSTART, I_VSTOP: begin
        l.low  = 9'd65;
        l.high = 14'd3000;
      end
      I_CCOMP: begin
        l.low  = 9'd100;
        l.high = 14'd1200;
      end
      I_SCOMP: begin
        l.low  = 9'd300;
        l.high = 14'd2000;
      end
      I_ATT: begin
        l.low  = 9'd1;
        l.high = 14'd4;
      end
      I_STLEN: l.high = 14'd63;
      I_STCFG: l.high = 14'd7;
      I_STLVL: l.high = 14'd511;
      I_CURRENT: begin
        l.low  = 9'd400;
        l.high = 14'd4000;
      end
      I_MSTEP: l.high = 14'd128;
      I_DEC: l.high = 14'd5;
      I_ACC: l.high = program_op ? 14'd6 : 14'd5;
      I_VMAX: begin
        l.low  = program_op ? 9'd0 : 9'd1;
        l.high = 14'd16_000;
      end
      I_ADDR: begin
        l.low  = 9'd1;
        l.high = 14'd120;
      end
      P_JMP, P_JNE, P_JEQ, P_RESET_EN: l.high = 14'd99;
      default: begin
        l.listed = 1'b0;
        l.high   = 14'h3fff;
      end
    endcase
    return l;
  endfunction

  // The words are one constant, because synthesis evaluates the branches of limits_of wrongly in an initial
  // block.
  function automatic limits_t [511:0] every_limits();
    limits_t [511:0] words;
    for (int unsigned i = 0; i < 512; i++) words[9'(i)] = limits_of(i >= 256, 8'(i));
    return words;
  endfunction

  localparam limits_t [511:0] Words = every_limits();

  (* rom_style = "block" *)
  limits_t rom[512];
  limits_t limits_q;
  logic [31:0] data;
  logic may, own;
  // above_q: data >= low; below_q: data <= high; may_q: the other conditions are met; own_q: legal regardless
  // of these three
  logic above_q, below_q, may_q, own_q;

  initial for (int unsigned i = 0; i < 512; i++) rom[i] = Words[9'(i)];

  always_ff @(posedge clk_i) if (take_i) limits_q <= rom[{program_i, op_i}];

  assign access_o = limits_q.access;
  assign data = order_i.data;

  // If an instruction has no limits, low and high pass any value of the lowest 14 bits.
  always_comb begin
    may = !limits_q.listed || data[31:14] == '0;
    own = 1'b0;
    unique case (order_i.op)
      I_STEP: may = !data[31] && data[30:0] != '0;
      // At most one bit of the byte is set, and not bit 0.
      I_MSTEP: if (data[0] || (data[7:0] & (data[7:0] - 1'b1)) != '0) may = 1'b0;
      I_ADDR: own = order_i.source == FromBoot && data[15:0] == 16'h00ff;
      I_VMAX, P_RESET_EN, P_PAUSE_EN: if (order_i.option > 4'd1) may = 1'b0;
      P_OUT: may = order_i.option inside {[4'd1 : 4'd5]};
      P_WAIT, P_CMP: may = order_i.option inside {[4'd1 : 4'd9]};
      default: ;
    endcase
  end

  always_ff @(posedge clk_i) begin
    above_q <= data[13:0] >= 14'(limits_q.low);
    below_q <= data[13:0] <= limits_q.high;
    may_q   <= may;
    own_q   <= own;
  end

  assign ok_o = (above_q && below_q && may_q) || own_q;

endmodule

`default_nettype wire
