// SPDX-License-Identifier: Apache-2.0
// pmc006_range: which data each instruction accepts, whatever the state of the motor.
// Rules:  section 3.1 (accepted D), sections 12.3 and 13.2 (user program, EEPROM), P006-CMD-51/57, P006-BAD-08/09.
// Timing: none; combinational.
`default_nettype none

module pmc006_range
  import pmc006_pkg::*;
(
    input  wire order_t order_i,  // the instruction
    output logic        ok_o      // its data are accepted
);

  logic frame, listed, inner;
  logic [13:0] low, high;

  assign frame = order_i.source == FromFrame;

  always_comb begin
    listed = 1'b1;
    low    = 14'd0;
    high   = 14'd1;
    unique case (order_i.op)
      I_OFFLINE, I_RUN, I_AUTODEC, I_DIR, I_FREE: high = 14'd1;
      I_POINTER: high = 14'd199;
      I_TRIGGER: high = 14'd3;
      I_EXTEN: high = frame ? 14'd3 : 14'd1;
      I_VSTART, I_VSTOP: begin
        low  = 14'd65;
        high = 14'd3000;
      end
      I_CCOMP: begin
        low  = 14'd100;
        high = 14'd1200;
      end
      I_SCOMP: begin
        low  = 14'd300;
        high = 14'd2000;
      end
      I_ATT: begin
        low  = 14'd1;
        high = 14'd4;
      end
      I_STLEN: high = 14'd63;
      I_STCFG: high = 14'd7;
      I_STLVL: high = 14'd511;
      I_CURRENT: begin
        low  = 14'd400;
        high = 14'd4000;
      end
      I_MSTEP: high = 14'd128;
      I_DEC: high = 14'd5;
      I_ACC: high = (order_i.source inside {FromProgram, FromTry}) ? 14'd6 : 14'd5;
      I_VMAX: begin
        low  = frame ? 14'd1 : 14'd0;
        high = 14'd16_000;
      end
      I_ADDR: begin
        low  = 14'd1;
        high = 14'd120;
      end
      P_JMP, P_JNE, P_JEQ, P_RESET_EN: high = 14'd99;
      default: listed = 1'b0;
    endcase
  end

  assign inner = order_i.data[31:14] == '0 && order_i.data[13:0] >= low && order_i.data[13:0] <= high;

  always_comb begin
    ok_o = !listed || inner;
    unique case (order_i.op)
      I_STEP: ok_o = !order_i.data[31] && order_i.data[30:0] != '0;
      // One bit of the byte, or none.
      I_MSTEP: ok_o = inner && !order_i.data[0] && (order_i.data[7:0] & (order_i.data[7:0] - 1'b1)) == '0;
      I_ADDR: ok_o = inner || (order_i.source == FromBoot && order_i.data[15:0] == 16'h00ff);
      I_VMAX: ok_o = inner && order_i.option <= 4'd1;
      P_RESET_EN: ok_o = inner && order_i.option <= 4'd1;
      P_PAUSE_EN: ok_o = order_i.option <= 4'd1;
      P_OUT: ok_o = order_i.option inside {[4'd1 : 4'd5]};
      P_WAIT, P_CMP: ok_o = order_i.option inside {[4'd1 : 4'd9]};
      default: ;
    endcase
  end

endmodule

`default_nettype wire
